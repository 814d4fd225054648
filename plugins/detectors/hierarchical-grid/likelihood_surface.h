#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plugins/detectors/hierarchical-grid/state_grid.h"

namespace plaza {

/// Smoothed log-likelihood (4.5) of every cell: the logarithm of the weighted mean of the
/// neighbours' likelihoods. Neighbours that are unknown (NaN) or beyond the grid are left out, the
/// weights of the others grow accordingly; NaN where the cell itself is unknown.
std::vector<double> smoothed(const GroundGrid& grid, std::span<const double> log_likelihood,
                             std::span<const Neighbour> neighbours);

/// The same for one cell.
double smoothed_at(const GroundGrid& grid, std::span<const double> log_likelihood,
                   std::span<const Neighbour> neighbours, CellIndex cell);

/// Cells that no neighbour exceeds, by rising index; of equal neighbours the first. Only cells with
/// `candidate` are asked, all known cells are compared with.
std::vector<CellIndex> local_maxima(const GroundGrid& grid, std::span<const double> surface,
                                    std::span<const char> candidate,
                                    std::span<const Neighbour> neighbours);

/// Where the surface peaks near a cell, and how sharply.
struct Peak {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();
};
/// From the parabola through the cell and its eight neighbours: its summit, at most half a cell
/// away, and the inverse of its negative curvature. Standard deviations are kept between
/// step / sqrt(12), what a cell's size alone leaves open, and `max_sigma_m`; where the surface is
/// no summit, the position is the cell's centre and the deviation that of the cell.
Peak peak_at(const GroundGrid& grid, std::span<const double> surface, CellIndex cell,
             double max_sigma_m);

/// What is known of a place from the size of its cell alone.
Eigen::Matrix2d covariance_of_cell(const GroundGrid& grid);

}  // namespace plaza
