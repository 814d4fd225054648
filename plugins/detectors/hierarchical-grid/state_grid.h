#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plaza/data/observation.h"
#include "plaza/geometry/scene.h"

namespace plaza {

using CellIndex = std::uint32_t;  ///< row * columns + column

/// The ground in cells, coarse to fine: each level splits a cell of the level above into
/// branching x branching (thesis 4.3.1, Figure 4.2).
class StateGrid {
 public:
  /// `cells` cells per axis on the finest level, over `area`; the coarser levels follow. `cells`
  /// must be divisible by branching^(levels - 1), else std::invalid_argument; so must numbers
  /// below 1.
  StateGrid(const GroundArea& area, int cells, int levels, int branching);

  std::size_t levels() const { return grids_.size(); }
  const GroundGrid& grid(std::size_t level) const { return grids_[level]; }  ///< 0 is the coarsest
  const GroundGrid& finest() const { return grids_.back(); }
  std::size_t size(std::size_t level) const;                          ///< cells of a level
  Eigen::Vector2d position(std::size_t level, CellIndex cell) const;  ///< its centre, metres
  /// The cell of the next coarser level that is nearest; `level` > 0.
  CellIndex parent(std::size_t level, CellIndex cell) const;

 private:
  std::vector<GroundGrid> grids_;
  int branching_;
};

/// A cell nearby, by its distance in cells, with its weight.
struct Neighbour {
  int columns = 0;
  int rows = 0;
  double weight = 0;
};
/// Cells of a level within the gate of 3 sigma, the cell itself included, with the weights (4.4),
/// normalised to 1. (The thesis prints the gate as 3 sigma^2, which is no distance.) By rising row,
/// then column.
std::vector<Neighbour> gaussian_neighbours(const GroundGrid& grid, double sigma_m);

/// Cells at most `radius_m` away, and the eight around in any case, the cell itself included; the
/// weights are of no use.
std::vector<Neighbour> cells_around(const GroundGrid& grid, double radius_m);

/// The cells that `which` names around a cell, as far as they are in the grid, in their order.
std::vector<CellIndex> cells_of(const GroundGrid& grid, CellIndex cell,
                                std::span<const Neighbour> which);

}  // namespace plaza
