#include "plugins/sinks/summary/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "plaza/core/error.h"
#include "plugins/sinks/drawing/palette.h"
#include "plugins/sinks/summary/trajectories.h"
#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::summary {
namespace {

using test::track_point;
using testing::HasSubstr;
using testing::Not;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Drives the sink as the kernel does.
class SummaryRun {
 public:
  explicit SummaryRun(Summary::Options options = {})
      : sink_(options, test::context_of(test::ring_scene(2), folder_.path())) {}

  void frame(std::int64_t f, std::vector<TrackPoint> points,
             std::optional<std::size_t> observations) {
    PayloadPtr slots[2];
    NodeIo io = this->io(f, std::move(points), slots);
    if (observations) {
      auto all = std::make_shared<Observations>();
      all->items.resize(*observations);
      slots[1] = all;
    }
    sink_.process(io);
  }
  void flush(std::int64_t f, std::vector<TrackPoint> points) {
    PayloadPtr slots[2];
    NodeIo io = this->io(f, std::move(points), slots);
    static_cast<Node&>(sink_).flush(io);
  }
  std::vector<Artifact> finish(bool complete) { return static_cast<Sink&>(sink_).finish(complete); }
  std::string page() const { return text_of(folder_.path() / "summary.md"); }
  cv::Mat plan() const { return cv::imread((folder_.path() / "plan.png").string()); }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  NodeIo io(std::int64_t f, std::vector<TrackPoint> points, PayloadPtr* slots) {
    auto tracks = std::make_shared<Tracks>();
    tracks->points = std::move(points);
    slots[0] = tracks;
    static constexpr int kInputs[] = {0, 1};
    return NodeIo(f, f * 100'000'000, slots, kInputs, {});
  }
  test::TemporaryFolder folder_;
  Summary sink_;
};

TEST(Summary, TellsOfPeopleAndCounts) {
  SummaryRun run;
  for (std::int64_t f = 0; f < 21; ++f) {
    std::vector<TrackPoint> points = {track_point(3, f, 0.1 * static_cast<double>(f), 0)};
    if (f >= 10) points.push_back(track_point(12, f, 1, 1));
    run.frame(f, points, 3);
  }
  const auto artifacts = run.finish(true);
  const std::string page = run.page();
  EXPECT_THAT(page, HasSubstr("# Ring\n"));
  EXPECT_THAT(page, HasSubstr("2 people in 21 frames (1 to 21), 2.1 s at 10 Hz, 2 cameras."));
  EXPECT_THAT(page, HasSubstr("| people | 1 | 1.52 | 2 |"));
  EXPECT_THAT(page, HasSubstr("| observations | 3 | 3.00 | 3 |"));
  EXPECT_THAT(page, HasSubstr("| 3 | 1 | 21 | 2.1 | 2.0 | 1.00 | 100 % |"));
  EXPECT_THAT(page, HasSubstr("| 12 | 11 | 21 | 1.1 | 0.0 | 0.00 | 100 % |"));
  EXPECT_THAT(page, HasSubstr("](plan.png)"));
  EXPECT_THAT(page, Not(HasSubstr("artial")));
  ASSERT_EQ(artifacts.size(), 2U);
  EXPECT_EQ(run.plan().cols, 1200);
}

TEST(Summary, LateTracksCountButTheFlushIsNoFrame) {
  SummaryRun run;
  for (std::int64_t f = 0; f < 5; ++f) run.frame(f, {}, std::nullopt);
  run.flush(5, {track_point(1, 2, 0, 0), track_point(1, 3, 0.1, 0)});
  run.finish(true);
  EXPECT_THAT(run.page(), HasSubstr("1 person in 5 frames"));
  EXPECT_THAT(run.page(), HasSubstr("| people | 0 | 0.40 | 1 |"));
  EXPECT_THAT(run.page(), Not(HasSubstr("observations |")));
}

TEST(Summary, OpenRowsAreNotPartOfTheAnswer) {
  SummaryRun run;
  TrackPoint open = track_point(1, 0, 0, 0);
  open.final = false;
  run.frame(0, {open, track_point(2, 0, 1, 1)}, std::nullopt);
  run.finish(true);
  EXPECT_THAT(run.page(), HasSubstr("1 person in 1 frame (1 to 1)"));
  EXPECT_THAT(run.page(), Not(HasSubstr("\n| 1 |")));
}

TEST(Summary, EndedEarlyItSaysSo) {
  SummaryRun run;
  run.frame(7, {track_point(1, 7, 0, 0)}, std::nullopt);
  const auto artifacts = run.finish(false);
  EXPECT_THAT(run.page(), HasSubstr("**Partial:"));
  EXPECT_THAT(run.page(), HasSubstr("1 person in 1 frame (8 to 8)"));
  for (const Artifact& a : artifacts) EXPECT_THAT(a.what, HasSubstr("partial"));
  EXPECT_FALSE(run.plan().empty());
}

TEST(Summary, NobodyAndNothingArePagesToo) {
  SummaryRun run;
  run.finish(false);
  EXPECT_THAT(run.page(), HasSubstr("0 people in 0 frames"));
  EXPECT_THAT(run.page(), HasSubstr("Nobody was tracked."));
  EXPECT_FALSE(run.plan().empty());
}

TEST(Summary, UnwritableFolderIsTheUsersError) {
  Summary sink({}, test::context_of(test::ring_scene(1), "/nowhere/at/all"));
  try {
    static_cast<Sink&>(sink).finish(true);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/at/all/plan.png"));
  }
}

TEST(Summary, CheckNamesEveryBadFileName) {
  Summary::Options options;
  options.file = "a/summary.md";
  options.plan = "plan.jpg";
  const Summary sink(options, test::context_of(test::ring_scene(1), "."));
  const Diagnostics faults = sink.check();
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].pointer, "/file");
  EXPECT_EQ(faults[1].pointer, "/plan");
  EXPECT_THAT(faults[1].message, HasSubstr(".png"));
}

int count_of(const cv::Mat& picture, TrackId id) {
  const drawing::Color c = drawing::color_of(id);
  const cv::Scalar off = cv::Scalar::all(24);
  cv::Mat mask;
  cv::inRange(picture, c - off, c + off, mask);
  return cv::countNonZero(mask);
}

Trajectories walk(TrackId id, bool observed, std::int64_t skip_from, std::int64_t skip_to) {
  Trajectories people;
  for (std::int64_t f = 0; f < 80; ++f) {
    if (f >= skip_from && f < skip_to) continue;
    TrackPoint p = track_point(id, f, -4 + 0.1 * static_cast<double>(f), 0);
    p.observed = observed || f < 10;
    people[id].push_back(p);
  }
  return people;
}

TEST(SummaryPlan, TrajectoriesHaveTheirColours) {
  const auto scene = test::ring_scene(2);
  const cv::Mat picture = draw_trajectories(*scene, walk(5, true, 0, 0), 800);
  EXPECT_EQ(picture.cols, 800);
  EXPECT_GT(count_of(picture, 5), 400);
  EXPECT_LT(count_of(picture, 6), 20);
}

TEST(SummaryPlan, BridgedStretchesAreDashedAndAbsencesAreLeftOut) {
  const auto scene = test::ring_scene(2);
  const int solid = count_of(draw_trajectories(*scene, walk(5, true, 0, 0), 800), 5);
  const int dashed = count_of(draw_trajectories(*scene, walk(5, false, 0, 0), 800), 5);
  const int absent = count_of(draw_trajectories(*scene, walk(5, true, 20, 60), 800), 5);
  EXPECT_LT(dashed, 0.9 * solid);
  EXPECT_LT(absent, 0.8 * solid);
}

TEST(SummaryPlan, SomeoneWhoStoodStillAndSomeoneFarAwayAreDrawn) {
  const auto scene = test::ring_scene(1);
  Trajectories people = {{1, {track_point(1, 0, 0, 0)}}, {2, {track_point(2, 0, 1e8, 1e8)}}};
  const cv::Mat picture = draw_trajectories(*scene, people, 400);
  EXPECT_GT(count_of(picture, 1), 20);
}

}  // namespace
}  // namespace plaza::summary
