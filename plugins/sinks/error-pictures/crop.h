#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "plaza/geometry/box.h"
#include "plugins/sinks/drawing/canvas.h"

namespace plaza::error_pictures {

struct DrawnBox {
  Box box;  ///< pixels of the image
  drawing::Stroke stroke;
};

/// The part of an image around `focus`, `size` large, with polygons and boxes drawn over it: about
/// twice as high as the focus and as wide as that makes it. `image` may be empty: nothing but lines
/// then. What lies outside of the image has the colour of paper.
cv::Mat crop_around(const cv::Mat& image, const Box& focus, std::span<const DrawnBox> boxes,
                    std::span<const std::vector<Eigen::Vector2d>> polygons, cv::Size size);

/// The smallest box around both.
Box around(const Box& a, const Box& b);

}  // namespace plaza::error_pictures
