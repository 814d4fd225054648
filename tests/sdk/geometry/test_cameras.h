#pragma once

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "plaza/geometry/camera.h"

namespace plaza::test {

/// Pose of a camera at `eye` that looks at `target`, its image upright.
inline CameraFromWorld look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d z = (target - eye).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  CameraFromWorld pose;
  pose.rotation << x.transpose(), z.cross(x).transpose(), z.transpose();
  pose.translation = -pose.rotation * eye;
  return pose;
}

/// Pose of a random surveillance camera, 2 to 8 m above a ground point near the origin.
inline CameraFromWorld random_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> ground(-10, 10), height(2, 8), near(-3, 3);
  return look_at({ground(random) + 15, ground(random), height(random)},
                 {near(random), near(random), 0.5});
}

inline PinholeIntrinsics intrinsics(const Distortion& distortion = {}) {
  return {600, 590, 322, 241, distortion};
}

inline TsaiIntrinsics tsai_intrinsics(double kappa1_per_mm2) {
  return {5.5, kappa1_per_mm2, 5.1e-3, 4.65e-3, 1.09, 324, 282};
}

/// One camera of every model: ideal, Brown-Conrady (barrel, pincushion, tangential), Tsai both
/// ways.
inline std::vector<Camera> cameras_of_all_models(const CameraFromWorld& pose) {
  const Eigen::Vector2i size(640, 480);
  return {Camera::pinhole("ideal", size, intrinsics(), pose),
          Camera::pinhole("barrel", size, intrinsics({-0.32, 0.11, 0, 0, -0.01}), pose),
          Camera::pinhole("pincushion", size, intrinsics({0.21, 0.02, 0, 0, 0}), pose),
          Camera::pinhole("tangential", size, intrinsics({-0.1, 0.02, 4e-3, -3e-3, 0}), pose),
          Camera::tsai("tsai-barrel", size, tsai_intrinsics(2e-2), pose),
          Camera::tsai("tsai-pincushion", size, tsai_intrinsics(-1.2e-2), pose),
          Camera::tsai("tsai-ideal", size, tsai_intrinsics(0), pose)};
}

/// What `camera` says of itself, made into a camera again.
inline Camera made_again(const Camera& camera) {
  const Eigen::Vector2i size(camera.width(), camera.height());
  const Intrinsics intrinsics = camera.intrinsics();
  if (const auto* tsai = std::get_if<TsaiIntrinsics>(&intrinsics)) {
    return Camera::tsai(camera.name(), size, *tsai, camera.pose());
  }
  return Camera::pinhole(camera.name(), size, std::get<PinholeIntrinsics>(intrinsics),
                         camera.pose());
}

}  // namespace plaza::test
