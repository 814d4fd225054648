#pragma once

#include <filesystem>
#include <memory>

#include "plaza/geometry/scene.h"

namespace plaza {

/// Reads a scene with its calibration files. Every fault of the scene and its cameras is reported in one
/// UserError with file, line, column and remedy.
std::shared_ptr<const Scene> read_scene(const std::filesystem::path& file);

}  // namespace plaza
