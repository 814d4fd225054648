#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "plaza/data/frames.h"
#include "plugins/detectors/common/box_ground.h"

namespace plaza {

/// People's boxes in the image of a camera (8-bit BGR, of the calibration's size), before anything
/// is suppressed. Called for several cameras at once.
using FindBoxes =
    std::function<std::vector<ImageDetection>(std::size_t camera, const cv::Mat& image)>;

/// What detectors of image boxes do with a frame: boxes are found in every view that has an image,
/// several views at once, and become ground observations, by rising camera and falling score.
///
/// Throws UserError for an image that the camera was not calibrated for, and adds the camera to
/// whatever `find_boxes` throws.
Observations observe_views(const FrameSet& frames, const Scene& scene, const BoxGround& ground,
                           const FindBoxes& find_boxes);

}  // namespace plaza
