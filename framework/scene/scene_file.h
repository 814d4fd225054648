#pragma once

#include <filesystem>
#include <memory>

#include "framework/config/json_document.h"
#include "plaza/geometry/scene.h"

namespace plaza {

/// Reads a scene with its calibration files. Every fault of the scene and its cameras is reported
/// in one UserError with file, line, column and remedy.
std::shared_ptr<const Scene> read_scene(const std::filesystem::path& file);

/// The same from a text that is already parsed; relative paths start at the folder of
/// document.file.
std::shared_ptr<const Scene> parse_scene(const JsonDocument& document);

}  // namespace plaza
