#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "framework/scene/calibration.h"
#include "framework/scene/calibration_check.h"
#include "plaza/core/error.h"
#include "tests/fuzz/require.h"

namespace plaza::fuzz {

inline void use_camera(const Camera& camera) {
  lens_faults(camera);
  placement_faults(camera, {{-1, -1}, {1, 1}}, {}, "mm");
  const auto box = body_box(camera, {0.1, 0.2}, {});
  require(!box || (box->width >= 0 && box->height >= 0), "box of negative size");
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(0, 0), Eigen::Vector2d(320, 400)}) {
    camera.plane_jacobian(pixel);
    const auto ray = camera.ray(pixel);
    require(!ray || !ray->direction.hasNaN(), "ray without a direction");
  }
}

/// Reads a calibration and uses it as the scene reader does.
template <class Parse>
void try_calibration(const Parse& parse) {
  try {
    Calibration c = parse();
    require(c.pose.rotation.allFinite() && c.pose.translation.allFinite(), "pose not finite");
    if (!rotation_fault(c.pose.rotation).empty()) return;
    c.pose.rotation = nearest_rotation(c.pose.rotation);
    const Eigen::Vector2i size = c.image_size.value_or(Eigen::Vector2i(640, 480));
    if (const auto* in = std::get_if<TsaiIntrinsics>(&c.intrinsics)) {
      use_camera(Camera::tsai("fuzzed", size, *in, c.pose));
    } else {
      use_camera(
          Camera::pinhole("fuzzed", size, std::get<PinholeIntrinsics>(c.intrinsics), c.pose));
    }
  } catch (const UserError& error) {
    for (const Diagnostic& d : error.diagnostics()) {
      require(!d.message.empty(), "diagnostic without a message");
      require(!d.where.file.empty(), "diagnostic without a place");
    }
  } catch (const std::invalid_argument&) {
    // the SDK's own last check of numbers that make no camera
  }
}

}  // namespace plaza::fuzz
