#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "plaza/scoring/hota.h"
#include "plaza/scoring/identity.h"
#include "sequences.h"

namespace plaza {
namespace {

using testing_support::follow_one;
using testing_support::sequence_of;

TEST(Identity, OneTrajectoryKeepsOnePartner) {
  const IdentityScores s = score_identity(follow_one({1, 1, 1, 2, 2, 0}), 0.5);
  EXPECT_EQ(s.idtp, 3);
  EXPECT_EQ(s.idfp, 2);
  EXPECT_EQ(s.idfn, 3);
  EXPECT_DOUBLE_EQ(s.idf1(), 3 / 5.5);
  EXPECT_DOUBLE_EQ(s.idp(), 0.6);
  EXPECT_DOUBLE_EQ(s.idr(), 0.5);
}

TEST(Identity, TheThresholdHasNoTolerance) {
  const double just_less = std::nextafter(0.5, 0.0);
  Eigen::MatrixXd v(1, 1);
  v(0, 0) = 0.5;
  EXPECT_EQ(score_identity(sequence_of({{{1}, {1}, v}}), 0.5).idtp, 1);
  v(0, 0) = just_less;
  EXPECT_EQ(score_identity(sequence_of({{{1}, {1}, v}}), 0.5).idtp, 0);
}

TEST(Identity, CountsPairsThatNobodyMatched) {
  // Both results fit the person in every frame; either could be the partner.
  const Eigen::MatrixXd both = Eigen::MatrixXd::Constant(1, 2, 0.7);
  const IdentityScores s =
      score_identity(sequence_of({{{1}, {1, 2}, both}, {{1}, {1, 2}, both}}), 0.5);
  EXPECT_EQ(s.idtp, 2);
  EXPECT_EQ(s.idfp, 2);
  EXPECT_EQ(s.idfn, 0);
}

TEST(Identity, OfDistancesCountsWhatCanBe) {
  Eigen::MatrixXd d(1, 2);
  d << std::numeric_limits<double>::infinity(), 0.3;
  EXPECT_EQ(score_identity_of_distance(sequence_of({{{1}, {1, 2}, d}})).idtp, 1);
}

TEST(Identity, OfNothingIsZero) {
  const IdentityScores s = score_identity(follow_one({0, 0}), 0.5);
  EXPECT_EQ(s.idfn, 2);
  EXPECT_EQ(s.idf1(), 0);
  EXPECT_EQ(s.idp(), 0);
}

TEST(Hota, OfAPerfectTrackerIsOne) {
  const HotaScores s = score_hota(follow_one({4, 4, 4}));
  for (std::size_t a = 0; a < HotaScores::kThresholds; ++a) {
    EXPECT_DOUBLE_EQ(s.hota[a], 1);
    EXPECT_DOUBLE_EQ(s.owta[a], 1);
  }
  EXPECT_NEAR(s.alpha.back(), 0.95, 1e-12);
}

TEST(Hota, BrokenTrajectoryCostsAssociation) {
  // Two halves: each match shares 2 of 4 frames with its trajectory.
  const HotaScores s = score_hota(follow_one({1, 1, 2, 2}));
  EXPECT_DOUBLE_EQ(s.det_a[0], 1);
  EXPECT_DOUBLE_EQ(s.ass_a[0], 0.5);
  EXPECT_DOUBLE_EQ(s.ass_re[0], 0.5);
  EXPECT_DOUBLE_EQ(s.ass_pr[0], 1);
  EXPECT_DOUBLE_EQ(HotaScores::mean(s.hota), std::sqrt(0.5));
}

TEST(Hota, MatchesAtThresholdsUpToTheSimilarity) {
  const HotaScores s = score_hota(sequence_of({{{1}, {1}, Eigen::MatrixXd::Constant(1, 1, 0.5)}}));
  EXPECT_EQ(s.tp[9], 1) << "0.50 itself";
  EXPECT_EQ(s.tp[10], 0);
  EXPECT_DOUBLE_EQ(s.loc_a[9], 0.5);
  EXPECT_DOUBLE_EQ(s.loc_a[10], 1) << "by convention";
  EXPECT_DOUBLE_EQ(HotaScores::mean(s.hota), 10.0 / 19);
}

TEST(Hota, TheWholeSequenceDecidesAFrame) {
  // In frame 1 result 2 fits a little better, but 1 is the trajectory's partner everywhere else.
  std::vector<testing_support::FrameOf> frames{
      {{1}, {1, 2}, (Eigen::MatrixXd(1, 2) << 0.7, 0.8).finished()}};
  for (int i = 0; i < 5; ++i) frames.push_back({{1}, {1}, Eigen::MatrixXd::Ones(1, 1)});
  const HotaScores s = score_hota(sequence_of(frames));
  EXPECT_DOUBLE_EQ(s.ass_a[0], 1);
  EXPECT_EQ(s.tp[14], 5)
      << "at 0.75 the pair of 0.7 no longer matches, and 2 was not taken instead";
}

TEST(Hota, WithoutResults) {
  const HotaScores s = score_hota(follow_one({0, 0}));
  EXPECT_EQ(s.fn[0], 2);
  EXPECT_EQ(s.hota[0], 0);
  EXPECT_EQ(s.loc_a[0], 1);
}

}  // namespace
}  // namespace plaza
