#pragma once

#include <Eigen/Core>
#include <vector>

namespace plaza::synthetic {

/// Where a body is on the ground and which way it faces over time, in samples of equal distance.
/// Between samples it is interpolated so that velocities are continuous (Catmull-Rom); moments
/// before the first and after the last sample are taken as these.
class GroundMotion {
 public:
  static constexpr double kRateHz = 50;

  /// `heading_rad` must be continuous, that is unwrapped. Both have the same size, at least 1.
  GroundMotion(double start_s, std::vector<Eigen::Vector2d> position_m,
               std::vector<double> heading_rad);

  double start_s() const { return start_s_; }
  double end_s() const;
  Eigen::Vector2d position(double seconds) const;
  Eigen::Vector2d velocity(double seconds) const;
  double heading(double seconds) const;  ///< not wrapped
  double yaw_rate(double seconds) const;

  /// The same motion with the jerks of step-wise decisions smoothed away by a Gaussian of
  /// `sigma_s`.
  GroundMotion smoothed(double sigma_s) const;

 private:
  double start_s_;
  std::vector<Eigen::Vector2d> position_;
  std::vector<double> heading_;
};

}  // namespace plaza::synthetic
