#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "plaza/component/build_context.h"
#include "plaza/component/detector.h"
#include "plaza/data/detections.h"
#include "plaza/data/observation.h"
#include "plaza/geometry/scene.h"

namespace plaza::testing {

/// A 640 x 480 camera at `eye` (metres) that looks at `target` with an upright image.
inline Camera looking_camera(const std::string& name, const Eigen::Vector3d& eye,
                             const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  CameraFromWorld pose;
  pose.rotation.row(0) = right.transpose();
  pose.rotation.row(1) = forward.cross(right).transpose();
  pose.rotation.row(2) = forward.transpose();
  pose.translation = -pose.rotation * eye;
  return Camera::pinhole(name, {640, 480},
                         {.fx_px = 500, .fy_px = 500, .cx_px = 320, .cy_px = 240, .distortion = {}},
                         pose);
}

/// `cameras` views from a circle of 12 m about a place of 8 x 8 m, 4 m above the ground.
inline std::shared_ptr<Scene> round_scene(int cameras) {
  auto scene = std::make_shared<Scene>();
  scene->name = "round";
  for (int i = 0; i < cameras; ++i) {
    const double angle = 2 * std::numbers::pi * i / cameras + 0.3;
    scene->cameras.push_back(looking_camera("view" + std::to_string(i + 1),
                                            {12 * std::cos(angle), 12 * std::sin(angle), 4},
                                            {0, 0, 0.9}));
  }
  scene->area = {.min_m = {-4, -4}, .max_m = {4, 4}};
  scene->frame_rate_hz = 10;
  return scene;
}

inline BuildContext context_of(std::shared_ptr<const Scene> scene) {
  BuildContext context;
  context.name = "detector";
  context.scene = std::move(scene);
  return context;
}

/// The box from a person's head to the feet, of `width_share` of its height.
inline Box person_box(const Camera& camera, const Eigen::Vector2d& position_m, double height_m,
                      double width_share = 0.4) {
  const Eigen::Vector2d feet = camera.project({position_m.x(), position_m.y(), 0}).value();
  const Eigen::Vector2d head = camera.project({position_m.x(), position_m.y(), height_m}).value();
  const double height = feet.y() - head.y();
  const double width = width_share * height;
  return {.left = feet.x() - 0.5 * width, .top = head.y(), .width = width, .height = height};
}

/// What is left of a box inside the image.
inline Box cut_at_border(const Box& box, const Camera& camera) {
  const double left = std::max(box.left, 0.0);
  const double top = std::max(box.top, 0.0);
  return {.left = left,
          .top = top,
          .width = std::min(box.right(), static_cast<double>(camera.width())) - left,
          .height = std::min(box.bottom(), static_cast<double>(camera.height())) - top};
}

/// One frame through a detector.
inline Observations detect(const Detector& detector, PayloadPtr input) {
  PayloadPtr slots[2] = {std::move(input), nullptr};
  const int inputs[1] = {0};
  const int outputs[1] = {1};
  return detector.detect(NodeIo(0, 0, slots, inputs, outputs));
}

}  // namespace plaza::testing
