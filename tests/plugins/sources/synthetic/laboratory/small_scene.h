#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "plaza/geometry/scene.h"
#include "plugins/sources/synthetic/laboratory.h"

namespace plaza::synthetic {

inline Camera corner_camera(const std::string& name, const Eigen::Vector3d& centre,
                            const Eigen::Vector3d& target) {
  PinholeIntrinsics intrinsics;
  intrinsics.fx_px = intrinsics.fy_px = 105;
  intrinsics.cx_px = 79;
  intrinsics.cy_px = 50;
  intrinsics.distortion.k1 = -0.18;
  intrinsics.distortion.k2 = 0.05;
  CameraFromWorld pose;
  const Eigen::Vector3d z = (target - centre).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  pose.rotation.row(0) = x;
  pose.rotation.row(1) = z.cross(x);
  pose.rotation.row(2) = z;
  pose.translation = -pose.rotation * centre;
  return Camera::pinhole(name, {160, 100}, intrinsics, pose);
}

/// The laboratory's room, seen by two small cameras.
inline std::shared_ptr<Scene> small_scene() {
  auto scene = std::make_shared<Scene>();
  scene->name = "small";
  scene->frame_rate_hz = 25;
  scene->area = {.min_m = {-2, -3}, .max_m = {2, 3}};
  scene->cameras.push_back(corner_camera("a", {2.66, 3.64, 2.78}, {-0.3, -0.5, 0.75}));
  scene->cameras.push_back(corner_camera("b", {-2.66, -3.64, 2.74}, {0.3, 0.5, 0.75}));
  return scene;
}

inline LaboratoryOptions small_options() {
  LaboratoryOptions options;
  options.scenario = "two-targets";
  options.seed = 3;
  options.duration_s = 4;
  return options;
}

/// Whether two images are alike to the last bit.
inline bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace plaza::synthetic
