// What a pipeline may say of its nodes, and what is said of one that says something else.
#include "tests/framework/config/pipeline_fixture.h"

namespace plaza::test {
namespace {

using testing::HasSubstr;

class PipelineTest : public PipelineFixture {};

TEST_F(PipelineTest, ReadsAWholePipeline) {
  const ResolvedPipeline pipeline = read(R"({
    "$schema": "pipeline.schema.json", "plaza": 1, "name": "Laboratory", "description": "crossing",
    "scene": "scene.json", "seed": 7, "nodes": [)" +
                                         std::string(kWholeNodes) + "] }");
  EXPECT_EQ(pipeline.name, "Laboratory");
  EXPECT_EQ(pipeline.description, "crossing");
  EXPECT_EQ(pipeline.file, "p.json");
  EXPECT_EQ(pipeline.scene_file, "scene.json");
  EXPECT_EQ(pipeline.seed, 7U);
  ASSERT_EQ(pipeline.nodes.size(), 9U);
  EXPECT_EQ(pipeline.nodes[0].name, "cameras");
  EXPECT_EQ(pipeline.nodes[0].entry->declaration.name, "synthetic");
  EXPECT_EQ(pipeline.nodes[1].name, "edges");
  EXPECT_EQ(pipeline.nodes[3].path, "/nodes/detector");
  EXPECT_EQ(pipeline.nodes[3].pointer, "/nodes/3");
  EXPECT_EQ(pipeline.nodes[3].where.line, 6);
}

TEST_F(PipelineTest, TheFileNamesAPipelineWithoutName) {
  EXPECT_EQ(read_nodes(R"({ "use": "synthetic" })").name, "p");
  EXPECT_EQ(read_nodes(R"({ "use": "synthetic" })").seed, 0U);
}

TEST_F(PipelineTest, FillsInDefaults) {
  const ResolvedPipeline pipeline = read_nodes(R"({ "use": "synthetic", "frames": 9 })");
  EXPECT_EQ(pipeline.nodes[0].values,
            nlohmann::json::parse(R"({ "scenario": "walk", "frames": 9, "shadows": false })"));
}

TEST_F(PipelineTest, MakesRealsOfIntegersAndIntegersOfWholeReals) {
  const ResolvedPipeline pipeline =
      read_nodes(R"({ "use": "synthetic", "frames": 1e2 }, { "use": "edges", "sigma_px": 2 })");
  EXPECT_TRUE(pipeline.nodes[0].values["frames"].is_number_integer());
  EXPECT_EQ(pipeline.nodes[0].values["frames"], 100);
  EXPECT_TRUE(pipeline.nodes[1].values["sigma_px"].is_number_float());
}

TEST_F(PipelineTest, OptionalParametersMayBeNullAndOthersMayNot) {
  write("v.avi", "");
  EXPECT_TRUE(read_nodes(R"({ "use": "video", "files": { "a": "v.avi" }, "frame_rate_hz": null })")
                  .nodes[0]
                  .values["frame_rate_hz"]
                  .is_null());
  EXPECT_EQ(node_errors(R"({ "use": "synthetic", "frames": null })"),
            "p.json:2:33: /nodes/0/frames: expected integer, >= 1, got null");
}

TEST_F(PipelineTest, NestsPartsAtAnyDepth) {
  const ResolvedPipeline pipeline =
      read_nodes(R"({ "use": "synthetic" }, { "use": "boxes" }, { "use": "gnn" },
    { "use": "flow", "affinities": [ { "use": "mixture", "terms": [
        { "use": "mixture", "name": "inner", "terms": [ { "use": "location", "weight": 3 } ] } ] } ] })");
  const ResolvedPart& outer = pipeline.nodes[3].parts.at("affinities").at(0);
  const ResolvedPart& location = outer.parts.at("terms").at(0).parts.at("terms").at(0);
  EXPECT_EQ(location.values["weight"], 3.0);
  EXPECT_EQ(location.pointer, "/nodes/3/affinities/0/terms/0/terms/0");
  EXPECT_EQ(location.path, "/nodes/flow/affinities/mixture/terms/inner/terms/location");
}

TEST_F(PipelineTest, DefaultPartsAreNamedByTheirParameter) {
  const ResolvedPipeline pipeline =
      read_nodes(R"({ "use": "synthetic" }, { "use": "boxes" }, { "use": "gnn" })");
  const ResolvedPart& motion = pipeline.nodes[2].parts.at("motion").at(0);
  EXPECT_EQ(motion.path, "/nodes/gnn/motion");
  EXPECT_EQ(motion.name, "constant-velocity");
  EXPECT_EQ(motion.values["sigma_mps2"], 1.0);
  EXPECT_EQ(to_string(motion.origins.at("/sigma_mps2")), "default");
}

TEST_F(PipelineTest, ValuesKnowTheirOrigin) {
  const ResolvedPipeline pipeline =
      read_nodes("{ \"use\": \"synthetic\" },\n{ \"use\": \"edges\", \"sigma_px\": 2 }",
                 {"/nodes/edges/directions=8"});
  const Origins& origins = pipeline.nodes[1].origins;
  EXPECT_EQ(to_string(origins.at("/use")), "p.json:3:10");
  EXPECT_EQ(to_string(origins.at("/sigma_px")), "p.json:3:31");
  EXPECT_EQ(to_string(origins.at("/directions")), "--set /nodes/edges/directions=8");
  EXPECT_EQ(to_string(pipeline.nodes[0].origins.at("/frames")), "default");
  EXPECT_EQ(to_string(pipeline.origins.at("/scene")), "p.json:1:24");
  EXPECT_EQ(to_string(pipeline.origins.at("/seed")), "default");
}

TEST_F(PipelineTest, UnknownParametersHaveASuggestion) {
  EXPECT_EQ(node_errors("{ \"use\": \"synthetic\" },\n{ \"use\": \"edges\", \"sigma_pxx\": 2 }"),
            "p.json:3:19: /nodes/1/sigma_pxx: unknown parameter of \"edges\"; did you mean "
            "\"sigma_px\"?");
  EXPECT_EQ(node_errors(R"({ "use": "synthetic", "colour": 2 })"),
            "p.json:2:23: /nodes/0/colour: unknown parameter of \"synthetic\"; see `plaza show "
            "synthetic`");
  EXPECT_EQ(node_errors(R"({ "use": "synthetic" }, { "use": "boxes", "zoom": 2 })"),
            "p.json:2:43: /nodes/1/zoom: unknown parameter of \"boxes\"; it has no parameters");
}

TEST_F(PipelineTest, TypesAreNamedWithUnitAndRange) {
  const std::string source = "{ \"use\": \"synthetic\" }, ";
  EXPECT_THAT(node_errors(source + R"({ "use": "edges", "sigma_px": "wide" })"),
              HasSubstr("/nodes/1/sigma_px: expected real in px, > 0, got text"));
  EXPECT_THAT(node_errors(source + R"({ "use": "edges", "sigma_px": -1 })"),
              HasSubstr("expected real in px, > 0, got -1"));
  EXPECT_THAT(node_errors(source + R"({ "use": "edges", "sigma_px": 0 })"),
              HasSubstr("> 0, got 0"));
  EXPECT_THAT(node_errors(source + R"({ "use": "edges", "directions": 2.5 })"),
              HasSubstr("expected integer, >= 1, <= 64, got 2.5"));
  EXPECT_THAT(node_errors(source + R"({ "use": "edges", "directions": 65 })"), HasSubstr("got 65"));
  EXPECT_THAT(node_errors(source + R"({ "use": "edges", "directions": [1] })"),
              HasSubstr("got a list"));
  EXPECT_THAT(node_errors(source + R"({ "use": "edges", "directions": {} })"),
              HasSubstr("got an object"));
  EXPECT_THAT(node_errors(source + R"({ "use": "edges", "directions": true })"),
              HasSubstr("got true"));
  EXPECT_THAT(node_errors(R"({ "use": "synthetic", "shadows": 1 })"),
              HasSubstr("/nodes/0/shadows: expected true or false, got 1"));
  EXPECT_THAT(node_errors(R"({ "use": "synthetic", "frames": 4000000000 })"),
              HasSubstr("got 4000000000"));
}

TEST_F(PipelineTest, ExclusiveLimitsExclude) {
  const std::string above = R"({ "use": "synthetic" }, { "use": "boxes" }, )";
  EXPECT_EQ(node_errors(above + R"({ "use": "gnn", "gate_m": 10, "decay": 0 })"), "no error");
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn", "decay": 1 })"),
              HasSubstr("expected real, >= 0, < 1, got 1"));
}

TEST_F(PipelineTest, ChoicesAreListed) {
  EXPECT_EQ(node_errors(R"({ "use": "synthetic", "scenario": "crosing" })"),
            "p.json:2:35: /nodes/0/scenario: expected one of \"walk\", \"crossing\", got "
            "\"crosing\"; did you "
            "mean \"crossing\"?");
  EXPECT_THAT(node_errors(R"({ "use": "synthetic", "scenario": 1 })"), HasSubstr("got 1"));
}

TEST_F(PipelineTest, ListsAndMapsAreCheckedElementByElement) {
  const std::string source = "{ \"use\": \"synthetic\" }, ";
  EXPECT_THAT(node_errors(source + R"({ "use": "color", "bins": [8, 8] })"),
              HasSubstr("/nodes/1/bins: expected list of 3 integers, >= 2, got 2"));
  EXPECT_EQ(node_errors(source + R"({ "use": "color", "bins": [8, "x", 1] })"),
            "p.json:2:55: /nodes/1/bins/1: expected integer, >= 2, got text\n"
            "p.json:2:60: /nodes/1/bins/2: expected integer, >= 2, got 1");
  EXPECT_THAT(node_errors(source + R"({ "use": "color", "bins": [8, 8, null] })"),
              HasSubstr("got null"));
  EXPECT_THAT(node_errors(R"({ "use": "video", "files": {} })"),
              HasSubstr("/nodes/0/files: expected object by name of 1 or more paths, got 0"));
  EXPECT_THAT(node_errors(R"({ "use": "video", "files": { "a/b": 3 } })"),
              HasSubstr("/nodes/0/files/a~1b: expected path, got 3"));
}

TEST_F(PipelineTest, PathsStartAtTheFileAndKnowOneVariable) {
  const ResolvedPipeline pipeline = read(
      R"({ "plaza": 1, "scene": "../scene.json", "nodes": [ { "use": "video", "files": { "a": "v/1.avi", "b": "/x/2.avi" } } ] })",
      {}, "sub/p.json");
  EXPECT_EQ(pipeline.nodes[0].values["files"]["a"], "sub/v/1.avi");
  EXPECT_EQ(pipeline.nodes[0].values["files"]["b"], "/x/2.avi");
  EXPECT_EQ(node_errors(R"({ "use": "video", "files": { "a": "$HOME/1.avi" } })"),
            "p.json:2:35: /nodes/0/files/a: \"$HOME\" is not known at the start of a path; only "
            "$PLAZA_DATA is");
}

TEST_F(PipelineTest, MissingParametersAreExplained) {
  EXPECT_EQ(node_errors(R"({ "use": "video" })"),
            "p.json:2:1: /nodes/0: missing parameter \"files\" of \"video\": object by name of 1 "
            "or more paths "
            "(one video file per camera)");
}

TEST_F(PipelineTest, NamesAreUniqueAndWellFormed) {
  EXPECT_EQ(
      node_errors("{ \"use\": \"synthetic\" },\n{ \"use\": \"boxes\" },\n{ \"use\": \"boxes\" }"),
      "p.json:4:10: /nodes/2/use: there is already a node \"boxes\" (/nodes/1); give this one a "
      "\"name\" of "
      "its own");
  EXPECT_THAT(
      node_errors("{ \"use\": \"synthetic\" },\n{ \"use\": \"boxes\", \"name\": \"synthetic\" }"),
      HasSubstr(
          "p.json:3:27: /nodes/1/name: there is already a node \"synthetic\" (/nodes/0); names are "
          "unique"));
  for (const char* name : {"\"Boxes\"", "\"a b\"", "\"\"", "\"a_b\"", "\"1\"", "\"a/b\""}) {
    EXPECT_THAT(
        node_errors("{ \"use\": \"synthetic\", \"name\": " + std::string(name) + " }"),
        HasSubstr("expected a name of lower-case letters, digits and hyphens, beginning with a "
                  "letter, got " +
                  std::string(name)));
  }
  EXPECT_THAT(node_errors(R"({ "use": "synthetic", "name": 3 })"),
              HasSubstr("beginning with a letter, got 3"));
}

TEST_F(PipelineTest, PartNamesAreUniqueWithinTheirList) {
  const std::string above = R"({ "use": "synthetic" }, { "use": "boxes" }, { "use": "gnn" }, )";
  EXPECT_THAT(
      node_errors(
          above +
          R"({ "use": "flow", "affinities": [ { "use": "location" }, { "use": "location" } ] })"),
      HasSubstr("/nodes/3/affinities/1/use: there is already a part \"location\" "
                "(/nodes/3/affinities/0); "
                "give this one a \"name\" of its own"));
  EXPECT_EQ(node_errors(above + R"({ "use": "flow", "affinities": [ { "use": "location" },
                                     { "use": "mixture", "terms": [ { "use": "location" } ] } ] })"),
            "no error");
}

TEST_F(PipelineTest, UnknownComponentsAreExplainedByTheRegistry) {
  EXPECT_EQ(node_errors(R"({ "use": "synthetik" })"),
            "p.json:2:10: /nodes/0/use: " + registry_.explain_missing("synthetik", ""));
  EXPECT_THAT(node_errors(R"({ "use": "synthetik" })"), HasSubstr("did you mean \"synthetic\"?"));
}

TEST_F(PipelineTest, PartsOfAnotherKindAreRefused) {
  const std::string errors = node_errors(
      R"({ "use": "synthetic" }, { "use": "boxes" }, { "use": "gnn", "motion": { "use": "location" } })");
  EXPECT_THAT(errors,
              HasSubstr("/nodes/2/motion/use: " + registry_.explain_missing("location", "motion")));
}

TEST_F(PipelineTest, PartsAreNoNodes) {
  EXPECT_THAT(node_errors(R"({ "use": "synthetic" }, { "use": "cylinder" })"),
              HasSubstr("/nodes/1/use: \"cylinder\" is a shape, a part of other components, not a "
                        "node; it belongs "
                        "into \"shape\" of \"grid\""));
  EXPECT_THAT(node_errors(R"({ "use": "synthetic" }, { "use": "location" })"),
              HasSubstr("\"affinities\" of \"flow\", \"terms\" of \"mixture\""));
}

TEST_F(PipelineTest, PartsAreObjectsWithUse) {
  const std::string above = R"({ "use": "synthetic" }, { "use": "boxes" }, )";
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn", "motion": "constant-velocity" })"),
              HasSubstr("/nodes/2/motion: expected { \"use\": a motion, ... }, got text"));
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn", "motion": { "sigma_mps2": 1 } })"),
              HasSubstr("/nodes/2/motion: missing \"use\", the name of a motion; there are "
                        "\"constant-velocity\""));
  EXPECT_THAT(
      node_errors(above +
                  R"({ "use": "gnn" }, { "use": "flow", "affinities": { "use": "location" } })"),
      HasSubstr(
          "/nodes/3/affinities: expected list of { \"use\": an affinity, ... }, got an object"));
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn" }, { "use": "flow", "affinities": [] })"),
              HasSubstr("/nodes/3/affinities: expected 1 to 4 elements, got 0"));
  EXPECT_THAT(
      node_errors(above +
                  R"({ "use": "gnn", "motion": { "use": "constant-velocity", "from": "boxes" } })"),
      HasSubstr("unknown parameter of \"constant-velocity\"; only nodes read from others"));
}

TEST_F(PipelineTest, TheTopLevelIsStrict) {
  EXPECT_EQ(errors("{ \"plaza\": 1, \"scene\": \"scene.json\", \"node\": [], \"nodes\": [ { "
                   "\"use\": \"synthetic\" } ] }"),
            "p.json:1:38: /node: unknown key of a pipeline; did you mean \"nodes\"?");
  EXPECT_EQ(errors("{}"),
            "p.json:1:1: missing \"plaza\": 1, the version of the pipeline language\n"
            "p.json:1:1: missing \"scene\", the path of the scene file (cameras, ground area)\n"
            "p.json:1:1: missing \"nodes\", the list of components from source to sink");
  EXPECT_EQ(errors("[]"), "p.json:1:1: a pipeline is an object { \"plaza\": 1, ... }, got a list");
  EXPECT_THAT(
      errors("{ \"plaza\": 2 }"),
      HasSubstr(
          "p.json:1:12: /plaza: expected 1, the version of the pipeline language that this Plaza "
          "reads, got 2"));
  EXPECT_THAT(errors("{ \"plaza\": true }"), HasSubstr("/plaza: expected 1"));
  EXPECT_THAT(errors("{ \"plaza\": 1, \"nodes\": {} }"),
              HasSubstr("/nodes: expected a list of nodes, got an object"));
  EXPECT_THAT(errors("{ \"plaza\": 1, \"nodes\": [] }"),
              HasSubstr("/nodes: a pipeline needs at least one node"));
  EXPECT_THAT(errors("{ \"plaza\": 1, \"nodes\": [ 3 ] }"),
              HasSubstr("/nodes/0: expected { \"use\": a component, ... }, got 3"));
  EXPECT_THAT(errors("{ \"name\": 1, \"description\": [], \"$schema\": 3 }"),
              testing::AllOf(HasSubstr("/name: expected a title, got 1"),
                             HasSubstr("/description: expected text, got a list"),
                             HasSubstr("/$schema: expected the place of a JSON schema, got 3")));
}

TEST_F(PipelineTest, SeedsAreNotNegativeIntegers) {
  for (const char* seed : {"-1", "1.5", "\"7\"", "null", "1e17"}) {
    EXPECT_THAT(errors("{ \"seed\": " + std::string(seed) + " }"),
                HasSubstr("/seed: expected integer, >= 0, got "));
  }
}

TEST_F(PipelineTest, TheSceneMustBeAFile) {
  EXPECT_THAT(errors(R"({ "scene": "lab.json" })"),
              HasSubstr("p.json:1:12: /scene: there is no scene file lab.json"));
  EXPECT_THAT(errors(R"({ "scene": "." })"), HasSubstr("there is no scene file"));
  EXPECT_THAT(errors(R"({ "scene": 4 })"), HasSubstr("expected the path of a scene file, got 4"));
}

TEST_F(PipelineTest, ReportsEverythingAtOnceInTheOrderOfTheText) {
  EXPECT_EQ(
      errors("{\n"
             "  \"scene\": \"none.json\",\n"
             "  \"plaza\": 1,\n"
             "  \"nodes\": [\n"
             "    { \"use\": \"synthetic\", \"frames\": 0, \"scenario\": \"run\" },\n"
             "    { \"use\": \"edgse\" },\n"
             "    { \"sigma\": 1, \"use\": \"edges\" },\n"
             "    { \"use\": \"gnn\" }\n"
             "  ],\n"
             "  \"sed\": 3\n"
             "}"),
      "p.json:2:12: /scene: there is no scene file none.json\n"
      "p.json:5:37: /nodes/0/frames: expected integer, >= 1, got 0\n"
      "p.json:5:52: /nodes/0/scenario: expected one of \"walk\", \"crossing\", got \"run\"\n"
      "p.json:6:14: /nodes/1/use: unknown component \"edgse\"; did you mean \"edges\"?\n"
      "p.json:7:7: /nodes/2/sigma: unknown parameter of \"edges\"; did you mean \"sigma_px\"?\n"
      "p.json:10:3: /sed: unknown key of a pipeline; did you mean \"seed\"?");
}

TEST_F(PipelineTest, ReadsFiles) {
  write("good.json", with_nodes(R"({ "use": "synthetic" })"));
  EXPECT_EQ(read_pipeline({"good.json", {}}, registry_).nodes.size(), 1U);
  try {
    read_pipeline({"none.json", {}}, registry_);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "none.json: no such file");
  }
}

TEST_F(PipelineTest, ADefaultThatItsDeclarationRefusesIsThePluginsFault) {
  ComponentEntry entry = *registry_.find("boxes");
  entry.declaration.name = "bad-default";
  ParameterSpec spec = detail::scalar_spec(ParameterType::kInteger);
  spec.name = "cells";
  spec.default_value = 1;
  spec.minimum = 2;
  entry.declaration.parameters.push_back(spec);
  registry_.add(entry);
  EXPECT_THROW(read_nodes(R"({ "use": "synthetic" }, { "use": "bad-default" })"), InternalError);
}

}  // namespace
}  // namespace plaza::test
