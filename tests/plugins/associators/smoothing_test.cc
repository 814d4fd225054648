#include <gtest/gtest.h>

#include "plugins/associators/gnn/target.h"

namespace plaza {
namespace {

std::vector<TargetSample> walk(int count, const Eigen::Vector2d& velocity) {
  std::vector<TargetSample> samples(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    TargetSample& s = samples[static_cast<std::size_t>(i)];
    s.frame = i;
    s.time_s = 0.1 * i;
    s.measured_m = 0.1 * i * velocity;
    s.position_m = s.measured_m + Eigen::Vector2d(0, 0.3);  // a filter that is off
    s.velocity_mps = {9, 9};
    s.weight = 1;
    s.observed = true;
  }
  return samples;
}

void lose(std::vector<TargetSample>& samples, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    samples[i].observed = false;
    samples[i].weight = 0;
    samples[i].measured_m.setZero();
  }
}

TEST(Smoothed, IsExactOnAStraightWalkEvenAtItsEnds) {
  const Eigen::Vector2d velocity(1.3, -0.4);
  const auto samples = walk(20, velocity);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const SmoothedPoint p = smoothed(samples, i, 0.5);
    EXPECT_LT((p.position_m - samples[i].measured_m).norm(), 1e-9) << i;
    EXPECT_LT((p.velocity_mps - velocity).norm(), 1e-9) << i;
  }
}

TEST(Smoothed, WithoutAWindowIsTheFilter) {
  const auto samples = walk(5, {1, 0});
  EXPECT_EQ(smoothed(samples, 2, 0).position_m, samples[2].position_m);
  EXPECT_EQ(smoothed(samples, 2, 0).velocity_mps, samples[2].velocity_mps);
}

TEST(Smoothed, TrustsCertainMeasurementsMore) {
  auto samples = walk(11, {0, 0});
  samples[5].measured_m = {1, 0};
  const double equal = smoothed(samples, 5, 0.5).position_m.x();
  samples[5].weight = 0.1;
  EXPECT_LT(smoothed(samples, 5, 0.5).position_m.x(), 0.3 * equal);
}

TEST(Smoothed, BridgesGapsOnALine) {
  const Eigen::Vector2d velocity(1, 0.5);
  auto samples = walk(20, velocity);
  lose(samples, 8, 12);
  for (std::size_t i = 8; i < 12; ++i) {
    const SmoothedPoint p = smoothed(samples, i, 0.5);
    EXPECT_LT((p.position_m - 0.1 * static_cast<double>(i) * velocity).norm(), 1e-9);
    EXPECT_LT((p.velocity_mps - velocity).norm(), 1e-9);
  }
}

TEST(Smoothed, FallsBackToThePredictionAfterTheLastObservation) {
  auto samples = walk(10, {1, 0});
  lose(samples, 7, 10);
  EXPECT_EQ(smoothed(samples, 8, 0.5).position_m, samples[8].position_m);
}

TEST(Smoothed, FallsBackToTheFilterWhereTooLittleIsSeen) {
  auto samples = walk(10, {1, 0});
  lose(samples, 1, 9);
  EXPECT_EQ(smoothed(samples, 0, 0.3).position_m, samples[0].position_m);
}

}  // namespace
}  // namespace plaza
