#include "plaza/math/assignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

namespace plaza {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kForbidden = std::numeric_limits<double>::infinity();

struct Score {
  int pairs = 0;
  double sum = 0;
  bool better_than(const Score& other) const {
    return pairs != other.pairs ? pairs > other.pairs : sum < other.sum;
  }
};

/// Tries every assignment, row by row, including "none".
Score best_by_enumeration(const Eigen::MatrixXd& cost, Eigen::Index row, unsigned taken,
                          Score so_far) {
  if (row == cost.rows()) return so_far;
  Score best = best_by_enumeration(cost, row + 1, taken, so_far);
  for (Eigen::Index column = 0; column < cost.cols(); ++column) {
    if ((taken >> column & 1U) != 0 || !std::isfinite(cost(row, column))) continue;
    const Score score = best_by_enumeration(cost, row + 1, taken | 1U << column,
                                            {so_far.pairs + 1, so_far.sum + cost(row, column)});
    if (score.better_than(best)) best = score;
  }
  return best;
}

/// Also checks that the assignment is one.
Score score_of(const Eigen::MatrixXd& cost, const std::vector<int>& columns) {
  EXPECT_EQ(columns.size(), static_cast<std::size_t>(cost.rows()));
  Score score;
  std::vector<bool> taken(static_cast<std::size_t>(cost.cols()), false);
  for (std::size_t row = 0; row < columns.size(); ++row) {
    const int column = columns[row];
    if (column < 0) continue;
    EXPECT_LT(column, cost.cols());
    EXPECT_FALSE(taken[static_cast<std::size_t>(column)])
        << "column " << column << " assigned twice";
    taken[static_cast<std::size_t>(column)] = true;
    const double value = cost(static_cast<Eigen::Index>(row), column);
    EXPECT_TRUE(std::isfinite(value)) << "forbidden pair chosen";
    ++score.pairs;
    score.sum += value;
  }
  return score;
}

class RandomAssignment : public ::testing::TestWithParam<double> {};

TEST_P(RandomAssignment, IsOptimalInEveryShape) {
  const double share_forbidden = GetParam();
  std::mt19937 random(17);
  std::uniform_real_distribution<double> real(-3.0, 5.0);
  std::uniform_int_distribution<int> small(0, 2);
  std::bernoulli_distribution forbidden(share_forbidden);
  for (int rows = 1; rows <= 5; ++rows) {
    for (int columns = 1; columns <= 5; ++columns) {
      for (int trial = 0; trial < 40; ++trial) {
        const bool ties = trial % 2 == 0;
        Eigen::MatrixXd cost(rows, columns);
        for (double& value : cost.reshaped()) {
          value = ties ? small(random) : real(random);
          if (forbidden(random)) value = kForbidden;
        }
        const Score expected = best_by_enumeration(cost, 0, 0, {});
        const Score got = score_of(cost, assign_minimum_cost(cost));
        EXPECT_EQ(got.pairs, expected.pairs) << cost;
        EXPECT_NEAR(got.sum, expected.sum, 1e-9) << cost;

        const Score most = score_of(-cost, assign_maximum_weight(-cost));
        EXPECT_EQ(most.pairs, expected.pairs) << cost;
        EXPECT_NEAR(most.sum, -expected.sum, 1e-9) << cost;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Forbidden, RandomAssignment, ::testing::Values(0.0, 0.3, 0.7, 1.0));

TEST(Assignment, OfAConstantMatrixIsTheIdentity) {
  EXPECT_THAT(assign_minimum_cost(Eigen::MatrixXd::Constant(4, 4, 2.5)), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(assign_minimum_cost(Eigen::MatrixXd::Zero(2, 4)), ElementsAre(0, 1));
  EXPECT_THAT(assign_minimum_cost(Eigen::MatrixXd::Zero(4, 2)), ElementsAre(0, 1, -1, -1));
  EXPECT_THAT(assign_maximum_weight(Eigen::MatrixXd::Ones(3, 3)), ElementsAre(0, 1, 2));
}

TEST(Assignment, BreaksTiesTowardsFreeColumns) {
  // Row 1 could push row 0 off column 0 at no cost; the free column is preferred.
  const Eigen::MatrixXd cost{{1, 1, 5}, {1, 1, 5}};
  EXPECT_THAT(assign_minimum_cost(cost), ElementsAre(0, 1));
  // Columns 1 and 2 are equally good for row 0, and row 1 needs column 1.
  const Eigen::MatrixXd pushed{{7, 0, 0}, {7, 0, 7}};
  EXPECT_THAT(assign_minimum_cost(pushed), ElementsAre(2, 1));
}

TEST(Assignment, TallProblemsAreSolvedFromTheColumns) {
  // The ties differ from those of the wide problem: columns choose in their order.
  const Eigen::MatrixXd cost{{1, 1}, {1, 1}, {0, 1}};
  EXPECT_THAT(assign_minimum_cost(cost), ElementsAre(1, -1, 0));
}

TEST(Assignment, PrefersMorePairsOverASmallerSum) {
  const Eigen::MatrixXd cost{{0.0, 1e6}, {1e6, kForbidden}};
  EXPECT_THAT(assign_minimum_cost(cost), ElementsAre(1, 0));
}

TEST(Assignment, LeavesOutWhatIsForbidden) {
  const Eigen::MatrixXd cost{{kForbidden, 3.0}, {kForbidden, 1.0}, {kForbidden, 2.0}};
  EXPECT_THAT(assign_minimum_cost(cost), ElementsAre(-1, 1, -1));
  EXPECT_THAT(assign_maximum_weight(-cost), ElementsAre(-1, 1, -1));
}

TEST(Assignment, OfNothingIsNothing) {
  EXPECT_THAT(assign_minimum_cost(Eigen::MatrixXd(0, 0)), IsEmpty());
  EXPECT_THAT(assign_minimum_cost(Eigen::MatrixXd(0, 3)), IsEmpty());
  EXPECT_THAT(assign_minimum_cost(Eigen::MatrixXd(2, 0)), ElementsAre(-1, -1));
}

TEST(Assignment, TakesBlocksOfALargerMatrix) {
  Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(4, 4);
  cost(1, 1) = 1;
  EXPECT_THAT(assign_minimum_cost(cost.block(1, 1, 2, 2)), ElementsAre(1, 0));
}

TEST(Assignment, RefusesWhatHasNoOptimum) {
  Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(2, 2);
  cost(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(assign_minimum_cost(cost), std::invalid_argument);
  EXPECT_THROW(assign_maximum_weight(cost), std::invalid_argument);
  cost(0, 1) = kForbidden;
  EXPECT_THROW(assign_maximum_weight(cost), std::invalid_argument);
  EXPECT_THROW(assign_minimum_cost(-cost), std::invalid_argument);
}

TEST(Assignment, LargeProblemKeepsItsDualsExact) {
  // cost(i, j) = i * j: by the rearrangement inequality the best is the reversal.
  constexpr int kSize = 120;
  Eigen::MatrixXd cost(kSize, kSize);
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < kSize; ++j) cost(i, j) = i * j;
  }
  std::vector<int> reversed(kSize);
  std::iota(reversed.rbegin(), reversed.rend(), 0);
  EXPECT_EQ(assign_minimum_cost(cost), reversed);
}

}  // namespace
}  // namespace plaza
