#include "plaza/geometry/angle.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace plaza {

double wrap_angle(double radians) {
  const double wrapped = std::remainder(radians, 2 * std::numbers::pi);  // [-pi, pi]
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

double angle_difference(double to, double from) { return wrap_angle(to - from); }

double circular_mean(std::span<const double> radians) {
  double x = 0, y = 0;
  for (const double a : radians) {
    x += std::cos(a);
    y += std::sin(a);
  }
  // below rounding noise the direction of the sum means nothing
  const double noise = 1e-12 * static_cast<double>(radians.size());
  if (std::hypot(x, y) <= noise) return std::numeric_limits<double>::quiet_NaN();
  return std::atan2(y, x);
}

double degrees_from_radians(double radians) { return radians * 180 / std::numbers::pi; }
double radians_from_degrees(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace plaza
