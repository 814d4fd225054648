#include "plaza/scoring/persistent_clear.h"

#include <gtest/gtest.h>

#include <limits>

#include "sequences.h"

namespace plaza {
namespace {

using testing_support::matrix;
using testing_support::sequence_of;

constexpr double kFar = std::numeric_limits<double>::infinity();

TEST(PersistentClear, TakesUpAnOldIdentityAfterAnyGap) {
  const PersistentClearScores s =
      score_persistent_clear(sequence_of({{{1}, {1}, matrix({{0.0}})},
                                          {{1}, {3}, matrix({{kFar}})},
                                          {{1}, {1, 2}, matrix({{0.8, 0.1}})}}));
  EXPECT_EQ(s.switches, 0);
  EXPECT_EQ(s.matches, 2);
  EXPECT_EQ(s.misses, 1);
  EXPECT_EQ(s.false_positives, 2);
  EXPECT_EQ(s.fragments, 1);
  EXPECT_DOUBLE_EQ(*s.mean_distance(), 0.4);
  EXPECT_DOUBLE_EQ(*s.mota(), 0);
}

TEST(PersistentClear, MakesAsManyPairsAsPossible) {
  const auto s =
      score_persistent_clear(sequence_of({{{1, 2}, {1, 2}, matrix({{0.0, 0.9}, {0.9, kFar}})}}));
  EXPECT_EQ(s.matches, 2);
  EXPECT_DOUBLE_EQ(s.distance_sum, 1.8);
}

TEST(PersistentClear, EarlierRowsTakeTheirIdentityFirst) {
  // Result 1 went from person 1 to person 2: both remember it, the first row gets it.
  const auto s = score_persistent_clear(sequence_of({{{1}, {1}, matrix({{0.1}})},
                                                     {{2}, {1}, matrix({{0.1}})},
                                                     {{1, 2}, {1}, matrix({{0.9}, {0.1}})}}));
  EXPECT_DOUBLE_EQ(s.distance_sum, 1.1);
  EXPECT_EQ(s.transfers, 1);
  EXPECT_EQ(s.migrates, 1);
  EXPECT_EQ(s.switches, 0);
}

TEST(PersistentClear, TellsKindsOfSwitches) {
  // Person 1 goes from 1 to 2, which is new: an ascent. Then person 2 appears under 1: a transfer.
  const auto s =
      score_persistent_clear(sequence_of({{{1}, {1}, matrix({{0.1}})},
                                          {{1}, {2}, matrix({{0.1}})},
                                          {{1, 2}, {2, 1}, matrix({{0.1, kFar}, {kFar, 0.1}})}}));
  EXPECT_EQ(s.switches, 1);
  EXPECT_EQ(s.ascends, 1);
  EXPECT_EQ(s.transfers, 1);
  EXPECT_EQ(s.migrates, 1);
  EXPECT_EQ(s.matches, 3);
  EXPECT_EQ(s.detections(), 4);
}

TEST(PersistentClear, LifetimesIncludeTheBounds) {
  const auto share = [](int matched, int frames) {
    std::vector<testing_support::FrameOf> all;
    for (int i = 0; i < frames; ++i)
      all.push_back({{1}, {1}, matrix({{i < matched ? 0.0 : kFar}})});
    const auto s = score_persistent_clear(sequence_of(all));
    return s.mostly_tracked * 100 + s.partly_tracked * 10 + s.mostly_lost;
  };
  EXPECT_EQ(share(4, 5), 100);
  EXPECT_EQ(share(3, 4), 10);
  EXPECT_EQ(share(1, 5), 10);
  EXPECT_EQ(share(1, 6), 1);
}

TEST(PersistentClear, MissesAtTheEndsAreNoFragments) {
  std::vector<testing_support::FrameOf> frames;
  for (const double d : {kFar, 0.0, kFar, kFar, 0.0, kFar})
    frames.push_back({{1}, {1}, matrix({{d}})});
  EXPECT_EQ(score_persistent_clear(sequence_of(frames)).fragments, 1);
}

TEST(PersistentClear, NothingToDivideByIsNothing) {
  const auto s = score_persistent_clear(sequence_of({{{}, {}, Eigen::MatrixXd(0, 0)}}));
  EXPECT_FALSE(s.mota());
  EXPECT_FALSE(s.mean_distance());
  EXPECT_FALSE(s.precision());
  EXPECT_FALSE(s.recall());
}

}  // namespace
}  // namespace plaza
