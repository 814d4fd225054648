// Every broken scene in this folder gets exactly the diagnostics that NAME.expected holds, from the
// reader and from `plaza check`, which exits with 2 and leaves nothing behind.
#include "framework/scene/scene_file.h"
#include "tests/support/golden_cases.h"

namespace plaza::test {
namespace {

class ErrorScenes : public GoldenCase {
 protected:
  ErrorScenes() : GoldenCase("scenes") {}
};

TEST_P(ErrorScenes, AreExplained) {
  const auto error = expect_explained([&] { read_scene(input()); });
  ASSERT_TRUE(error);
  for (const Diagnostic& d : error->diagnostics()) {
    EXPECT_FALSE(d.where.file.empty()) << d.message;
    EXPECT_GT(d.where.line, 0) << d.message;
  }
}

TEST_P(ErrorScenes, AreRefusedByTheProgram) {
  expect_refused(std::string(PLAZA_PROGRAM) + " check " + input());
}

INSTANTIATE_TEST_SUITE_P(All, ErrorScenes, testing::ValuesIn(GoldenFolder("scenes").names()),
                         golden_test_name);

TEST(ErrorScenesFolder, HoldsNoExpectationWithoutItsScene) {
  GoldenFolder("scenes").expect_whole({".expected"}, 10);
}

}  // namespace
}  // namespace plaza::test
