#include "plaza/math/assignment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace plaza {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kNone = -1;

/// A dense problem with at most as many rows as columns, and every row assignable.
class ShortestAugmentingPaths {
 public:
  /// `cost` is row-major, rows x columns, finite.
  ShortestAugmentingPaths(std::vector<double> cost, int rows, int columns)
      : cost_(std::move(cost)),
        columns_(columns),
        row_dual_(static_cast<std::size_t>(rows), 0.0),
        column_dual_(static_cast<std::size_t>(columns), 0.0),
        column_of_row_(static_cast<std::size_t>(rows), kNone),
        row_of_column_(static_cast<std::size_t>(columns), kNone),
        path_cost_(static_cast<std::size_t>(columns)),
        previous_row_(static_cast<std::size_t>(columns), kNone) {
    for (int row = 0; row < rows; ++row) assign(row);
  }

  const std::vector<int>& column_of_row() const { return column_of_row_; }

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }

  /// Finds the cheapest alternating path from `start` to a free column, and flips it.
  void assign(int start) {
    std::fill(path_cost_.begin(), path_cost_.end(), kInfinity);
    open_.resize(at(columns_));
    // Last column first: together with the preference below, ties then go to the first free column.
    for (int k = 0; k < columns_; ++k) open_[at(k)] = columns_ - 1 - k;
    closed_.clear();

    double length = 0;
    int row = start;
    int sink = kNone;
    while (sink == kNone) {
      const int column = close_nearest(row, length);
      length = path_cost_[at(column)];
      closed_.push_back(column);
      if (row_of_column_[at(column)] == kNone) {
        sink = column;
      } else {
        row = row_of_column_[at(column)];
      }
    }

    row_dual_[at(start)] += length;
    for (const int column : closed_) {
      const double slack = length - path_cost_[at(column)];
      const int owner =
          row_of_column_[at(column)];  // of before the flip: a row the search went through
      if (owner != kNone) row_dual_[at(owner)] += slack;
      column_dual_[at(column)] -= slack;
    }
    flip(start, sink);
  }

  /// Relaxes the open columns over `row`, which `length` reaches, and removes the nearest of them.
  int close_nearest(int row, double length) {
    const double* cost = cost_.data() + at(row) * at(columns_);
    const double row_dual = row_dual_[at(row)];
    std::size_t nearest = 0;
    double least = kInfinity;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      const std::size_t column = at(open_[k]);
      // The order of these operations is part of the contract on ties: rounding decides them too.
      const double through = length + cost[column] - row_dual - column_dual_[column];
      double& known = path_cost_[column];
      if (through < known) {
        known = through;
        previous_row_[column] = row;
      }
      if (known < least || (known == least && row_of_column_[column] == kNone)) {
        least = known;
        nearest = k;
      }
    }
    const int column = open_[nearest];
    open_[nearest] = open_.back();
    open_.pop_back();
    return column;
  }

  void flip(int start, int sink) {
    int column = sink;
    for (;;) {
      const int row = previous_row_[at(column)];
      row_of_column_[at(column)] = row;
      std::swap(column_of_row_[at(row)], column);
      if (row == start) return;
    }
  }

  std::vector<double> cost_;
  int columns_;
  std::vector<double> row_dual_;
  std::vector<double> column_dual_;
  std::vector<int> column_of_row_;
  std::vector<int> row_of_column_;
  std::vector<double> path_cost_;  // of the cheapest path known to each column
  std::vector<int> previous_row_;  // on that path
  std::vector<int> open_;          // columns whose path is not settled
  std::vector<int> closed_;
};

std::vector<int> solve(const Eigen::Ref<const Eigen::MatrixXd>& matrix, double sign) {
  const Eigen::Index limit = std::numeric_limits<int>::max();
  if (matrix.rows() > limit || matrix.cols() > limit) {
    throw std::invalid_argument("assignment problem too large");
  }
  const int rows = static_cast<int>(matrix.rows());
  const int columns = static_cast<int>(matrix.cols());
  std::vector<int> result(static_cast<std::size_t>(rows), kNone);
  if (rows == 0 || columns == 0) return result;

  const bool transposed = rows > columns;
  const int short_side = std::min(rows, columns);
  const int long_side = std::max(rows, columns);
  std::vector<double> cost;
  cost.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  bool any_allowed = false;
  bool any_forbidden = false;
  double largest = 0;
  for (int i = 0; i < short_side; ++i) {
    for (int j = 0; j < long_side; ++j) {
      const double value = sign * (transposed ? matrix(j, i) : matrix(i, j));
      if (std::isnan(value) || value == -kInfinity) {
        throw std::invalid_argument("assignment with an entry that is NaN or infinitely good");
      }
      if (value == kInfinity) {
        any_forbidden = true;
      } else {
        any_allowed = true;
        largest = std::max(largest, std::abs(value));
      }
      cost.push_back(value);
    }
  }
  if (!any_allowed) return result;
  if (any_forbidden) {
    // With |cost| <= c, one forbidden pair and n - 1 best ones must be worse than n worst ones:
    // 2 n c + 1 > (2 n - 1) c.
    const double prohibitive = 2 * short_side * (largest + 1) + 1;
    std::replace(cost.begin(), cost.end(), kInfinity, prohibitive);
  }

  const ShortestAugmentingPaths solution(std::move(cost), short_side, long_side);
  for (int i = 0; i < short_side; ++i) {
    const int j = solution.column_of_row()[static_cast<std::size_t>(i)];
    const int row = transposed ? j : i;
    const int column = transposed ? i : j;
    if (std::isfinite(matrix(row, column))) result[static_cast<std::size_t>(row)] = column;
  }
  return result;
}

}  // namespace

std::vector<int> assign_minimum_cost(const Eigen::Ref<const Eigen::MatrixXd>& cost) {
  return solve(cost, 1.0);
}

std::vector<int> assign_maximum_weight(const Eigen::Ref<const Eigen::MatrixXd>& weight) {
  return solve(weight, -1.0);
}

}  // namespace plaza
