// Every broken pipeline in this folder gets exactly the diagnostics that NAME.expected holds: from
// the reader, and from `plaza check`, which exits with 2 and leaves nothing behind. Beside
// NAME.json there may be a NAME.sets, one --set per line.
#include <fstream>

#include "framework/config/pipeline.h"
#include "tests/support/golden_cases.h"
#include "tests/support/test_components.h"

namespace plaza::test {
namespace {

class ErrorPipelines : public GoldenCase {
 protected:
  ErrorPipelines() : GoldenCase("pipelines") {}

  std::vector<std::string> sets() const {
    std::vector<std::string> sets;
    std::ifstream in(folder().path() / (GetParam() + ".sets"));
    for (std::string line; std::getline(in, line);) sets.push_back(line);
    return sets;
  }
};

TEST_P(ErrorPipelines, AreExplained) {
  const Registry registry = make_registry();
  expect_explained([&] {
    const PipelineInScene read = read_pipeline_in_scene({input(), sets()}, registry);
    assemble(read.pipeline, read.scene, "out");
  });
}

TEST_P(ErrorPipelines, AreRefusedByTheProgram) {
  std::string command = std::string(PLAZA_CHECK_PROGRAM) + " check " + input() + " --plugin-path " +
                        PLAZA_TEST_PLUGINS;
  for (const std::string& set : sets()) command += " --set '" + set + "'";
  expect_refused(command);
}

INSTANTIATE_TEST_SUITE_P(All, ErrorPipelines, testing::ValuesIn(GoldenFolder("pipelines").names()),
                         golden_test_name);

TEST(ErrorPipelinesFolder, HoldsNoExpectationWithoutItsPipeline) {
  GoldenFolder("pipelines").expect_whole({".expected", ".sets"}, 30);
}

}  // namespace
}  // namespace plaza::test
