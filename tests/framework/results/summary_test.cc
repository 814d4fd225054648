#include "framework/results/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/execution_doubles.h"

namespace plaza {
namespace {

Summary example() {
  Summary s;
  s.pipeline = "Lab";
  s.complete = true;
  s.frames = 795;
  s.cameras = 1;
  s.seconds = 12.5;
  s.nodes = {{"edges", "edges", 795, 3.1000004}};
  s.evaluation = {{"tracking", {{"MOTA", 0.5}}}};
  s.branches = {{"plain", {{"ground", {{"MOTA", 0.25}}}}}};
  return s;
}

TEST(SummaryTest, IsWhatTheContractSays) {
  EXPECT_EQ(
      summary_json(example()).dump(),
      R"({"plaza":1,"pipeline":"Lab","complete":true,"frames":795,"cameras":1,"seconds":12.5,)"
      R"("frames_per_second":63.6,"nodes":[{"name":"edges","use":"edges","calls":795,)"
      R"("seconds":3.1}],"evaluation":{"tracking":{"MOTA":0.5}},)"
      R"("branches":{"plain":{"ground":{"MOTA":0.25}}}})");
}

TEST(SummaryTest, SaysWhyItIsNotComplete) {
  Summary s = example();
  s.complete = false;
  s.reason = "interrupted";
  EXPECT_EQ(summary_json(s)["reason"], "interrupted");
  s.seconds = 0;
  EXPECT_EQ(summary_json(s)["frames_per_second"], 0.0);
}

TEST(SummaryTest, AMessageInAnotherEncodingStillGivesValidJson) {
  test::TemporaryFolder folder;
  Summary s = example();
  s.complete = false;
  s.reason = "caf\xe9";
  write_summary(folder.path(), s);
  const auto json = nlohmann::json::parse(test::read_text(folder / "summary.json"));
  EXPECT_THAT(json["reason"].get<std::string>(), ::testing::StartsWith("caf"));
}

}  // namespace
}  // namespace plaza
