// Who reads what from whom, and what is said when nobody can.
#include "tests/framework/config/pipeline_fixture.h"

namespace plaza::test {
namespace {

using testing::HasSubstr;

class WiringTest : public PipelineFixture {
 protected:
  /// "0:0 1:1 -": node and output of each input; "-": not connected.
  static std::string wires(const ResolvedNode& node) {
    std::string text;
    for (const Wire& wire : node.inputs) {
      if (!text.empty()) text += " ";
      text += wire.node < 0 ? "-" : std::to_string(wire.node) + ":" + std::to_string(wire.output);
    }
    return text;
  }
};

TEST_F(WiringTest, InputsComeFromTheNearestNodeAbove) {
  const ResolvedPipeline pipeline = read_nodes(kWholeNodes);
  EXPECT_EQ(wires(pipeline.nodes[0]), "");
  EXPECT_EQ(wires(pipeline.nodes[1]), "0:0");
  EXPECT_EQ(wires(pipeline.nodes[3]), "2:1 1:0 2:0");  // the mask, then the two modalities
  EXPECT_EQ(wires(pipeline.nodes[4]), "0:0 3:0");
  EXPECT_EQ(wires(pipeline.nodes[5]), "4:0");  // the described observations, not the detector's
  EXPECT_EQ(wires(pipeline.nodes[6]), "5:1");
  EXPECT_EQ(wires(pipeline.nodes[7]), "6:0 0:1");
}

TEST_F(WiringTest, InputListsFollowTheDeclaredInputs) {
  const ResolvedNode detector = read_nodes(kWholeNodes).nodes[3];
  const auto& records = detector.input_lists.at("modalities");
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].from, "edges");
  EXPECT_EQ(records[0].input, 1U);
  EXPECT_EQ(records[0].fields["weight"], 2.0);
  EXPECT_EQ(records[1].fields["weight"], 1.0);
}

TEST_F(WiringTest, OptionalInputsMayStayUnconnected) {
  EXPECT_EQ(wires(read_nodes(R"({ "use": "synthetic" }, { "use": "edges" },
      { "use": "grid", "modalities": [ { "from": "edges" } ] })")
                      .nodes[2]),
            "- 1:0");
}

TEST_F(WiringTest, FromNamesAnotherNode) {
  const std::string above =
      R"({ "use": "synthetic" }, { "use": "boxes", "name": "a" }, { "use": "boxes", "name": "b" }, )";
  EXPECT_EQ(wires(read_nodes(above + R"({ "use": "gnn" })").nodes[3]), "2:0");
  EXPECT_EQ(wires(read_nodes(above + R"({ "use": "gnn", "from": "a" })").nodes[3]), "1:0");
  EXPECT_EQ(wires(read_nodes(above + R"({ "use": "gnn", "from": ["a"] })").nodes[3]), "1:0");
  EXPECT_EQ(
      wires(read_nodes(above + R"({ "use": "gnn", "from": { "Observations": "a" } })").nodes[3]),
      "1:0");
  EXPECT_EQ(wires(read_nodes(above + R"({ "use": "histogram", "from": "a" })").nodes[3]),
            "0:0 1:0");
}

TEST_F(WiringTest, TwoBranchesRunSideBySide) {
  const ResolvedPipeline pipeline = read_nodes(R"({ "use": "synthetic" }, { "use": "boxes" },
      { "use": "gnn", "name": "one" }, { "use": "gnn", "name": "two" },
      { "use": "scores", "name": "of-one", "from": ["one", "synthetic"] }, { "use": "scores", "name": "of-two" })");
  EXPECT_EQ(wires(pipeline.nodes[3]), "1:0");
  EXPECT_EQ(wires(pipeline.nodes[4]), "2:0 0:1");
  EXPECT_EQ(wires(pipeline.nodes[5]), "3:0 0:1");
}

TEST_F(WiringTest, NullLeavesAnOptionalInputUnconnected) {
  const std::string above = R"({ "use": "synthetic" }, { "use": "boxes" }, { "use": "gnn" }, )";
  EXPECT_EQ(wires(read_nodes(above + R"({ "use": "overlay" })").nodes[3]), "0:0 2:0 0:1");
  EXPECT_EQ(
      wires(
          read_nodes(above + R"({ "use": "overlay", "from": { "GroundTruth": null } })").nodes[3]),
      "0:0 2:0 -");
  EXPECT_THAT(node_errors(above + R"({ "use": "overlay", "from": { "Tracks": null } })"),
              HasSubstr("/nodes/3/from/Tracks: only optional inputs can be left unconnected, "
                        "Tracks is required"));
}

TEST_F(WiringTest, OnlyTheFirstSourceGivesFrames) {
  const std::string sources =
      R"({ "use": "synthetic", "name": "a" }, { "use": "synthetic", "name": "b" }, )";
  const ResolvedPipeline pipeline = read_nodes(
      sources + R"({ "use": "edges" }, { "use": "boxes" }, { "use": "gnn" }, { "use": "scores" })");
  EXPECT_EQ(wires(pipeline.nodes[2]), "0:0");
  EXPECT_EQ(wires(pipeline.nodes[5]), "4:0 1:1");  // what else the second one gives is offered
  EXPECT_THAT(
      node_errors(sources + R"({ "use": "edges", "from": "b" })"),
      HasSubstr("/nodes/2/from: only the first source gives Frames, which is \"a\", not \"b\""));
}

TEST_F(WiringTest, TheFirstNodeIsASource) {
  EXPECT_EQ(node_errors("{ \"use\": \"boxes\" },\n{ \"use\": \"synthetic\" }"),
            "p.json:2:1: /nodes/0: the first node must be a source, \"boxes\" is a detector; move "
            "\"synthetic\" up\n"
            "p.json:2:1: /nodes/0: \"boxes\" needs Frames, which no node above gives; move "
            "\"synthetic\" up, it does");
  EXPECT_THAT(node_errors(R"({ "use": "report" })"),
              HasSubstr("there are \"ground-truth\", \"synthetic\", \"video\""));
}

TEST_F(WiringTest, MissingInputsNameWhoWouldGiveThem) {
  EXPECT_EQ(node_errors("{ \"use\": \"synthetic\" },\n{ \"use\": \"gnn\" }"),
            "p.json:3:1: /nodes/1: \"gnn\" needs Observations, which no node above gives; place "
            "one above that does: "
            "\"boxes\", \"grid\", \"oracle\"");
  EXPECT_THAT(node_errors("{ \"use\": \"synthetic\" },\n{ \"use\": \"flow\", \"affinities\": [ { "
                          "\"use\": \"location\" } ] },\n"
                          "{ \"use\": \"boxes\" },\n{ \"use\": \"gnn\" }"),
              HasSubstr("/nodes/1: \"flow\" needs Tracklets, which no node above gives; move "
                        "\"gnn\" up, it does"));
}

TEST_F(WiringTest, UnknownNamesHaveASuggestion) {
  const std::string above = R"({ "use": "synthetic" }, { "use": "boxes", "name": "detector" }, )";
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn", "from": "detectr" })"),
              HasSubstr("/nodes/2/from: there is no node \"detectr\"; did you mean \"detector\"?"));
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn", "from": "hog" })"),
              HasSubstr("there is no node \"hog\"; nodes above that would do: \"detector\""));
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn", "from": "gnn" })"),
              HasSubstr("a node can't read from itself"));
  EXPECT_THAT(
      node_errors(above +
                  R"({ "use": "gnn", "from": "late" }, { "use": "boxes", "name": "late" })"),
      HasSubstr("/nodes/2/from: node \"late\" is below; nodes read from nodes above them, so move "
                "\"late\" up"));
}

TEST_F(WiringTest, NodesThatGiveNothingOfUseAreRefused) {
  const std::string above = R"({ "use": "synthetic" }, { "use": "edges" }, { "use": "boxes" }, )";
  EXPECT_THAT(
      node_errors(above + R"({ "use": "gnn", "from": "edges" })"),
      HasSubstr(
          "/nodes/3/from: node \"edges\" gives Evidence, not Observations; above, \"boxes\" does"));
  EXPECT_THAT(
      node_errors(above + R"({ "use": "gnn", "from": { "Observations": "edges" } })"),
      HasSubstr("/nodes/3/from/Observations: node \"edges\" gives Evidence, not Observations"));
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn", "from": { "Observation": "boxes" } })"),
              HasSubstr("\"gnn\" does not read \"Observation\"; did you mean \"Observations\"?"));
  EXPECT_THAT(node_errors(R"({ "use": "synthetic", "from": "x" })"),
              HasSubstr("/nodes/0/from: \"synthetic\" reads nothing; remove \"from\""));
}

TEST_F(WiringTest, FromHasThreeForms) {
  const std::string above = R"({ "use": "synthetic" }, { "use": "boxes" }, )";
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn", "from": 1 })"),
              HasSubstr("expected a node's name, a list of names or { TYPE: name }, got 1"));
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn", "from": [1] })"),
              HasSubstr("/nodes/2/from/0: expected a node's name, got 1"));
  EXPECT_THAT(node_errors(above + R"({ "use": "gnn", "from": { "Observations": [] } })"),
              HasSubstr("expected a node's name, got a list"));
}

TEST_F(WiringTest, TwoThatGiveTheSameNeedAWord) {
  EXPECT_THAT(
      node_errors(
          R"({ "use": "synthetic" }, { "use": "boxes", "name": "a" }, { "use": "boxes", "name": "b" },
                             { "use": "gnn", "from": ["a", "b"] })"),
      HasSubstr("/nodes/3/from/1: \"a\" and \"b\" both give Observations; say which: \"from\": { "
                "\"Observations\": \"b\" }"));
}

TEST_F(WiringTest, GroundTruthNeverReachesWhatIsMeasured) {
  EXPECT_EQ(node_errors("{ \"use\": \"synthetic\" },\n{ \"use\": \"oracle\" }"),
            "p.json:3:1: /nodes/1: \"oracle\" is a detector and reads GroundTruth; only "
            "evaluators, sinks and renderers "
            "may, so that no result knows the truth");
}

TEST_F(WiringTest, InputListsAreChecked) {
  const std::string above = R"({ "use": "synthetic" }, { "use": "edges" }, { "use": "boxes" }, )";
  const auto modalities = [&](const std::string& records) {
    return node_errors(above + "{ \"use\": \"grid\", \"modalities\": " + records + " }");
  };
  EXPECT_EQ(modalities(R"([ { "from": "edges" } ])"), "no error");
  EXPECT_THAT(modalities("[]"),
              HasSubstr("/nodes/3/modalities: expected 1 or more elements, got 0"));
  EXPECT_THAT(
      modalities(R"([ { "weight": 1 } ])"),
      HasSubstr("/nodes/3/modalities/0: missing \"from\", the name of a node that gives Evidence"));
  EXPECT_THAT(modalities(R"([ { "from": 3 } ])"),
              HasSubstr("expected the name of a node that gives Evidence, got 3"));
  EXPECT_THAT(modalities(R"([ "edges" ])"),
              HasSubstr("expected { \"from\": a node that gives Evidence, ... }, got text"));
  EXPECT_THAT(
      modalities(R"([ { "from": "edgse" } ])"),
      HasSubstr("/nodes/3/modalities/0/from: there is no node \"edgse\"; did you mean \"edges\"?"));
  EXPECT_THAT(modalities(R"([ { "from": "boxes" } ])"),
              HasSubstr("node \"boxes\" gives Observations, not Evidence; above, \"edges\" does"));
  EXPECT_THAT(modalities(R"([ { "from": "edges", "weight": -1 } ])"),
              HasSubstr("/nodes/3/modalities/0/weight: expected real, >= 0, got -1"));
  EXPECT_THAT(modalities(R"([ { "from": "edges", "wait": 1 } ])"),
              HasSubstr("unknown key in \"modalities\" of \"grid\""));
  EXPECT_THAT(modalities(R"([ { "from": "edges" }, { "from": "edges" } ])"),
              HasSubstr("\"modalities\" reads \"edges\" twice"));
}

TEST_F(WiringTest, AnUnknownComponentCausesNoFurtherErrors) {
  EXPECT_EQ(
      node_errors("{ \"use\": \"synthetic\" },\n{ \"use\": \"bxes\" },\n{ \"use\": \"gnn\" },\n"
                  "{ \"use\": \"gnn\", \"name\": \"b\", \"from\": \"bxes\" }"),
      "p.json:3:10: /nodes/1/use: unknown component \"bxes\"; did you mean \"boxes\"?");
}

}  // namespace
}  // namespace plaza::test
