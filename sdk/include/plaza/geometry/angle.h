#pragma once

#include <span>

#include "plaza/core/export.h"

namespace plaza {

/// Wraps an angle into (-pi, pi].
PLAZA_API double wrap_angle(double radians);

/// Signed shortest rotation `to - from`, in (-pi, pi].
PLAZA_API double angle_difference(double to, double from);

/// Mean direction on the circle (thesis (5.2) averages the numbers, which fails across +-pi).
/// Returns NaN when the directions cancel out or `radians` is empty.
PLAZA_API double circular_mean(std::span<const double> radians);

PLAZA_API double degrees_from_radians(double radians);
PLAZA_API double radians_from_degrees(double degrees);

}  // namespace plaza
