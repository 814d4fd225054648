#pragma once

#include <optional>
#include <string>

#include "framework/scene/fields.h"
#include "plaza/geometry/camera.h"

namespace plaza {

struct CameraEntry {
  Camera camera;
  std::string unit;     ///< of the calibration: "mm", "cm", "m"; empty for homographies
  std::string pointer;  ///< of "calibration" in the scene
};

/// Reads one entry of "cameras" with its calibration, and checks the calibration by itself. Nothing
/// when a fault was found.
std::optional<CameraEntry> read_camera(Fields& entry, Diagnostics& faults);

}  // namespace plaza
