#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "plaza/geometry/camera.h"

namespace plaza::synthetic {

/// How the camera that takes the pictures differs from the one that was calibrated: a smooth shift
/// over the image (offset, rotation, scale, cubic distortion), all pixels together of a given root
/// mean square.
class CalibrationError {
 public:
  CalibrationError(const Camera& camera, double rms_px, std::uint64_t seed);
  /// What is added to a pixel before the declared calibration applies to it, px.
  Eigen::Vector2d at(const Eigen::Vector2d& pixel) const;

 private:
  Eigen::Vector2d raw(const Eigen::Vector2d& pixel) const;
  Eigen::Vector2d middle_;
  double reach_px_;
  Eigen::Vector2d offset_;
  double turn_ = 0, scale_ = 0, cubic_ = 0;
  double gain_ = 0;
};

/// The viewing rays of a camera, distortion and calibration error included: exact at the corners
/// of pixels, interpolated within (to better than 1e-3 px).
class PixelRays {
 public:
  PixelRays(const Camera& camera, const CalibrationError& error);

  int width() const { return width_; }
  int height() const { return height_; }
  const Eigen::Vector3f& origin() const { return origin_; }
  /// Unit direction through (x + dx, y + dy), dx and dy in [0, 1] from the pixel's upper left
  /// corner; zero where the lens shows nothing.
  Eigen::Vector3f direction(int x, int y, float dx, float dy) const;
  /// Where a world point appears in the picture; nothing when it is behind the camera.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& x_world) const;

 private:
  Camera camera_;
  CalibrationError error_;
  int width_, height_;
  Eigen::Vector3f origin_;
  std::vector<Eigen::Vector3f> corners_;  // (width + 1) x (height + 1), by rows
};

}  // namespace plaza::synthetic
