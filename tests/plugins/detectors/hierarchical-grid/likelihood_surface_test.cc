#include "plugins/detectors/hierarchical-grid/likelihood_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace plaza {
namespace {

const double kNan = std::nan("");
const GroundGrid kGrid{.origin_m = {1, 2}, .step_m = {0.5, 0.25}, .columns = 9, .rows = 7};
constexpr std::size_t kCells = 63;

std::size_t at(int column, int row) { return static_cast<std::size_t>(row * 9 + column); }

std::vector<double> surface_of(double (*f)(double x, double y)) {
  std::vector<double> out;
  for (int r = 0; r < 7; ++r) {
    for (int c = 0; c < 9; ++c) out.push_back(f(1 + 0.5 * c, 2 + 0.25 * r));
  }
  return out;
}

TEST(Smoothed, IsTheWeightedMeanOfLikelihoods) {
  const auto neighbours = gaussian_neighbours(kGrid, 0.2);  // reaches 1 column and 2 rows
  std::vector<double> log_likelihood(kCells, -4);
  log_likelihood[at(4, 3)] = 0;
  const auto s = smoothed(kGrid, log_likelihood, neighbours);
  for (const Neighbour& n : neighbours) {
    // a row further the kernel would reach beyond the border
    if (std::abs(n.rows) > 1) continue;
    const double expected = std::log(std::exp(-4) * (1 - n.weight) + n.weight);
    EXPECT_NEAR(s[at(4 - n.columns, 3 - n.rows)], expected, 1e-12);
  }
  EXPECT_NEAR(s[at(0, 3)], -4, 1e-12) << "too far away";
}

TEST(Smoothed, OneCellIsLikeAll) {
  const auto neighbours = gaussian_neighbours(kGrid, 0.3);
  auto log_likelihood = surface_of([](double x, double y) { return 3 * std::sin(2 * x) - y * y; });
  for (const std::size_t unknown : {at(0, 0), at(4, 3), at(5, 3)}) log_likelihood[unknown] = kNan;
  const auto all = smoothed(kGrid, log_likelihood, neighbours);
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    const double one = smoothed_at(kGrid, log_likelihood, neighbours, static_cast<CellIndex>(cell));
    if (std::isnan(all[cell])) {
      EXPECT_TRUE(std::isnan(one)) << cell;
    } else {
      EXPECT_NEAR(one, all[cell], 1e-12) << cell;
    }
  }
}

TEST(Smoothed, LeavesOutWhatIsUnknown) {
  const auto neighbours = gaussian_neighbours(kGrid, 0.3);
  std::vector<double> log_likelihood(kCells, -2);
  for (int r = 0; r < 7; ++r) log_likelihood[at(3, r)] = kNan;
  const auto s = smoothed(kGrid, log_likelihood, neighbours);
  EXPECT_TRUE(std::isnan(s[at(3, 3)]));
  EXPECT_NEAR(s[at(4, 3)], -2, 1e-12) << "an unknown neighbour pulls nothing down";
  EXPECT_NEAR(s[at(0, 0)], -2, 1e-12) << "nor does the border";
  const auto none = smoothed(kGrid, std::vector<double>(kCells, kNan), neighbours);
  EXPECT_TRUE(std::all_of(none.begin(), none.end(), [](double v) { return std::isnan(v); }));
}

TEST(Smoothed, StaysFiniteOverAnyRange) {
  std::vector<double> log_likelihood(kCells, -1e6);
  log_likelihood[at(8, 6)] = 1e6;
  for (const double v : smoothed(kGrid, log_likelihood, gaussian_neighbours(kGrid, 0.3))) {
    EXPECT_TRUE(std::isfinite(v));
  }
}

TEST(LocalMaxima, AreHigherThanAllWithinTheGate) {
  const auto neighbours = gaussian_neighbours(kGrid, 0.3);
  std::vector<double> surface(kCells, -4);
  surface[at(1, 3)] = 1;
  surface[at(3, 3)] = 2;    // 1 m away, beyond the gate of 0.9 m
  surface[at(3, 5)] = 1.5;  // 0.5 m away from it
  surface[at(8, 0)] = kNan;
  const std::vector<char> all(kCells, 1);
  const auto maxima = local_maxima(kGrid, surface, all, neighbours);
  EXPECT_THAT(maxima, ::testing::IsSupersetOf({at(1, 3), at(3, 3)}));
  EXPECT_THAT(maxima, ::testing::Not(::testing::Contains(at(3, 5))));
  EXPECT_THAT(maxima, ::testing::Not(::testing::Contains(at(8, 0))));
}

TEST(LocalMaxima, OfEqualNeighboursTheFirstStays) {
  const auto neighbours = gaussian_neighbours(kGrid, 0.3);
  std::vector<double> surface(kCells, kNan);
  surface[at(4, 3)] = surface[at(5, 3)] = 1;
  const std::vector<char> all(kCells, 1);
  EXPECT_THAT(local_maxima(kGrid, surface, all, neighbours), ::testing::ElementsAre(at(4, 3)));
  std::vector<char> not_the_first = all;
  not_the_first[at(4, 3)] = 0;
  EXPECT_THAT(local_maxima(kGrid, surface, not_the_first, neighbours), ::testing::IsEmpty())
      << "an equal cell that is no candidate still counts";
}

TEST(PeakAt, FindsTheSummitAndTheCovarianceOfAGaussian) {
  // log of a Gaussian at (3.1, 2.8) with covariance [0.09 0.03; 0.03 0.04]
  const auto surface = surface_of([](double x, double y) {
    Eigen::Matrix2d c;
    c << 0.09, 0.03, 0.03, 0.04;
    const Eigen::Vector2d d(x - 3.1, y - 2.8);
    return -0.5 * d.dot(c.inverse() * d);
  });
  const Peak peak = peak_at(kGrid, surface, static_cast<CellIndex>(at(4, 3)), 1);
  EXPECT_TRUE(peak.position_m.isApprox(Eigen::Vector2d(3.1, 2.8), 1e-9)) << peak.position_m;
  Eigen::Matrix2d expected;
  expected << 0.09, 0.03, 0.03, 0.04;
  EXPECT_TRUE(peak.covariance_m2.isApprox(expected, 1e-9)) << peak.covariance_m2;
}

TEST(PeakAt, KeepsDeviationsWithinTheirLimits) {
  const auto sharp = surface_of(
      [](double x, double y) { return -1e4 * ((x - 3) * (x - 3) + (y - 2.75) * (y - 2.75)); });
  const auto cell = static_cast<CellIndex>(at(4, 3));
  EXPECT_NEAR(peak_at(kGrid, sharp, cell, 1).covariance_m2(0, 0), 0.25 * 0.25 / 12, 1e-9);
  const auto flat = surface_of(
      [](double x, double y) { return -1e-3 * ((x - 3) * (x - 3) + (y - 2.75) * (y - 2.75)); });
  EXPECT_NEAR(peak_at(kGrid, flat, cell, 0.4).covariance_m2(1, 1), 0.16, 1e-9);
}

TEST(PeakAt, WhereThereIsNoSummitTheCellIsAllThatIsKnown) {
  const auto slope = surface_of([](double x, double y) { return x + y; });
  for (const auto cell : {at(4, 3), at(0, 3), at(8, 6)}) {
    const Peak peak = peak_at(kGrid, slope, static_cast<CellIndex>(cell), 1);
    EXPECT_TRUE(peak.covariance_m2.isApprox(covariance_of_cell(kGrid)));
  }
}

}  // namespace
}  // namespace plaza
