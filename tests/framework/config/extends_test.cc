// Pipelines that change others, and --set.
#include "tests/framework/config/pipeline_fixture.h"

namespace plaza::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ExtendsTest : public PipelineFixture {
 protected:
  void SetUp() override {
    PipelineFixture::SetUp();
    write("base.json", R"({ "plaza": 1, "name": "Base", "scene": "scene.json", "seed": 5, "nodes": [
)" + std::string(kWholeNodes) +
                           "] }");
  }
  static std::string over(const std::string& nodes) {
    return "{ \"extends\": \"base.json\", \"nodes\": [\n" + nodes + "\n] }";
  }
  static std::vector<std::string> names(const ResolvedPipeline& pipeline) {
    std::vector<std::string> out;
    for (const ResolvedNode& node : pipeline.nodes) out.push_back(node.name);
    return out;
  }
  static const ResolvedNode& node(const ResolvedPipeline& pipeline, const std::string& name) {
    for (const ResolvedNode& n : pipeline.nodes) {
      if (n.name == name) return n;
    }
    throw std::out_of_range(name);
  }
};

TEST_F(ExtendsTest, ChangesWhatItSaysAndKeepsTheRest) {
  const ResolvedPipeline pipeline = read(R"({ "extends": "base.json", "name": "Changed", "nodes": [
    { "use": "edges", "directions": 8 }, { "name": "tracks", "affinities": [ { "name": "location", "weight": 0 } ] } ] })");
  EXPECT_EQ(pipeline.name, "Changed");
  EXPECT_EQ(pipeline.seed, 5U);
  EXPECT_EQ(pipeline.nodes.size(), 9U);
  EXPECT_EQ(node(pipeline, "edges").values["directions"], 8);
  EXPECT_EQ(node(pipeline, "edges").values["sigma_px"], 2.0);
  const ResolvedPart& location = node(pipeline, "tracks").parts.at("affinities").at(0);
  EXPECT_EQ(location.values["weight"], 0.0);
  EXPECT_EQ(location.values["sigma_m"], 0.5);
}

TEST_F(ExtendsTest, OriginsTellTheFile) {
  const ResolvedPipeline pipeline = read(over(R"({ "use": "edges", "directions": 8 })"));
  EXPECT_EQ(to_string(node(pipeline, "edges").origins.at("/directions")), "p.json:2:33");
  EXPECT_EQ(to_string(node(pipeline, "edges").origins.at("/sigma_px")), "base.json:3:31");
  EXPECT_EQ(to_string(pipeline.origins.at("/name")), "base.json:1:23");
}

TEST_F(ExtendsTest, AnotherUseDropsTheOldParametersAndKeepsTheName) {
  const ResolvedPipeline pipeline = read(over(R"({ "name": "detector", "use": "boxes" })"));
  EXPECT_EQ(node(pipeline, "detector").entry->declaration.name, "boxes");
  EXPECT_TRUE(node(pipeline, "detector").input_lists.empty());
  const ResolvedPipeline renamed = read(over(R"({ "name": "edges", "use": "color" })"));
  EXPECT_EQ(names(renamed)[1], "edges");
}

TEST_F(ExtendsTest, AnotherUseOfAPartDropsItsParameters) {
  write(
      "shape.json",
      R"({ "extends": "base.json", "nodes": [ { "name": "detector", "shape": { "use": "cylinder", "radii_m": [0.1, 0.3, 0.2] } } ] })");
  const ResolvedPipeline pipeline = read(
      R"({ "extends": "shape.json", "nodes": [ { "name": "detector", "shape": { "use": "cuboid" } } ] })");
  EXPECT_EQ(node(pipeline, "detector").parts.at("shape").at(0).values,
            nlohmann::json::parse(R"({ "width_m": 0.5 })"));
}

TEST_F(ExtendsTest, NullRemoves) {
  const ResolvedPipeline pipeline = read(over(R"({ "name": "report", "use": null },
    { "name": "tracks", "affinities": [ { "name": "appearance", "use": null } ] })"));
  EXPECT_THAT(names(pipeline), testing::Not(testing::Contains("report")));
  EXPECT_EQ(node(pipeline, "tracks").parts.at("affinities").size(), 1U);
}

TEST_F(ExtendsTest, NewNodesAreAppendedOrPlaced) {
  EXPECT_THAT(names(read(over(R"({ "use": "overlay" })"))).back(), "overlay");
  EXPECT_THAT(names(read(over(R"({ "use": "histogram", "name": "h2", "after": "detector" },
                                 { "use": "ground-truth", "file": "gt.txt", "before": "edges" })"))),
              ElementsAre("cameras", "ground-truth", "edges", "color", "detector", "h2",
                          "histogram", "tracklets", "tracks", "scores", "report"));
}

TEST_F(ExtendsTest, NodesCanBeMoved) {
  EXPECT_THAT(
      names(read(over(
          R"({ "name": "color", "before": "edges" }, { "name": "scores", "after": "report" })"))),
      ElementsAre("cameras", "color", "edges", "detector", "histogram", "tracklets", "tracks",
                  "report", "scores"));
}

TEST_F(ExtendsTest, ListsOfPlainValuesAndInputsAreReplaced) {
  const ResolvedPipeline pipeline = read(over(R"({ "use": "color", "bins": [2, 3, 4] },
    { "name": "detector", "modalities": [ { "from": "color" } ] })"));
  EXPECT_EQ(node(pipeline, "color").values["bins"], nlohmann::json::parse("[2, 3, 4]"));
  EXPECT_EQ(node(pipeline, "detector").input_lists.at("modalities").size(), 1U);
}

TEST_F(ExtendsTest, FromGoesBackToTheNearestWithNull) {
  write("branch.json",
        R"({ "extends": "base.json", "nodes": [ { "name": "tracklets", "from": "detector" } ] })");
  EXPECT_EQ(node(read(R"({ "extends": "branch.json" })"), "tracklets").inputs[0].node, 3);
  EXPECT_EQ(
      node(
          read(
              R"({ "extends": "branch.json", "nodes": [ { "name": "tracklets", "from": null } ] })"),
          "tracklets")
          .inputs[0]
          .node,
      4);
}

TEST_F(ExtendsTest, PathsStartAtTheFileTheyStandIn) {
  write(
      "sub/base.json",
      R"({ "plaza": 1, "scene": "../scene.json", "nodes": [ { "use": "ground-truth", "file": "gt.txt" } ] })");
  const ResolvedPipeline pipeline = read(
      R"({ "extends": "sub/base.json", "nodes": [ { "use": "ground-truth", "name": "b", "file": "gt.txt" } ] })");
  EXPECT_EQ(pipeline.scene_file, "scene.json");
  EXPECT_EQ(pipeline.nodes[0].values["file"], "sub/gt.txt");
  EXPECT_EQ(pipeline.nodes[1].values["file"], "gt.txt");
}

TEST_F(ExtendsTest, ErrorsPointIntoTheRightFile) {
  write("wrong.json",
        "{ \"plaza\": 1, \"scene\": \"scene.json\", \"nodes\": [ { \"use\": \"synthetic\",\n "
        "\"frames\": 0 } ] }");
  EXPECT_EQ(
      errors("{ \"extends\": \"wrong.json\", \"nodes\": [ { \"use\": \"boxes\", \"x\": 1 } ] }"),
      "p.json:1:57: /nodes/0/x: unknown parameter of \"boxes\"; it has no parameters\n"
      "wrong.json:2:12: /nodes/0/frames: expected integer, >= 1, got 0");
}

TEST_F(ExtendsTest, ChainsMayBeLongButNotCircular) {
  write("b.json", R"({ "extends": "base.json", "seed": 6 })");
  write("c.json", R"({ "extends": "b.json" })");
  EXPECT_EQ(read(R"({ "extends": "c.json" })").seed, 6U);
  write("p.json", R"({ "extends": "q.json" })");
  write("q.json", "{\n \"extends\": \"./p.json\" }");
  EXPECT_EQ(
      errors(R"({ "extends": "q.json" })"),
      "q.json:2:13: /extends: pipelines extend each other in a circle: p.json -> q.json -> p.json");
}

TEST_F(ExtendsTest, FaultsOfTheMergeHaveARemedy) {
  EXPECT_EQ(errors(R"({ "extends": "bse.json" })"),
            "p.json:1:14: /extends: there is no file bse.json to be extended");
  EXPECT_THAT(errors(R"({ "extends": 3 })"),
              HasSubstr("/extends: expected the path of another pipeline, got 3"));
  EXPECT_THAT(errors(over(R"({ "name": "reprt", "use": null })")),
              HasSubstr("/nodes/0: there is no \"reprt\" to be removed; did you mean \"report\"?"));
  EXPECT_THAT(errors(over(R"({ "use": null })")),
              HasSubstr("\"use\": null removes by name; give the \"name\""));
  EXPECT_THAT(
      errors(over(R"({ "use": "overlay", "after": "edgse" })")),
      HasSubstr(
          "/nodes/0/after: there is no \"edgse\" to be placed after; did you mean \"edges\"?"));
  EXPECT_THAT(errors(over(R"({ "use": "overlay", "after": "edges", "before": "color" })")),
              HasSubstr("\"after\" and \"before\" exclude each other"));
  EXPECT_THAT(errors(over(R"({ "use": "edges" }, { "name": "edges" })")),
              HasSubstr("/nodes/1: \"edges\" is changed twice in this file"));
  EXPECT_THAT(node_errors(R"({ "use": "synthetic" }, { "use": "boxes", "after": "synthetic" })"),
              HasSubstr("\"after\" is only for pipelines that extend another one"));
  EXPECT_THAT(node_errors(R"({ "use": "synthetic" }, { "name": "boxes", "use": null })"),
              HasSubstr("\"use\": null is only for pipelines that extend another one"));
}

class SetTest : public ExtendsTest {
 protected:
  ResolvedPipeline with(const std::vector<std::string>& sets) const {
    return read(R"({ "extends": "base.json" })", sets);
  }
  std::string errors_with(const std::vector<std::string>& sets) const {
    return errors(R"({ "extends": "base.json" })", sets);
  }
};

TEST_F(SetTest, NamesNodesByNameOrIndex) {
  EXPECT_EQ(node(with({"/nodes/edges/sigma_px=2.5"}), "edges").values["sigma_px"], 2.5);
  EXPECT_EQ(node(with({"/nodes/1/sigma_px=2.5"}), "edges").values["sigma_px"], 2.5);
}

TEST_F(SetTest, ReachesPartsRecordsAndElements) {
  const ResolvedPipeline pipeline =
      with({"/nodes/tracks/affinities/appearance/weight=0", "/nodes/tracks/affinities/0/weight=7",
            "/nodes/detector/modalities/edges/weight=4", "/nodes/detector/shape/radii_m/2=0.2",
            "/nodes/color/bins/0=16", "/nodes/tracklets/motion/sigma_mps2=3"});
  const auto& affinities = node(pipeline, "tracks").parts.at("affinities");
  EXPECT_EQ(affinities[0].values["weight"], 7.0);
  EXPECT_EQ(affinities[1].values["weight"], 0.0);
  EXPECT_EQ(node(pipeline, "detector").input_lists.at("modalities")[0].fields["weight"], 4.0);
  EXPECT_EQ(node(pipeline, "detector").parts.at("shape")[0].values["radii_m"],
            nlohmann::json::parse("[0.12, 0.25, 0.2]"));
  EXPECT_EQ(node(pipeline, "color").values["bins"], nlohmann::json::parse("[16, 8, 8]"));
  EXPECT_EQ(node(pipeline, "tracklets").parts.at("motion")[0].values["sigma_mps2"], 3.0);
}

TEST_F(SetTest, ValuesAreJsonOrElseText) {
  EXPECT_EQ(node(with({"/nodes/tracklets/reentry=keep"}), "tracklets").values["reentry"], "keep");
  EXPECT_EQ(node(with({"/nodes/tracklets/reentry=\"keep\""}), "tracklets").values["reentry"],
            "keep");
  EXPECT_EQ(node(with({"/nodes/histogram/label=a=b"}), "histogram").values["label"], "a=b");
  EXPECT_EQ(node(with({"/nodes/color/bins=[2,2,2]"}), "color").values["bins"].size(), 3U);
  EXPECT_EQ(with({"/name=Night run"}).name, "Night run");
  EXPECT_EQ(with({"/seed=9"}).seed, 9U);
}

TEST_F(SetTest, AnotherUseDropsTheOldParameters) {
  const ResolvedPipeline pipeline =
      with({"/nodes/detector/use=boxes", "/nodes/tracks/affinities/location/use=mixture"});
  EXPECT_EQ(node(pipeline, "detector").entry->declaration.name, "boxes");
  EXPECT_EQ(node(pipeline, "tracks").parts.at("affinities")[0].name, "location");
  EXPECT_EQ(node(pipeline, "tracks").parts.at("affinities")[0].entry->declaration.name, "mixture");
}

TEST_F(SetTest, NullRemoves) {
  EXPECT_EQ(with({"/nodes/report/use=null"}).nodes.size(), 8U);
  EXPECT_EQ(node(with({"/nodes/tracks/affinities/appearance/use=null"}), "tracks")
                .parts.at("affinities")
                .size(),
            1U);
}

TEST_F(SetTest, PathsStartAtTheWorkingFolder) {
  write(
      "sub/p2.json",
      R"({ "plaza": 1, "scene": "../scene.json", "nodes": [ { "use": "ground-truth", "file": "gt.txt" } ] })");
  write("other.json", "{}");
  const ResolvedPipeline pipeline = read_pipeline(
      {"sub/p2.json", {"/nodes/ground-truth/file=x/gt.txt", "/scene=other.json"}}, registry_);
  EXPECT_EQ(pipeline.nodes[0].values["file"], "x/gt.txt");
  EXPECT_EQ(pipeline.scene_file, "other.json");
}

TEST_F(SetTest, LaterOnesWin) { EXPECT_EQ(with({"/seed=1", "/seed=2"}).seed, 2U); }

TEST_F(SetTest, ValuesAreCheckedLikeTheFiles) {
  EXPECT_EQ(
      errors_with({"/nodes/edges/sigma_px=wide"}),
      "--set /nodes/edges/sigma_px=wide: /nodes/1/sigma_px: expected real in px, > 0, got text");
  EXPECT_EQ(errors_with({"/nodes/edges/sigma_pxx=1"}),
            "--set /nodes/edges/sigma_pxx=1: /nodes/1/sigma_pxx: unknown parameter of \"edges\"; "
            "did you mean \"sigma_px\"?");
}

TEST_F(SetTest, UnknownTargetsHaveASuggestion) {
  EXPECT_EQ(errors_with({"/nodes/edgse/sigma_px=1"}),
            "--set /nodes/edgse/sigma_px=1: there is no node \"edgse\"; did you mean \"edges\"?");
  EXPECT_THAT(errors_with({"/nodes/12/sigma_px=1"}),
              HasSubstr("there is no node \"12\"; there are \"cameras\", \"edges\""));
  EXPECT_THAT(errors_with({"/nodes/tracks/affinities/locaton/weight=1"}),
              HasSubstr("there is no part \"locaton\"; did you mean \"location\"?"));
  EXPECT_THAT(errors_with({"/node/edges/sigma_px=1"}),
              HasSubstr("\"node\" can't be set; \"nodes\", \"seed\", \"name\", \"scene\", "
                        "\"description\" can; did you mean \"nodes\"?"));
  EXPECT_THAT(errors_with({"/nodes/tracklets/moton/sigma_mps2=1"}),
              HasSubstr("unknown parameter \"moton\" of \"gnn\"; did you mean \"motion\"?"));
  EXPECT_THAT(errors_with({"/nodes/edges/sigma_px/x=1"}),
              HasSubstr("\"sigma_px\" has nothing below it"));
  EXPECT_THAT(errors_with({"/seed/x=1"}), HasSubstr("\"seed\" has nothing below it"));
}

TEST_F(SetTest, MalformedOptionsAreExplained) {
  EXPECT_EQ(errors_with({"/seed"}),
            "--set /seed: expected /nodes/NODE/PARAMETER=VALUE, there is no \"=\"");
  EXPECT_THAT(errors_with({"seed=1"}), HasSubstr("the target begins with \"/\""));
  EXPECT_THAT(errors_with({"/nodes=1"}), HasSubstr("expected /nodes/NODE/PARAMETER=VALUE"));
  EXPECT_THAT(errors_with({"/nodes/edges=1"}), HasSubstr("expected /nodes/NODE/PARAMETER=VALUE"));
  EXPECT_THAT(errors_with({"=1"}), HasSubstr("begins with \"/\""));
  EXPECT_THAT(errors_with({"/nodes/tracks/affinities/location=1"}),
              HasSubstr("\"location\" is a part; name one of its parameters"));
}

TEST_F(SetTest, AllFaultsAreReportedAtOnceAfterThoseOfTheFile) {
  EXPECT_EQ(errors(over(R"({ "use": "edges", "x": 1 })"), {"/nodes/a/b=1", "/seed=-1"}),
            "p.json:2:19: /nodes/0/x: unknown parameter of \"edges\"; see `plaza show edges`\n"
            "--set /nodes/a/b=1: there is no node \"a\"; there are \"cameras\", \"edges\", "
            "\"color\", \"detector\", "
            "\"histogram\", \"tracklets\", \"tracks\", \"scores\", \"report\"\n"
            "--set /seed=-1: /seed: expected integer, >= 0, got -1");
}

}  // namespace
}  // namespace plaza::test
