#include "plaza/scoring/clear.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "sequences.h"

namespace plaza {
namespace {

using ::testing::ElementsAre;
using testing_support::follow_one;
using testing_support::matrix;
using testing_support::sequence_of;

TEST(Clear, CountsWhatIsThere) {
  const ClearScores s =
      score_clear(sequence_of({{{1, 2}, {5, 6, 7}, matrix({{0.9, 0, 0}, {0, 0.4, 0}})}}), 0.5);
  EXPECT_EQ(s.tp, 1);
  EXPECT_EQ(s.fn, 1);
  EXPECT_EQ(s.fp, 2);
  EXPECT_DOUBLE_EQ(s.recall(), 0.5);
  EXPECT_DOUBLE_EQ(s.precision(), 1.0 / 3);
  EXPECT_DOUBLE_EQ(s.moda(), -0.5);
  EXPECT_DOUBLE_EQ(s.motp(), 0.9);
  EXPECT_DOUBLE_EQ(s.f1(), 1 / 2.5);
  EXPECT_DOUBLE_EQ(s.smota(), (0.9 - 2) / 2);
}

TEST(Clear, ExactlyTheThresholdMatches) {
  EXPECT_EQ(score_clear(sequence_of({{{1}, {1}, matrix({{0.5}})}}), 0.5).tp, 1);
  const double just_less = 0.5 - 1e-12;
  EXPECT_EQ(score_clear(sequence_of({{{1}, {1}, matrix({{just_less}})}}), 0.5).tp, 0);
  EXPECT_EQ(score_clear(sequence_of({{{1}, {1}, matrix({{0.3}})}}), 0.3).tp, 1);
}

TEST(Clear, MaximisesTheSumAndNotTheNumberOfPairs) {
  // Two pairs of 0.5 and 0.55 sum to 1.05; one pair of 1 with the other below the threshold to 1.
  EXPECT_EQ(score_clear(sequence_of({{{1, 2}, {1, 2}, matrix({{1.0, 0.5}, {0.55, 0.0}})}}), 0.5).tp,
            2);
  // ... but a continuation outweighs any number of pairs.
  const ClearScores s =
      score_clear(sequence_of({{{1}, {1}, matrix({{0.9}})},
                               {{1, 2}, {1, 2}, matrix({{0.6, 0.9}, {0.9, 0.0}})}}),
                  0.5);
  EXPECT_EQ(s.tp, 2);
  EXPECT_EQ(s.id_switches, 0);
}

TEST(Clear, SwitchesAreCountedOverAnyGap) {
  EXPECT_EQ(score_clear(follow_one({1, 1, 2, 2}), 0.5).id_switches, 1);
  EXPECT_EQ(score_clear(follow_one({1, 0, 0, 2}), 0.5).id_switches, 1);
  EXPECT_EQ(score_clear(follow_one({1, 0, 0, 1}), 0.5).id_switches, 0);
  EXPECT_EQ(score_clear(follow_one({1, 2, 1, 2}), 0.5).id_switches, 3);
}

TEST(Clear, FramesWithoutResultsDoNotBreakTheLink) {
  // In the third frame both fit; id 1 was linked in the last processed frame, though 2 fits better.
  const ClearScores s = score_clear(sequence_of({{{1}, {1}, matrix({{0.9}})},
                                                 {{1}, {}, Eigen::MatrixXd(1, 0)},
                                                 {{1}, {1, 2}, matrix({{0.6, 0.9}})}}),
                                    0.5);
  EXPECT_EQ(s.id_switches, 0);
  EXPECT_DOUBLE_EQ(s.similarity_sum, 1.5);
  EXPECT_EQ(s.fragments, 0) << "the frame without results was not processed";
}

TEST(Clear, AMissedFrameBreaksTheLink) {
  const ClearScores s = score_clear(sequence_of({{{1}, {1}, matrix({{0.9}})},
                                                 {{1}, {3}, matrix({{0.0}})},
                                                 {{1}, {1, 2}, matrix({{0.6, 0.9}})}}),
                                    0.5);
  EXPECT_EQ(s.id_switches, 1);
  EXPECT_EQ(s.fragments, 1);
}

TEST(Clear, LifetimesDecideWhoIsTracked) {
  const auto tracked = [](const ClearScores& s) {
    return std::vector<std::int64_t>{s.mostly_tracked, s.partly_tracked, s.mostly_lost};
  };
  EXPECT_THAT(tracked(score_clear(follow_one({1, 1, 1, 1, 0}), 0.5)), ElementsAre(0, 1, 0))
      << "0.8 is not more";
  EXPECT_THAT(tracked(score_clear(follow_one({1, 1, 1, 1, 1, 0}), 0.5)), ElementsAre(1, 0, 0));
  EXPECT_THAT(tracked(score_clear(follow_one({1, 0, 0, 0, 0}), 0.5)), ElementsAre(0, 1, 0))
      << "0.2 is enough";
  EXPECT_THAT(tracked(score_clear(follow_one({1, 0, 0, 0, 0, 0}), 0.5)), ElementsAre(0, 0, 1));
}

TEST(Clear, LogarithmOfSwitches) {
  const ClearScores none = score_clear(follow_one({1, 1}), 0.5);
  EXPECT_DOUBLE_EQ(none.motal(), 1);
  const ClearScores two = score_clear(follow_one({1, 2, 1, 1}), 0.5);
  EXPECT_DOUBLE_EQ(two.motal(), (4 - std::log10(2.0)) / 4);
}

TEST(Clear, WithoutOneSideNothingIsScored) {
  const ClearScores no_result = score_clear(follow_one({0, 0}), 0.5);
  EXPECT_EQ(no_result.fn, 2);
  EXPECT_EQ(no_result.mostly_lost, 1);
  EXPECT_EQ(no_result.mota(), 0);
  EXPECT_THAT(no_result.present, ElementsAre(2));
  const ClearScores no_truth = score_clear(sequence_of({{{}, {1, 2}, Eigen::MatrixXd(0, 2)}}), 0.5);
  EXPECT_EQ(no_truth.fp, 2);
  EXPECT_EQ(no_truth.mota(), 0) << "nothing to divide by";
}

TEST(Clear, FramesMeans) {
  const ClearScores s = score_clear(sequence_of({{{1, 2}, {1, 2}, matrix({{0.6, 0}, {0, 0.8}})},
                                                 {{1}, {1}, matrix({{0.0}})},
                                                 {{1}, {1}, matrix({{1.0}})}}),
                                    0.5);
  EXPECT_THAT(s.frame_similarity, ElementsAre(0.7, 1.0)) << "frames without a match have no mean";
}

TEST(Clear, ThresholdMustBeAnOverlap) {
  for (const double threshold : {0.0, -1.0, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(score_clear(follow_one({1}), threshold), std::invalid_argument);
  }
}

}  // namespace
}  // namespace plaza
