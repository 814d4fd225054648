#include "plugins/detectors/onnx/input_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plaza {

ImagePlace::ImagePlace(cv::Size image, cv::Size input, ImageFit fit) : placed_({0, 0}, input) {
  if (fit == ImageFit::kLetterbox) {
    const double ratio = std::min(static_cast<double>(input.width) / image.width,
                                  static_cast<double>(input.height) / image.height);
    const auto scaled = [ratio](int size) {
      return std::max(1, static_cast<int>(std::lround(size * ratio)));
    };
    placed_.width = std::min(scaled(image.width), input.width);
    placed_.height = std::min(scaled(image.height), input.height);
    placed_.x = (input.width - placed_.width) / 2;
    placed_.y = (input.height - placed_.height) / 2;
  }
  x_scale_ = static_cast<double>(image.width) / placed_.width;
  y_scale_ = static_cast<double>(image.height) / placed_.height;
}

Box ImagePlace::in_image(double left, double top, double right, double bottom) const {
  return {.left = (left - placed_.x) * x_scale_ - 0.5,
          .top = (top - placed_.y) * y_scale_ - 0.5,
          .width = (right - left) * x_scale_,
          .height = (bottom - top) * y_scale_};
}

PixelValues::PixelValues(double scale, const std::vector<double>& mean,
                         const std::vector<double>& deviation) {
  for (std::size_t channel = 0; channel < tables_.size(); ++channel) {
    for (std::size_t value = 0; value < 256; ++value) {
      tables_[channel][value] = static_cast<float>((static_cast<double>(value) - mean.at(channel)) *
                                                   scale / deviation.at(channel));
    }
  }
}

cv::Mat network_input(const cv::Mat& image, const InputFormat& format) {
  const cv::Rect placed = ImagePlace(image.size(), format.size, format.fit).placed();
  cv::Mat scaled = image;
  if (placed.size() != image.size()) {
    cv::resize(image, scaled, placed.size(), 0, 0, cv::INTER_LINEAR);
  }
  cv::Mat input({1, 3, format.size.height, format.size.width}, CV_32F);
  for (int channel = 0; channel < 3; ++channel) {
    const auto& values = format.values.of_channel(static_cast<std::size_t>(channel));
    const int source = format.rgb ? 2 - channel : channel;
    cv::Mat plane(format.size, CV_32F, input.ptr<float>(0, channel));
    if (placed.size() != format.size) {
      plane = values[static_cast<std::size_t>(format.padding)];
    }
    for (int row = 0; row < placed.height; ++row) {
      const cv::Vec3b* from = scaled.ptr<cv::Vec3b>(row);
      float* to = plane.ptr<float>(placed.y + row) + placed.x;
      for (int column = 0; column < placed.width; ++column)
        to[column] = values[from[column][source]];
    }
  }
  return input;
}

}  // namespace plaza
