#pragma once

#include <optional>
#include <string>

#include "lens.h"
#include "plaza/geometry/camera.h"

namespace plaza {

/// Every kind of camera in one form: pose, distortion of normalised coordinates, then
/// pixel = [fx skew; 0 fy] * distorted + (cx, cy).
struct Camera::Model {
  std::string name;
  Eigen::Vector2i image_size = Eigen::Vector2i::Zero();
  CameraFromWorld pose;
  Lens lens;
  Eigen::Matrix2d pixel_from_lens = Eigen::Matrix2d::Identity();  ///< upper triangular
  Eigen::Vector2d principal_point = Eigen::Vector2d::Zero();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  /// Tsai's model only, 0 for any other: projections show no more than its ratio to pixel sizes.
  double focal_mm = 0;
  double sx = 1;  ///< likewise

  /// A pixel and how it moves with the world point, 2 x 3, pixels per metre.
  struct Projection {
    Eigen::Vector2d pixel;
    Eigen::Matrix<double, 2, 3> by_world;
  };
  std::optional<Projection> project_with_jacobian(const Eigen::Vector3d& x_world) const;
};

/// Points nearer to the camera's plane than this have no usable projection, metres.
inline constexpr double kMinDepth_m = 1e-6;

}  // namespace plaza
