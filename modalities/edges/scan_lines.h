#pragma once

#include <Eigen/Core>
#include <vector>

namespace plaza::edges {

/// One direction of the oriented distance transform and the digital lines that run along it.
///
/// Image coordinates: x right, y down. Lines are undirected; the lines of a direction cover every
/// pixel exactly once. A flat direction steps along x, a steep one along y; after `major` steps
/// from the image's border a line lies shift(major) pixels beside where it would have been without
/// its slope.
struct Direction {
  double angle_rad = 0;  ///< of the line, [0, pi)
  bool steep = false;    ///< closer to the y axis than to the x axis
  double slope = 0;      ///< along the other axis per step, [-1, 1]
  double step_px = 1;    ///< length of one step, [1, sqrt 2]
  int gate = 0;          ///< most steps within the validation gate

  /// floor(major * slope + 1/2): how far a line has drifted at row (steep) or column (flat)
  /// `major`.
  int shift(int major) const;
};

/// Most steps that a transform can count in 8 bits.
inline constexpr int kLargestGate = 254;

/// Directions 0, pi / count, 2 pi / count, ... whose gates hold the steps up to `gate_px` pixels
/// away (thesis 4.3.3). Throws std::invalid_argument for count < 1, or a gate that is not in
/// [0, 254] pixels.
std::vector<Direction> make_directions(int count, double gate_px);

/// Index of the direction closest to a normal, whose sign does not matter (thesis 4.3.5).
int nearest_direction(const Eigen::Vector2f& normal, int count);

}  // namespace plaza::edges
