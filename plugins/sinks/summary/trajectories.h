#pragma once

#include <opencv2/core/mat.hpp>

#include "plaza/geometry/scene.h"
#include "plugins/sinks/summary/statistics.h"

namespace plaza::summary {

/// The plan from above with every trajectory in its person's colour: a ring where it starts, an
/// arrow and the id where it ends, bridged stretches in dashes. `width_px` wide, as high as the
/// place asks for.
cv::Mat draw_trajectories(const Scene& scene, const Trajectories& people, int width_px);

}  // namespace plaza::summary
