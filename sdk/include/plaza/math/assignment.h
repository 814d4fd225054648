#pragma once

#include <Eigen/Core>
#include <vector>

#include "plaza/core/export.h"

namespace plaza {

/// Linear assignment: each row gets at most one column and each column at most one row, so that the
/// sum of the chosen entries is smallest. Exact, by shortest augmenting paths with dual variables
/// (D. F. Crouse, "On implementing 2D rectangular assignment algorithms", IEEE Trans. Aerospace and
/// Electronic Systems 52(4), 2016); O(min(r, c)^2 max(r, c)).
///
/// `cost` is rows x columns, of any shape, also empty; an entry of +infinity forbids the pair. As
/// many allowed pairs as possible are made, and among those assignments one of least sum is taken.
/// Without forbidden pairs that number is min(rows, columns).
///
/// Of equal sums, the one is chosen that the field's evaluators choose (rows in their order; a free
/// column before a taken one; of free columns the first one), so that scores agree with theirs
/// where similarities tie. A constant matrix gives the identity.
///
/// Returns the column of each row, -1 for none. Throws std::invalid_argument on NaN and -infinity.
PLAZA_API std::vector<int> assign_minimum_cost(const Eigen::Ref<const Eigen::MatrixXd>& cost);

/// The same with the largest sum; an entry of -infinity forbids the pair, +infinity and NaN are
/// errors.
PLAZA_API std::vector<int> assign_maximum_weight(const Eigen::Ref<const Eigen::MatrixXd>& weight);

}  // namespace plaza
