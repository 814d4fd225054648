#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "plaza/geometry/scene.h"

namespace plaza {

/// Pictures to draw the views onto, by camera name: 8-bit BGR of the camera's size.
using Backgrounds = std::map<std::string, cv::Mat>;

/// Draws what the calibration says into each view: the ground grid (1 m, coarser on large areas),
/// the area's border, the world's axes at the origin, some standing bodies with their boxes, and
/// the static occluders. Views without a background are drawn on a plain one. Small images are
/// enlarged.
cv::Mat draw_scene_view(const Scene& scene, std::size_t camera,
                        const Backgrounds& backgrounds = {});

/// The scene from above, x to the right and y up: area, cameras and the ground each of them sees.
cv::Mat draw_scene_plan(const Scene& scene);

/// Writes both as PNG: VIEW.png for every camera, and plan.png. Makes the folder where it is
/// missing. Returns the files, the plan last. Throws UserError when one cannot be written or a
/// background has another size than its camera.
std::vector<std::filesystem::path> draw_scene_grid(const Scene& scene,
                                                   const std::filesystem::path& folder,
                                                   const Backgrounds& backgrounds = {});

}  // namespace plaza
