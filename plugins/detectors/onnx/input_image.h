#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "plaza/geometry/box.h"

namespace plaza {

/// How an image that has another shape gets into a network's input.
enum class ImageFit {
  kLetterbox,  ///< in its own proportions, in the middle, grey around it
  kStretch,    ///< as wide and as high as the input
};

/// Where an image lies in a network's input, and back.
///
/// Networks count from the corner of the input, pixel i covering [i, i + 1]; Plaza counts from the
/// centre of the image's first pixel. What is mapped back here is exact: by the size that the image
/// was really given, in whole pixels, not by the ratio that this size was rounded from.
class ImagePlace {
 public:
  ImagePlace(cv::Size image, cv::Size input, ImageFit fit);

  const cv::Rect& placed() const { return placed_; }  ///< the image, in pixels of the input
  /// The box of the image, in its pixels, between two opposite corners in the input; it may reach
  /// outside of the image.
  Box in_image(double left, double top, double right, double bottom) const;

 private:
  cv::Rect placed_;
  double x_scale_ = 1;  ///< pixels of the image per pixel of the input
  double y_scale_ = 1;
};

/// What becomes of a channel's value: (value - mean) * scale / deviation, all of 0 to 255 at once.
class PixelValues {
 public:
  /// `mean` and `deviation`: per channel, in the network's order.
  PixelValues(double scale, const std::vector<double>& mean, const std::vector<double>& deviation);
  const std::array<float, 256>& of_channel(std::size_t channel) const { return tables_[channel]; }

 private:
  std::array<std::array<float, 256>, 3> tables_;
};

struct InputFormat {
  cv::Size size;  ///< of the network's input, px
  ImageFit fit = ImageFit::kLetterbox;
  bool rgb = true;    ///< red first, or blue first as in FrameSet
  int padding = 114;  ///< value of the pixels around a letterboxed image, 0 to 255
  PixelValues values;
};

/// An 8-bit BGR image as a network reads it: 1 x 3 x height x width floats. Scaling is bilinear, as
/// in the frameworks that networks are trained with.
cv::Mat network_input(const cv::Mat& image, const InputFormat& format);

}  // namespace plaza
