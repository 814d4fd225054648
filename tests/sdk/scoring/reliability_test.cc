#include "plaza/scoring/reliability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/sdk/geometry/test_cameras.h"

namespace plaza {
namespace {

JudgedObservation judged(double score, bool right, double probability = 0.5) {
  JudgedObservation j;
  j.score = score;
  j.probability = probability;
  j.right = right;
  return j;
}

/// Least squared error of any non-decreasing function of the score, by trying every way of cutting
/// the sorted scores into stretches of one value.
double least_error(const std::vector<JudgedObservation>& sorted) {
  const std::size_t n = sorted.size();
  double best = std::numeric_limits<double>::infinity();
  for (unsigned cuts = 0; cuts < 1U << (n - 1); ++cuts) {
    double error = 0, last = -1;
    bool allowed = true;
    for (std::size_t begin = 0; begin < n && allowed;) {
      std::size_t end = begin + 1;
      while (end < n && (cuts >> (end - 1) & 1U) == 0) ++end;
      double mean = 0;
      for (std::size_t i = begin; i < end; ++i) mean += sorted[i].right ? 1 : 0;
      mean /= static_cast<double>(end - begin);
      allowed = mean >= last && (end == n || sorted[end - 1].score < sorted[end].score);
      for (std::size_t i = begin; i < end; ++i) {
        error += std::pow(mean - (sorted[i].right ? 1 : 0), 2);
      }
      last = mean;
      begin = end;
    }
    if (allowed) best = std::min(best, error);
  }
  return best;
}

double error_of(const std::vector<IsotonicBlock>& blocks) {
  double error = 0;
  for (const IsotonicBlock& b : blocks) {
    const double p = static_cast<double>(b.right) / static_cast<double>(b.count);
    error += static_cast<double>(b.right) * (1 - p) * (1 - p) +
             static_cast<double>(b.count - b.right) * p * p;
  }
  return error;
}

TEST(IsotonicBlocks, AreAsGoodAsTheBestOfAll) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<JudgedObservation> all;
    const auto count = 1 + random() % 10;
    for (unsigned i = 0; i < count; ++i) {
      const double score = static_cast<double>(random() % 7);
      all.push_back(judged(score, static_cast<double>(random() % 8) < 1 + score));
    }
    const auto blocks = isotonic_blocks(all);
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.score < b.score; });
    ASSERT_NEAR(error_of(blocks), least_error(all), 1e-9) << "trial " << trial;
    std::int64_t seen = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      seen += blocks[i].count;
      EXPECT_LE(blocks[i].low, blocks[i].mean_score);
      EXPECT_LE(blocks[i].mean_score, blocks[i].high + 1e-12);
      if (i == 0) continue;
      EXPECT_LT(blocks[i - 1].high, blocks[i].low);
      EXPECT_LT(blocks[i - 1].right * blocks[i].count, blocks[i].right * blocks[i - 1].count);
    }
    EXPECT_EQ(seen, static_cast<std::int64_t>(all.size()));
  }
  EXPECT_TRUE(isotonic_blocks({}).empty());
}

TEST(CalibrationCurve, FindsTheCurveThatMadeTheTruth) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto truth = [](double score) { return 1 / (1 + std::exp(-2 * (score - 3))); };
  std::vector<JudgedObservation> all;
  for (int i = 0; i < 20000; ++i) {
    const double score = 6 * uniform(random);
    all.push_back(judged(score, uniform(random) < truth(score)));
  }
  const auto curve = calibration_curve(all, 8);
  ASSERT_LE(curve.size(), 8U);
  for (double score = 0.5; score < 5.6; score += 0.1) {
    EXPECT_NEAR(curve_value(curve, score), truth(score), 0.07) << score;
  }
}

TEST(CalibrationCurve, IsWhatADetectorTakes) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<JudgedObservation> all;
    const auto count = 1 + random() % 60;
    for (unsigned i = 0; i < count; ++i) {
      all.push_back(judged(static_cast<double>(random() % 1000) / 9000, random() % 3 == 0));
    }
    const auto curve = calibration_curve(all, 4, 2);
    ASSERT_FALSE(curve.empty());
    EXPECT_LE(curve.size(), 4U);
    for (std::size_t i = 0; i < curve.size(); ++i) {
      EXPECT_GT(curve[i].probability, 0);
      EXPECT_LT(curve[i].probability, 1);
      EXPECT_DOUBLE_EQ(std::round(curve[i].score * 100), curve[i].score * 100);
      if (i == 0) continue;
      EXPECT_GT(curve[i].score, curve[i - 1].score);
      EXPECT_GE(curve[i].probability, curve[i - 1].probability);
    }
  }
  EXPECT_TRUE(calibration_curve({}, 4).empty());
}

TEST(CalibrationCurve, NothingMakesCertain) {
  const std::vector<JudgedObservation> all(9, judged(2, true));
  const auto curve = calibration_curve(all, 4);
  ASSERT_EQ(curve.size(), 1U);
  EXPECT_DOUBLE_EQ(curve[0].probability, 0.95);
  const std::vector<JudgedObservation> many(100000, judged(2, true));
  EXPECT_DOUBLE_EQ(calibration_curve(many, 4)[0].probability, 0.999);
}

TEST(CurveValue, IsLinearBetweenAndFlatBeyond) {
  const std::vector<CurvePoint> curve = {{1, 0.2}, {3, 0.6}};
  EXPECT_DOUBLE_EQ(curve_value(curve, 0), 0.2);
  EXPECT_DOUBLE_EQ(curve_value(curve, 2), 0.4);
  EXPECT_DOUBLE_EQ(curve_value(curve, 9), 0.6);
}

TEST(Reliability, BinsBrierAndErrorByHand) {
  const std::vector<JudgedObservation> all = {judged(0, false, 0.1), judged(0, true, 0.3),
                                              judged(0, true, 0.9), judged(0, true, 1.0)};
  const auto bins = reliability_bins(all, 2);
  ASSERT_EQ(bins.size(), 2U);
  EXPECT_EQ(bins[0].count, 2);
  EXPECT_DOUBLE_EQ(bins[0].mean_probability, 0.2);
  EXPECT_DOUBLE_EQ(bins[0].right_share, 0.5);
  EXPECT_EQ(bins[1].count, 2) << "1 is in the last bin";
  EXPECT_DOUBLE_EQ(*calibration_error(bins), (2 * 0.3 + 2 * 0.05) / 4);
  EXPECT_DOUBLE_EQ(*brier_score(all), (0.01 + 0.49 + 0.01) / 4);
  EXPECT_NEAR(*log_loss(all), -(std::log(0.9) + std::log(0.3) + std::log(0.9)) / 4, 1e-6);
  EXPECT_FALSE(brier_score({}));
  EXPECT_FALSE(log_loss({}));
  EXPECT_FALSE(calibration_error(reliability_bins({}, 3)));
}

TEST(Consistency, OfErrorsThatAreAsLargeAsTheySay) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0, 1);
  Eigen::Matrix2d covariance;
  covariance << 0.09, 0.03, 0.03, 0.04;
  const Eigen::Matrix2d root = covariance.llt().matrixL();
  std::vector<double> errors, doubled;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector2d error = root * Eigen::Vector2d(normal(random), normal(random));
    errors.push_back(normalised_error(error, covariance));
    doubled.push_back(normalised_error(2 * error, covariance));
  }
  const auto good = consistency_of(errors), bad = consistency_of(doubled);
  ASSERT_TRUE(good && bad);
  EXPECT_NEAR(good->inside_50, 0.5, 0.01);
  EXPECT_NEAR(good->inside_90, 0.9, 0.01);
  EXPECT_NEAR(good->mean, 1, 0.03);
  EXPECT_NEAR(good->median_ratio, 1, 0.03);
  EXPECT_NEAR(bad->mean, 4, 0.1);
  EXPECT_NEAR(bad->median_ratio, 4, 0.1);
  EXPECT_FALSE(consistency_of({}));
}

TEST(Judgement, ForgivesWhoFollowsPeopleWhoDoNotCount) {
  Scene scene;
  scene.cameras.push_back(Camera::pinhole("a", {640, 480}, test::intrinsics(),
                                          test::look_at({0, -20, 6}, {0, 0, 0.8})));
  const auto person = [&](double x, double visibility) {
    TruePerson p;
    p.id = static_cast<std::int64_t>(10 + x);
    p.position_m = Eigen::Vector2d(x, 0);
    p.views.push_back({0, *body_box(scene.cameras[0], *p.position_m, scene.body), visibility});
    return p;
  };
  const auto observation = [](double x) {
    Observation o;
    o.position_m = {x, 0};
    o.covariance_m2 = 0.01 * Eigen::Matrix2d::Identity();
    o.probability = 0.7;
    o.score = x;
    return o;
  };
  GroundTruth truth;
  truth.people = {person(0, 1), person(4, 0.1)};
  Observations results;
  results.items = {observation(0.1), observation(4), observation(-4)};
  Judgement judgement;
  judgement.add(scene, truth, results, 0.3);
  ASSERT_EQ(judgement.observations.size(), 2U);
  EXPECT_TRUE(judgement.observations[0].right);
  EXPECT_FALSE(judgement.observations[1].right);
  EXPECT_EQ(judgement.observations[1].score, -4);
  EXPECT_EQ(judgement.people, 1);
  ASSERT_EQ(judgement.normalised_errors.size(), 1U);
  EXPECT_NEAR(judgement.normalised_errors[0], 1, 1e-9);
  truth.annotated = false;
  judgement.add(scene, truth, results, 0.3);
  EXPECT_EQ(judgement.observations.size(), 2U);
}

}  // namespace
}  // namespace plaza
