#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/core/export.h"
#include "plaza/geometry/camera.h"

namespace plaza {

/// Axis-aligned ground rectangle, metres, borders included.
struct GroundArea {
  Eigen::Vector2d min_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d max_m = Eigen::Vector2d::Zero();

  bool contains(const Eigen::Vector2d& p) const {
    return (p.array() >= min_m.array()).all() && (p.array() <= max_m.array()).all();
  }
};

/// Something of the building that hides people: a polygon in one view, pixels.
struct StaticOccluder {
  std::string camera;
  std::string name;
  std::vector<Eigen::Vector2d> polygon_px;
};

/// What is known of the place before the first frame.
struct Scene {
  std::string name;
  std::vector<Camera> cameras;  ///< at least one, names unique; every per-view array has this order
  GroundArea area;
  double frame_rate_hz = 0;  ///< > 0
  Body body;
  std::vector<StaticOccluder> occluders;

  /// Index of a camera by name.
  PLAZA_API std::optional<std::size_t> camera_index(std::string_view camera_name) const;
  /// Time of a frame, nanoseconds from the first one.
  PLAZA_API std::int64_t time_of_frame(std::int64_t frame) const;
};

}  // namespace plaza
