#include "plugins/detectors/ground/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace plaza {
namespace {

constexpr double kDensity = 0.05;

ViewMeasurement at(std::size_t camera, double x, double y, double sigma = 0.2) {
  return {.camera = camera,
          .position_m = {x, y},
          .covariance_m2 = sigma * sigma * Eigen::Matrix2d::Identity()};
}

double evidence(const std::vector<MeasurementGroup>& groups) {
  double sum = 0;
  for (const auto& g : groups) sum += g.log_evidence;
  return sum;
}

/// Best evidence over all partitions, by trying them.
double exhaustive(const std::vector<ViewMeasurement>& m,
                  std::vector<std::vector<std::size_t>>& groups, std::size_t next) {
  if (next == m.size()) {
    double sum = 0;
    for (const auto& g : groups) sum += make_group(m, g, kDensity).log_evidence;
    return sum;
  }
  groups.push_back({next});
  double best = exhaustive(m, groups, next + 1);
  groups.pop_back();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (std::any_of(groups[g].begin(), groups[g].end(),
                    [&](std::size_t i) { return m[i].camera == m[next].camera; })) {
      continue;
    }
    groups[g].push_back(next);
    best = std::max(best, exhaustive(m, groups, next + 1));
    groups[g].pop_back();
  }
  return best;
}

TEST(MakeGroup, IsTheInformationWeightedMean) {
  const std::vector<ViewMeasurement> m = {at(0, 0, 0, 0.1), at(1, 1, 0, 0.2)};
  const MeasurementGroup g = make_group(m, {0, 1}, kDensity);
  EXPECT_NEAR(g.position_m.x(), 0.2, 1e-12);  // weights 100 and 25
  EXPECT_NEAR(g.covariance_m2(0, 0), 1.0 / 125, 1e-12);
  EXPECT_NEAR(g.covariance_m2(0, 1), 0, 1e-15);
}

TEST(MakeGroup, EvidenceOfTwoIsTheirDifferencesDensityOverThePeoples) {
  const std::vector<ViewMeasurement> m = {at(0, 0, 0, 0.3), at(1, 0.3, 0.4, 0.4)};
  const MeasurementGroup g = make_group(m, {0, 1}, kDensity);
  const double variance = 0.09 + 0.16;
  const double density = std::exp(-0.5 * 0.25 / variance) / (2 * std::numbers::pi * variance);
  EXPECT_NEAR(g.log_evidence, std::log(density / kDensity), 1e-12);
  EXPECT_EQ(make_group(m, {0}, kDensity).log_evidence, 0);
}

TEST(Partition, OfNothingIsNothing) { EXPECT_TRUE(partition({}, 3, kDensity).empty()); }

TEST(Partition, KeepsMeasurementsOfOneViewApart) {
  const std::vector<ViewMeasurement> m = {at(0, 0, 0), at(0, 0.01, 0)};
  EXPECT_EQ(partition(m, 1, kDensity).size(), 2U);
}

/// Two people 0.5 m apart, seen with opposite errors: the nearest measurement is the wrong one for
/// a greedy rule, the assignment of the whole view is right.
TEST(Partition, AssignsAViewAsAWhole) {
  const std::vector<ViewMeasurement> m = {at(0, 0.0, 0), at(0, 0.5, 0), at(1, 0.3, 0),
                                          at(1, 0.8, 0)};
  const auto groups = partition(m, 2, kDensity);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].members, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(groups[1].members, (std::vector<std::size_t>{1, 3}));
}

TEST(Partition, IsAsGoodAsTheBestOfAllPartitionsInSmallProblems) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> place(-1.2, 1.2);
  std::bernoulli_distribution seen(0.8);
  int optimal = 0;
  constexpr int kRuns = 150;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<ViewMeasurement> m;
    for (std::size_t person = 0; person < 3; ++person) {
      const Eigen::Vector2d p(place(random), place(random));
      for (std::size_t camera = 0; camera < 3; ++camera) {
        if (!seen(random)) continue;
        m.push_back(at(camera, p.x() + 0.2 * normal(random), p.y() + 0.2 * normal(random)));
      }
    }
    std::vector<std::vector<std::size_t>> none;
    const double best = exhaustive(m, none, 0);
    const double found = evidence(partition(m, 3, kDensity));
    ASSERT_LE(found, best + 1e-9);
    if (found > best - 1e-9) ++optimal;
  }
  EXPECT_GE(optimal, kRuns * 95 / 100);
}

TEST(Partition, EveryMeasurementIsInExactlyOneGroupAndViewsAreUnique) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-3, 3);
  std::vector<ViewMeasurement> m;
  for (std::size_t i = 0; i < 60; ++i) m.push_back(at(i % 6, place(random), place(random), 0.4));
  const auto groups = partition(m, 6, kDensity);
  std::vector<int> count(m.size(), 0);
  for (const auto& g : groups) {
    for (std::size_t k = 0; k < g.members.size(); ++k) {
      ++count[g.members[k]];
      if (k > 0) {
        EXPECT_LT(m[g.members[k - 1]].camera, m[g.members[k]].camera);
      }
    }
  }
  EXPECT_TRUE(std::all_of(count.begin(), count.end(), [](int c) { return c == 1; }));
  const auto again = partition(m, 6, kDensity);
  ASSERT_EQ(again.size(), groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) EXPECT_EQ(again[i].members, groups[i].members);
}

}  // namespace
}  // namespace plaza
