#include "plugins/detectors/hierarchical-grid/state_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace plaza {
namespace {

const GroundArea kArea{.min_m = {-3, 1}, .max_m = {5, 7}};  // 8 m x 6 m

TEST(StateGrid, LevelsCoverTheAreaWithCellsOfTheirSize) {
  const StateGrid grid(kArea, 24, 3, 2);
  ASSERT_EQ(grid.levels(), 3U);
  EXPECT_EQ(grid.size(0), 36U);
  EXPECT_EQ(grid.size(1), 144U);
  EXPECT_EQ(grid.size(2), 576U);
  for (std::size_t level = 0; level < 3; ++level) {
    const GroundGrid& g = grid.grid(level);
    const auto last = static_cast<CellIndex>(grid.size(level) - 1);
    EXPECT_TRUE((grid.position(level, 0) - 0.5 * g.step_m).isApprox(kArea.min_m));
    EXPECT_TRUE((grid.position(level, last) + 0.5 * g.step_m).isApprox(kArea.max_m));
  }
  EXPECT_TRUE(grid.finest().step_m.isApprox(Eigen::Vector2d(8.0 / 24, 6.0 / 24)));
}

TEST(StateGrid, TheParentIsTheNearestCellAboveAndAllHaveEquallyManyChildren) {
  for (const int branching : {2, 3}) {
    const StateGrid grid(kArea, branching * branching * 2, 3, branching);
    for (std::size_t level = 1; level < grid.levels(); ++level) {
      std::map<CellIndex, int> children;
      for (CellIndex cell = 0; cell < grid.size(level); ++cell) {
        const CellIndex parent = grid.parent(level, cell);
        ++children[parent];
        const Eigen::Vector2d at = grid.position(level, cell);
        const double distance = (grid.position(level - 1, parent) - at).norm();
        for (CellIndex other = 0; other < grid.size(level - 1); ++other) {
          EXPECT_LE(distance, (grid.position(level - 1, other) - at).norm() + 1e-12);
        }
      }
      EXPECT_EQ(children.size(), grid.size(level - 1));
      for (const auto& [parent, count] : children) EXPECT_EQ(count, branching * branching);
    }
  }
}

TEST(StateGrid, RefusesCellsWithoutOneParent) {
  EXPECT_THROW(StateGrid(kArea, 30, 3, 2), std::invalid_argument);
  EXPECT_THROW(StateGrid(kArea, 0, 1, 2), std::invalid_argument);
  EXPECT_NO_THROW(StateGrid(kArea, 30, 2, 2));
}

TEST(GaussianNeighbours, ReachThreeSigmaAndAddUpToOne) {
  const GroundGrid grid{.origin_m = {0, 0}, .step_m = {0.25, 0.2}, .columns = 40, .rows = 40};
  const double sigma = 0.3;
  const auto neighbours = gaussian_neighbours(grid, sigma);
  double sum = 0, own = 0;
  std::map<std::pair<int, int>, double> weights;
  for (const Neighbour& n : neighbours) {
    sum += n.weight;
    weights[{n.columns, n.rows}] = n.weight;
    if (n.columns == 0 && n.rows == 0) own = n.weight;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  // 0.9 m is the gate: 3 columns are 0.75 m, 4 are 1 m; 4 rows are 0.8 m
  EXPECT_TRUE(weights.contains({3, 0}));
  EXPECT_FALSE(weights.contains({4, 0}));
  EXPECT_TRUE(weights.contains({0, 4}));
  EXPECT_FALSE(weights.contains({3, 3})) << "0.96 m";
  EXPECT_NEAR((weights[{1, 2}]) / own, std::exp(-(0.25 * 0.25 + 0.4 * 0.4) / (2 * 0.09)), 1e-12);
  EXPECT_EQ(gaussian_neighbours(grid, 0).size(), 1U) << "no smoothing, the cell alone";
}

TEST(CellsAround, AreTheEightAtLeast) {
  const GroundGrid grid{.origin_m = {0, 0}, .step_m = {0.2, 0.5}, .columns = 9, .rows = 9};
  const auto has = [](const std::vector<Neighbour>& cells, int columns, int rows) {
    return std::count_if(cells.begin(), cells.end(), [&](const Neighbour& n) {
      return n.columns == columns && n.rows == rows;
    });
  };
  for (const double radius_m : {0.0, 0.1, 0.45}) {
    const auto cells = cells_around(grid, radius_m);
    for (int row = -1; row <= 1; ++row) {
      for (int column = -1; column <= 1; ++column) EXPECT_EQ(has(cells, column, row), 1);
    }
    EXPECT_EQ(has(cells, 2, 0), radius_m > 0.4 ? 1 : 0);
    EXPECT_EQ(has(cells, 0, 2), 0);
  }
}

}  // namespace
}  // namespace plaza
