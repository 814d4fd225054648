#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "plaza/geometry/box.h"

namespace plaza::testing {

/// Head, trunk, arms and slightly parted legs, dark on a bright textured ground: what the SVM knows
/// people by.
inline void draw_person(cv::Mat& image, const Box& box) {
  const auto at = [&](double x, double y) {
    return cv::Point(static_cast<int>(std::lround(box.left + x * box.width)),
                     static_cast<int>(std::lround(box.top + y * box.height)));
  };
  const auto px = [&](double share) { return std::max(1, static_cast<int>(share * box.height)); };
  const cv::Scalar dark(40, 35, 30);
  cv::circle(image, at(0.5, 0.075), px(0.075), dark, cv::FILLED, cv::LINE_AA);
  cv::ellipse(image, at(0.5, 0.33), {px(0.12), px(0.2)}, 0, 0, 360, dark, cv::FILLED, cv::LINE_AA);
  cv::line(image, at(0.30, 0.22), at(0.24, 0.5), dark, px(0.055), cv::LINE_AA);
  cv::line(image, at(0.70, 0.22), at(0.76, 0.5), dark, px(0.055), cv::LINE_AA);
  cv::line(image, at(0.44, 0.5), at(0.36, 0.97), dark, px(0.085), cv::LINE_AA);
  cv::line(image, at(0.56, 0.5), at(0.64, 0.97), dark, px(0.085), cv::LINE_AA);
}

/// A bright ground of 640 x 480 with a fine texture, always the same.
inline cv::Mat empty_street() {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar(170, 175, 180));
  cv::Mat noise(image.size(), CV_8UC3);
  cv::RNG random(4);
  random.fill(noise, cv::RNG::UNIFORM, 0, 12);
  return image + noise;
}

}  // namespace plaza::testing
