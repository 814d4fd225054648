#include "modalities/edges/scan_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plaza::edges {

int Direction::shift(int major) const { return static_cast<int>(std::floor(major * slope + 0.5)); }

std::vector<Direction> make_directions(int count, double gate_px) {
  if (count < 1) throw std::invalid_argument("a transform needs at least one direction");
  if (!(gate_px >= 0 && gate_px <= kLargestGate)) {
    throw std::invalid_argument("the gate of a transform must be in [0, 254] pixels");
  }
  std::vector<Direction> directions;
  for (int i = 0; i < count; ++i) {
    Direction d;
    d.angle_rad = std::numbers::pi * i / count;
    const double along_x = std::cos(d.angle_rad), along_y = std::sin(d.angle_rad);
    // on the diagonals the two are equal but for rounding, which must not decide
    d.steep = std::abs(along_y) > std::abs(along_x) + 1e-9;
    const double major = d.steep ? along_y : along_x, minor = d.steep ? along_x : along_y;
    d.slope = std::clamp(minor / major, -1.0, 1.0);
    d.step_px = std::hypot(1.0, d.slope);
    d.gate = static_cast<int>(std::floor(gate_px / d.step_px + 1e-9));
    directions.push_back(d);
  }
  return directions;
}

int nearest_direction(const Eigen::Vector2f& normal, int count) {
  const double angle = std::atan2(static_cast<double>(normal.y()), static_cast<double>(normal.x()));
  const auto index = static_cast<int>(std::lround(angle * count / std::numbers::pi)) % count;
  return index < 0 ? index + count : index;
}

}  // namespace plaza::edges
