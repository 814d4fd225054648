#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <random>

#include "modalities/color/background.h"
#include "plaza/geometry/camera.h"

namespace plaza::color::test {

/// Independent colours, or those of `scene` with Gaussian noise of `sigma` grey levels.
inline cv::Mat random_image(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  cv::Mat image(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < 3 * width; ++i) image.ptr<uchar>(y)[i] = static_cast<uchar>(random() >> 24);
  }
  return image;
}

/// `scene` * gain with noise, rounded and cut to 8 bits.
inline cv::Mat seen(const cv::Mat& scene, double gain, double sigma, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 1);
  cv::Mat image(scene.size(), CV_8UC3);
  for (int y = 0; y < scene.rows; ++y) {
    for (int i = 0; i < 3 * scene.cols; ++i) {
      const double value = scene.ptr<uchar>(y)[i] * gain + sigma * noise(random);
      image.ptr<uchar>(y)[i] = cv::saturate_cast<uchar>(value);
    }
  }
  return image;
}

/// A street of smooth greys with some colour, none of them near black or white.
inline cv::Mat street(int width, int height) {
  cv::Mat image(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at<cv::Vec3b>(y, x) = {static_cast<uchar>(110 + (x * 3 + y) % 17),
                                   static_cast<uchar>(120 + (x + y * 2) % 13),
                                   static_cast<uchar>(130 + (x * y) % 11)};
    }
  }
  return image;
}

inline Background background_of(const cv::Mat& image, float sigma = 0) {
  return {image, cv::Mat(image.size(), CV_32FC1, cv::Scalar(sigma))};
}

inline bool equal(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y) {
    if (!std::equal(a.ptr(y), a.ptr(y) + a.cols * static_cast<int>(a.elemSize()), b.ptr(y))) {
      return false;
    }
  }
  return true;
}

/// 3 m above the ground, looking along +y and a little down.
inline Camera camera_above() {
  const double c = std::cos(0.25), s = std::sin(0.25);
  CameraFromWorld pose;
  pose.rotation << 1, 0, 0, 0, -s, -c, 0, c, -s;
  pose.translation = -pose.rotation * Eigen::Vector3d(0, 0, 3);
  return Camera::pinhole("one", {320, 240},
                         {.fx_px = 300, .fy_px = 300, .cx_px = 160, .cy_px = 120, .distortion = {}},
                         pose);
}

}  // namespace plaza::color::test
