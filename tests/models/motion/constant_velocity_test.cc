#include "models/motion/constant_velocity.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <random>

#include "plaza/contract/gtest.h"

namespace plaza {
namespace {

ConstantVelocity model(double acceleration = 1.0, double speed = 1.0) {
  return ConstantVelocity({.acceleration_sigma = acceleration, .initial_speed_sigma_mps = speed},
                          BuildContext{});
}

const Eigen::Matrix2d kVariance = 0.04 * Eigen::Matrix2d::Identity();

TEST(ConstantVelocity, StartsWhereItWasSeenAndAtRest) {
  const ConstantVelocity m = model();
  const MotionState s = m.start({1, 2}, kVariance);
  EXPECT_EQ(m.position(s), Eigen::Vector2d(1, 2));
  EXPECT_EQ(m.velocity(s), Eigen::Vector2d(0, 0));
  EXPECT_TRUE(m.position_covariance(s).isApprox(kVariance));
}

TEST(ConstantVelocity, TwoShortStepsEqualALongOne) {
  const ConstantVelocity m = model(0.7);
  MotionState s = m.start({1, 2}, kVariance);
  s = m.correct(m.predict(s, 0.1), {1.1, 2.05}, kVariance);
  const MotionState once = m.predict(s, 0.9);
  const MotionState thrice = m.predict(m.predict(m.predict(s, 0.5), 0.3), 0.1);
  EXPECT_TRUE(once.mean.isApprox(thrice.mean, 1e-12));
  EXPECT_TRUE(once.covariance.isApprox(thrice.covariance, 1e-12));
}

TEST(ConstantVelocity, NoTimeChangesNothing) {
  const ConstantVelocity m = model();
  const MotionState s = m.start({1, 2}, kVariance);
  const MotionState same = m.predict(s, 0);
  EXPECT_EQ(same.mean, s.mean);
  EXPECT_EQ(same.covariance, s.covariance);
  EXPECT_THROW(m.predict(s, -0.1), std::invalid_argument);
}

TEST(ConstantVelocity, VelocityGainsTheDeclaredSpreadInOneSecond) {
  const ConstantVelocity m = model(0.5, 1e-6);
  const MotionState s = m.predict(m.start({0, 0}, kVariance), 1.0);
  EXPECT_NEAR(std::sqrt(s.covariance(2, 2)), 0.5, 1e-6);
  EXPECT_NEAR(std::sqrt(s.covariance(3, 3)), 0.5, 1e-6);
  EXPECT_NEAR(s.covariance(0, 0), 0.04 + 0.25 / 3, 1e-6);
}

TEST(ConstantVelocity, LearnsTheVelocityOfAWalker) {
  const ConstantVelocity m = model(0.1);
  const Eigen::Vector2d velocity(1.2, -0.5);
  MotionState s = m.start({0, 0}, kVariance);
  for (int i = 1; i <= 50; ++i) s = m.correct(m.predict(s, 0.1), 0.1 * i * velocity, kVariance);
  EXPECT_LT((m.velocity(s) - velocity).norm(), 0.05);
  EXPECT_LT((m.position(m.predict(s, 1.0)) - 6.0 * velocity).norm(), 0.1);
}

TEST(ConstantVelocity, ExactMeasurementsKeepTheCovarianceValid) {
  const ConstantVelocity m = model();
  const Eigen::Matrix2d exact = 1e-14 * Eigen::Matrix2d::Identity();
  MotionState s = m.start({0, 0}, exact);
  for (int i = 1; i <= 200; ++i) {
    s = m.correct(m.predict(s, 1e-3), {0.001 * i, 0}, exact);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen{Eigen::Matrix4d(s.covariance)};
    ASSERT_GE(eigen.eigenvalues().minCoeff(), 0);
  }
}

/// Paths drawn from the model itself: the normalised error squared has mean 2.
TEST(ConstantVelocity, CovarianceIsThatOfTheErrors) {
  constexpr double kAcceleration = 0.8, kSpeed = 1.1, kDt = 0.2;
  const ConstantVelocity m = model(kAcceleration, kSpeed);
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  const auto draw = [&](double sigma) {
    return Eigen::Vector2d(sigma * normal(random), sigma * normal(random));
  };
  double nees = 0;
  constexpr int kRuns = 1500;
  for (int run = 0; run < kRuns; ++run) {
    Eigen::Vector2d position = draw(3), velocity = draw(kSpeed);
    MotionState s = m.start(position + draw(0.2), kVariance);
    for (int i = 0; i < 8; ++i) {
      // exact noise of one step: velocity gains a, position the integral, correlated with it
      const Eigen::Vector2d a = draw(kAcceleration * std::sqrt(kDt));
      const Eigen::Vector2d b = draw(kAcceleration * std::sqrt(kDt * kDt * kDt / 12));
      position += kDt * velocity + 0.5 * kDt * a + b;
      velocity += a;
      s = m.predict(s, kDt);
      if (i % 3 != 2) s = m.correct(s, position + draw(0.2), kVariance);
    }
    const Eigen::Vector2d e = m.position(s) - position;
    nees += e.dot(m.position_covariance(s).inverse() * e) / kRuns;
  }
  EXPECT_NEAR(nees, 2.0, 0.25);
}

TEST(ConstantVelocity, KeepsTheContract) {
  contract::expect_kept(contract::subject_of<ConstantVelocity>());
}

}  // namespace
}  // namespace plaza
