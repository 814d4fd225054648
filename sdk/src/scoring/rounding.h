#pragma once

#include <limits>

namespace plaza {

/// By how much a similarity may miss a threshold and still reach it, as in the references' scorers.
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

}  // namespace plaza
