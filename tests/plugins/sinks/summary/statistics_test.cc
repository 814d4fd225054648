#include "plugins/sinks/summary/statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::summary {
namespace {

using test::track_point;

Trajectory straight(std::int64_t frames, double step_m) {
  Trajectory t;
  for (std::int64_t f = 0; f < frames; ++f) {
    t.push_back(track_point(4, f + 10, step_m * static_cast<double>(f), 2));
  }
  return t;
}

TEST(SummaryStatistics, StraightWalkIsMeasuredExactly) {
  const PersonFigures f = figures_of(straight(51, 0.15), 10);
  EXPECT_EQ(f.id, 4);
  EXPECT_EQ(f.first_frame, 10);
  EXPECT_EQ(f.last_frame, 60);
  EXPECT_NEAR(f.seconds, 5.1, 1e-12);
  EXPECT_NEAR(f.path_m, 7.5, 1e-9);
  EXPECT_NEAR(f.speed_m_per_s, 1.5, 1e-9);
  EXPECT_EQ(f.observed_share, 1);
}

TEST(SummaryStatistics, NoiseHardlyLengthensThePath) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.1);
  Trajectory t = straight(500, 0.05);  // 1.25 m/s at 25 Hz
  for (TrackPoint& p : t) p.position_m += Eigen::Vector2d(noise(random), noise(random));
  const double true_m = 0.05 * 499;
  double zigzag_m = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    zigzag_m += (t[i].position_m - t[i - 1].position_m).norm();
  }
  ASSERT_GT(zigzag_m, 2 * true_m);  // what a naive sum makes of it
  EXPECT_NEAR(figures_of(t, 25).path_m, true_m, 0.1 * true_m);
}

TEST(SummaryStatistics, SinglePointHasNoSpeed) {
  const PersonFigures f = figures_of({track_point(1, 3, 0, 0)}, 10);
  EXPECT_EQ(f.path_m, 0);
  EXPECT_EQ(f.speed_m_per_s, 0);
  EXPECT_NEAR(f.seconds, 0.1, 1e-12);
}

TEST(SummaryStatistics, AbsencesAreNotWalkedThrough) {
  Trajectory t = straight(11, 0.1);
  TrackPoint back = track_point(4, 500, 90, 2);
  t.push_back(back);
  back.frame = 501;
  back.position_m.x() = 90.1;
  t.push_back(back);
  const PersonFigures f = figures_of(t, 10);
  EXPECT_NEAR(f.path_m, 1.1, 1e-9);
  EXPECT_NEAR(f.speed_m_per_s, 1, 1e-9);
  EXPECT_NEAR(f.seconds, 1.3, 1e-12);
}

TEST(SummaryStatistics, ObservedShareCountsBridgedFrames) {
  Trajectory t = straight(4, 0.1);
  t[1].observed = false;
  EXPECT_DOUBLE_EQ(figures_of(t, 10).observed_share, 0.75);
}

TEST(SummaryStatistics, EmptyTrajectoryIsTheCallersMistake) {
  EXPECT_THROW(figures_of({}, 10), std::invalid_argument);
}

TEST(SummaryStatistics, CountsHoldEmptyFrames) {
  const Trajectories people = {{1, {track_point(1, 5, 0, 0), track_point(1, 6, 0, 0)}},
                               {2, {track_point(2, 6, 0, 0), track_point(2, 9, 0, 0)}}};
  const auto counts = people_per_frame(people, 4, 8);
  EXPECT_THAT(counts, testing::ElementsAre(0, 1, 2, 0));
  const CountFigures f = figures_of_counts(counts);
  EXPECT_EQ(f.least, 0);
  EXPECT_DOUBLE_EQ(f.mean, 0.75);
  EXPECT_EQ(f.most, 2);
  EXPECT_EQ(figures_of_counts({}).most, 0);
}

}  // namespace
}  // namespace plaza::summary
