#include "plaza/scoring/detection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "sequences.h"

namespace plaza {
namespace {

using testing_support::matrix;
using testing_support::sequence_of;

TEST(OverlapDetection, CountsAndAverages) {
  const DetectionScores s = score_overlap_detection(
      sequence_of({{{1, 2}, {1, 2, 3}, matrix({{0.4, 0, 0.1}, {0, 0.8, 0}})},
                   {{1}, {1}, matrix({{0.9}})},
                   {{1}, {1}, matrix({{0.2}})}}),
      0.3);
  EXPECT_EQ(s.tp, 3);
  EXPECT_EQ(s.fn, 1);
  EXPECT_EQ(s.fp, 2);
  EXPECT_DOUBLE_EQ(*s.moda(), 1 - 3.0 / 4);
  EXPECT_DOUBLE_EQ(*s.modp(), 2.1 / 3);
  EXPECT_DOUBLE_EQ(*s.frame_modp(), (0.6 + 0.9) / 2)
      << "(3.3): frames weigh alike, those without a match not";
  EXPECT_DOUBLE_EQ(*s.precision(), 0.6);
  EXPECT_DOUBLE_EQ(*s.recall(), 0.75);
  EXPECT_DOUBLE_EQ(*s.f1(), 6.0 / 9);
}

TEST(OverlapDetection, HasNoMemory) {
  // In the second frame the better box wins, whatever it was called before.
  const DetectionScores s = score_overlap_detection(
      sequence_of({{{1}, {1}, matrix({{0.9}})}, {{1}, {1, 2}, matrix({{0.6, 0.9}})}}), 0.5);
  EXPECT_DOUBLE_EQ(s.goodness_sum, 1.8);
}

TEST(DistanceDetection, IsStrictlyNearer) {
  EXPECT_EQ(score_distance_detection(sequence_of({{{1}, {1}, matrix({{0.5}})}}), 0.5).tp, 0);
  const DetectionScores s =
      score_distance_detection(sequence_of({{{1}, {1}, matrix({{0.2}})}}), 0.5);
  EXPECT_EQ(s.tp, 1);
  EXPECT_DOUBLE_EQ(*s.modp(), 0.6);
}

TEST(DistanceDetection, MakesPairsFirst) {
  const DetectionScores s = score_distance_detection(
      sequence_of({{{1, 2}, {1, 2}, matrix({{0.0, 0.4}, {0.4, 7.0}})}}), 0.5);
  EXPECT_EQ(s.tp, 2);
  EXPECT_NEAR(*s.modp(), 0.2, 1e-12);
}

TEST(Detection, NothingToDivideByIsNothing) {
  const DetectionScores s = score_overlap_detection(sequence_of({}), 0.5);
  EXPECT_FALSE(s.moda());
  EXPECT_FALSE(s.modp());
  EXPECT_FALSE(s.frame_modp());
  EXPECT_FALSE(s.precision());
  EXPECT_FALSE(s.recall());
  EXPECT_FALSE(s.f1());
  EXPECT_THROW(score_overlap_detection(sequence_of({}), 0), std::invalid_argument);
  EXPECT_THROW(score_distance_detection(sequence_of({}), -1), std::invalid_argument);
}

}  // namespace
}  // namespace plaza
