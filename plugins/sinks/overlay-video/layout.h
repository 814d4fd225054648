#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

namespace plaza::overlay {

/// Where everything is in one picture, pixels. No two rectangles overlap.
struct Layout {
  cv::Size canvas;              ///< even width and height, which H.264 needs
  cv::Rect header;              ///< name of the scene, frame, time
  std::vector<cv::Rect> views;  ///< of the images' own proportions, in the order given
  cv::Rect plan;
};

/// Views in a grid at the left, in reading order, and the plan at the right over the whole height.
///
/// Of all numbers of columns and shares of the width, takes the one that leaves least of the canvas
/// empty while views and plan are large. `view_sizes`: of the images, at least one; `plan_aspect`:
/// width over height of what the plan shows; `width_px`: of the canvas, at least 320. The height is
/// at most three quarters of the width.
Layout make_layout(const std::vector<cv::Size>& view_sizes, double plan_aspect, int width_px);

}  // namespace plaza::overlay
