#include "plugins/detectors/hierarchical-grid/likelihood_surface.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace plaza {
namespace {

constexpr double kNoLikelihood = std::numeric_limits<double>::quiet_NaN();
/// A likelihood so much below the largest is as good as 0, and its logarithm is still a number.
constexpr double kFloor = -600;

template <class Function>
void for_each_neighbour(const GroundGrid& grid, int column, int row,
                        std::span<const Neighbour> neighbours, const Function& function) {
  for (const Neighbour& n : neighbours) {
    const int c = column + n.columns, r = row + n.rows;
    if (c < 0 || r < 0 || c >= grid.columns || r >= grid.rows) continue;
    function(static_cast<std::size_t>(r * grid.columns + c), n.weight);
  }
}

}  // namespace

std::vector<double> smoothed(const GroundGrid& grid, std::span<const double> log_likelihood,
                             std::span<const Neighbour> neighbours) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double v : log_likelihood) {
    if (std::isfinite(v)) largest = std::max(largest, v);
  }
  std::vector<double> likelihood(log_likelihood.size(), kNoLikelihood);
  for (std::size_t i = 0; i < likelihood.size(); ++i) {
    if (std::isfinite(log_likelihood[i])) {
      likelihood[i] = std::exp(std::max(log_likelihood[i] - largest, kFloor));
    }
  }
  std::vector<double> out(likelihood.size(), kNoLikelihood);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const auto cell = static_cast<std::size_t>(row * grid.columns + column);
      if (std::isnan(likelihood[cell])) continue;
      double sum = 0, weights = 0;
      for_each_neighbour(grid, column, row, neighbours, [&](std::size_t other, double weight) {
        if (std::isnan(likelihood[other])) return;
        sum += weight * likelihood[other];
        weights += weight;
      });
      out[cell] = largest + std::log(sum / weights);
    }
  }
  return out;
}

double smoothed_at(const GroundGrid& grid, std::span<const double> log_likelihood,
                   std::span<const Neighbour> neighbours, CellIndex cell) {
  if (!std::isfinite(log_likelihood[cell])) return kNoLikelihood;
  const int column = static_cast<int>(cell) % grid.columns;
  const int row = static_cast<int>(cell) / grid.columns;
  double largest = log_likelihood[cell];
  for_each_neighbour(grid, column, row, neighbours, [&](std::size_t other, double /*weight*/) {
    if (log_likelihood[other] > largest) largest = log_likelihood[other];
  });
  double sum = 0, weights = 0;
  for_each_neighbour(grid, column, row, neighbours, [&](std::size_t other, double weight) {
    if (!std::isfinite(log_likelihood[other])) return;
    sum += weight * std::exp(std::max(log_likelihood[other] - largest, kFloor));
    weights += weight;
  });
  return largest + std::log(sum / weights);
}

std::vector<CellIndex> local_maxima(const GroundGrid& grid, std::span<const double> surface,
                                    std::span<const char> candidate,
                                    std::span<const Neighbour> neighbours) {
  std::vector<CellIndex> maxima;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const auto cell = static_cast<std::size_t>(row * grid.columns + column);
      if (candidate[cell] == 0 || !std::isfinite(surface[cell])) continue;
      bool highest = true;
      for_each_neighbour(grid, column, row, neighbours, [&](std::size_t other, double /*weight*/) {
        if (other == cell || !std::isfinite(surface[other])) return;
        highest = highest &&
                  (other < cell ? surface[other] < surface[cell] : surface[other] <= surface[cell]);
      });
      if (highest) maxima.push_back(static_cast<CellIndex>(cell));
    }
  }
  return maxima;
}

Eigen::Matrix2d covariance_of_cell(const GroundGrid& grid) {
  return (grid.step_m.cwiseAbs2() / 12).asDiagonal();
}

Peak peak_at(const GroundGrid& grid, std::span<const double> surface, CellIndex cell,
             double max_sigma_m) {
  const int column = static_cast<int>(cell) % grid.columns;
  const int row = static_cast<int>(cell) / grid.columns;
  const Eigen::Vector2d centre =
      grid.origin_m + grid.step_m.cwiseProduct(Eigen::Vector2d(column, row));
  Peak peak{centre, covariance_of_cell(grid)};
  if (column == 0 || row == 0 || column + 1 == grid.columns || row + 1 == grid.rows) return peak;
  double v[3][3];
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      v[r][c] = surface[static_cast<std::size_t>((row + r - 1) * grid.columns + column + c - 1)];
      if (!std::isfinite(v[r][c])) return peak;
    }
  }
  // derivatives in cells
  const Eigen::Vector2d slope(0.5 * (v[1][2] - v[1][0]), 0.5 * (v[2][1] - v[0][1]));
  Eigen::Matrix2d curvature;
  curvature(0, 0) = v[1][2] - 2 * v[1][1] + v[1][0];
  curvature(1, 1) = v[2][1] - 2 * v[1][1] + v[0][1];
  curvature(0, 1) = curvature(1, 0) = 0.25 * (v[2][2] - v[2][0] - v[0][2] + v[0][0]);
  if (!(curvature(0, 0) < 0 && curvature.determinant() > 1e-9)) return peak;
  const Eigen::Matrix2d inverse = curvature.inverse();
  const Eigen::Vector2d offset = (-inverse * slope).cwiseMax(-0.5).cwiseMin(0.5);
  peak.position_m = centre + grid.step_m.cwiseProduct(offset);
  const Eigen::DiagonalMatrix<double, 2> step(grid.step_m);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      Eigen::Matrix2d(step * Eigen::Matrix2d(-inverse) * step));
  const double least = grid.step_m.minCoeff() * grid.step_m.minCoeff() / 12;
  const Eigen::Vector2d variances =
      axes.eigenvalues().cwiseMax(least).cwiseMin(std::max(least, max_sigma_m * max_sigma_m));
  const Eigen::Matrix2d c =
      axes.eigenvectors() * variances.asDiagonal() * axes.eigenvectors().transpose();
  peak.covariance_m2 = 0.5 * (c + c.transpose());
  return peak;
}

}  // namespace plaza
