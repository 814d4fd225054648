#include <gmock/gmock.h>

#include "framework/plugin/loader.h"
#include "tests/framework/plugin/fixture_paths.h"

namespace plaza {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(ProbeTest, ReportsWhatAUsableLibraryGives) {
  const ProbeResult result = probe_plugin(fixture_library("valid"));
  EXPECT_TRUE(result.usable);
  EXPECT_EQ(result.report, "describer fixture-first, describer fixture-other");
}

TEST(ProbeTest, ReportsWhyALibraryIsRefused) {
  const ProbeResult result = probe_plugin(fixture_library("throwing"));
  EXPECT_FALSE(result.usable);
  EXPECT_TRUE(result.answered);
  EXPECT_THAT(result.report, HasSubstr("the licence server is on holiday"));
  EXPECT_THAT(probe_plugin("/nowhere/plaza_x.so").report, StartsWith("can't be read: "));
}

TEST(ProbeTest, ACrashIsALineInAReport) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers turn the signal into an exit status";
#endif
  const ProbeResult result = probe_plugin(fixture_library("crashing"));
  EXPECT_FALSE(result.usable);
  EXPECT_FALSE(result.answered);
  EXPECT_EQ(result.report, "crashed with SIGSEGV while loading");
  EXPECT_EQ(probe_plugin(fixture_library("crashing-early")).report,
            "crashed with SIGABRT while loading");
}

TEST(ProbeTest, ALibraryThatEndsTheProcessIsReported) {
  const ProbeResult result = probe_plugin(fixture_library("exiting"));
  EXPECT_FALSE(result.usable);
  EXPECT_EQ(result.report, "ended the process with status 7 while loading");
}

TEST(ProbeTest, ProbingLoadsNothingIntoThisProcess) {
  const TemporaryFolder folder;  // a copy that no other test of this process has loaded
  std::filesystem::copy_file(fixture_library("valid"), folder.path() / "plaza_copy.so");
  EXPECT_TRUE(probe_plugin(folder.path() / "plaza_copy.so").usable);
  std::ifstream maps("/proc/self/maps");
  const std::string text{std::istreambuf_iterator<char>(maps), {}};
  EXPECT_EQ(text.find("plaza_copy.so"), std::string::npos);
}

TEST(ProbeTest, ASurveySurvivesWhatEndsTheProcess) {
  Registry registry;
  survey_plugins({fixture_folder("crashing"), fixture_folder("exiting"), fixture_folder("valid")},
                 registry);
  EXPECT_NE(registry.find("fixture-first"), nullptr);
  ASSERT_EQ(registry.refused().size(), 2U);
  EXPECT_THAT(registry.refused()[0].reason, HasSubstr("while loading"));
  EXPECT_THAT(registry.refused()[0].provides, testing::ElementsAre("crashing"));
}

}  // namespace
}  // namespace plaza
