// The commands that tell about pipelines and components, run as the program runs them.
#include "tests/framework/config/pipeline_fixture.h"
#include "tests/support/program_in_process.h"

namespace plaza::test {
namespace {

using testing::HasSubstr;

class CommandsTest : public PipelineFixture {
 protected:
  static Outcome plaza(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--plugin-path", PLAZA_TEST_PLUGINS});
    return run_in_process(arguments);
  }
};

TEST_F(CommandsTest, ListIsATableByKind) {
  const Outcome all = plaza({"list"});
  EXPECT_EQ(all.status, 0);
  EXPECT_THAT(all.out, HasSubstr("source\n"));
  EXPECT_THAT(all.out, HasSubstr("  mixture"));
  const Outcome shapes = plaza({"list", "shape"});
  EXPECT_THAT(shapes.out, testing::StartsWith("shape\n"));
  EXPECT_THAT(shapes.out, HasSubstr("A box.\n"));
  EXPECT_THAT(shapes.out, testing::Not(HasSubstr("mixture")));
}

TEST_F(CommandsTest, ListSuggestsKinds) {
  const Outcome outcome = plaza({"list", "detectors"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.errors, "plaza: unknown kind \"detectors\"; did you mean \"detector\"?\n");
  EXPECT_THAT(plaza({"list", "zebra"}).errors, HasSubstr("there are \"source\", \"modality\""));
}

TEST_F(CommandsTest, ShowTellsEverythingOrSuggests) {
  EXPECT_THAT(plaza({"show", "mixture"}).out,
              testing::AllOf(HasSubstr("mixture, an affinity"), HasSubstr("affinity parts"),
                             HasSubstr("Library: ")));
  EXPECT_EQ(nlohmann::json::parse(plaza({"show", "mixture", "--json"}).out)["kind"], "affinity");
  const Outcome wrong = plaza({"show", "mixtrue"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("did you mean \"mixture\"?"));
  EXPECT_EQ(plaza({"show"}).status, 2);
}

TEST_F(CommandsTest, ShowPrintsTheSchema) {
  const nlohmann::json schema = nlohmann::json::parse(plaza({"show", "--schema"}).out);
  EXPECT_TRUE(schema["definitions"].contains("component.mixture"));
  EXPECT_EQ(plaza({"show", "mixture", "--schema"}).status, 2);
}

TEST_F(CommandsTest, GraphPrintsDot) {
  write("p.json", with_nodes(kWholeNodes));
  const Outcome outcome = plaza({"graph", "p.json", "--set", "/nodes/1/name=outlines", "--set",
                                 "/nodes/detector/modalities/0/from=outlines"});
  EXPECT_EQ(outcome.errors, "");
  EXPECT_THAT(outcome.out, testing::StartsWith("digraph pipeline {"));
  EXPECT_THAT(outcome.out, HasSubstr("outlines\\nedges"));
}

TEST_F(CommandsTest, GraphReportsFaultsAsCheckDoes) {
  write("p.json", with_nodes(R"({ "use": "synthetic", "frames": 0 })"));
  const Outcome outcome = plaza({"graph", "p.json"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.errors, "plaza: p.json:2:33: /nodes/0/frames: expected integer, >= 1, got 0\n");
}

}  // namespace
}  // namespace plaza::test
