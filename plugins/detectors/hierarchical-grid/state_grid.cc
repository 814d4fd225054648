#include "plugins/detectors/hierarchical-grid/state_grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plaza {

StateGrid::StateGrid(const GroundArea& area, int cells, int levels, int branching)
    : branching_(branching) {
  if (cells < 1 || levels < 1 || branching < 1) {
    throw std::invalid_argument("a state grid needs at least one cell, one level and one branch");
  }
  const Eigen::Vector2d size = area.max_m - area.min_m;
  grids_.resize(static_cast<std::size_t>(levels));
  for (std::size_t level = grids_.size(); level-- > 0;) {
    GroundGrid& grid = grids_[level];
    grid.columns = grid.rows = cells;
    grid.step_m = size / cells;
    grid.origin_m = area.min_m + 0.5 * grid.step_m;
    if (level > 0 && cells % branching != 0) {
      throw std::invalid_argument("cells must be divisible by branching^(levels - 1)");
    }
    cells /= branching;
  }
}

std::size_t StateGrid::size(std::size_t level) const {
  return static_cast<std::size_t>(grids_[level].columns) *
         static_cast<std::size_t>(grids_[level].rows);
}

Eigen::Vector2d StateGrid::position(std::size_t level, CellIndex cell) const {
  const GroundGrid& grid = grids_[level];
  const auto columns = static_cast<CellIndex>(grid.columns);
  return grid.origin_m + grid.step_m.cwiseProduct(Eigen::Vector2d(cell % columns, cell / columns));
}

CellIndex StateGrid::parent(std::size_t level, CellIndex cell) const {
  const auto columns = static_cast<CellIndex>(grids_[level].columns);
  const auto branching = static_cast<CellIndex>(branching_);
  const CellIndex column = cell % columns / branching, row = cell / columns / branching;
  return row * (columns / branching) + column;
}

std::vector<Neighbour> gaussian_neighbours(const GroundGrid& grid, double sigma_m) {
  const double gate = 3 * sigma_m;
  const int columns = std::min(static_cast<int>(gate / grid.step_m.x()), grid.columns - 1);
  const int rows = std::min(static_cast<int>(gate / grid.step_m.y()), grid.rows - 1);
  std::vector<Neighbour> neighbours;
  double sum = 0;
  for (int r = -rows; r <= rows; ++r) {
    for (int c = -columns; c <= columns; ++c) {
      const double d2 = grid.step_m.cwiseProduct(Eigen::Vector2d(c, r)).squaredNorm();
      if (d2 > gate * gate) continue;
      const double weight = sigma_m > 0 ? std::exp(-d2 / (2 * sigma_m * sigma_m)) : 1;
      neighbours.push_back({c, r, weight});
      sum += weight;
    }
  }
  for (Neighbour& n : neighbours) n.weight /= sum;
  return neighbours;
}

std::vector<Neighbour> cells_around(const GroundGrid& grid, double radius_m) {
  std::vector<Neighbour> cells = gaussian_neighbours(grid, radius_m / 3);
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      const bool there = std::any_of(cells.begin(), cells.end(), [&](const Neighbour& n) {
        return n.columns == column && n.rows == row;
      });
      if (!there) cells.push_back({column, row, 0});
    }
  }
  return cells;
}

std::vector<CellIndex> cells_of(const GroundGrid& grid, CellIndex cell,
                                std::span<const Neighbour> which) {
  const int column = static_cast<int>(cell) % grid.columns;
  const int row = static_cast<int>(cell) / grid.columns;
  std::vector<CellIndex> cells;
  for (const Neighbour& n : which) {
    const int c = column + n.columns, r = row + n.rows;
    if (c < 0 || r < 0 || c >= grid.columns || r >= grid.rows) continue;
    cells.push_back(static_cast<CellIndex>(r * grid.columns + c));
  }
  return cells;
}

}  // namespace plaza
