#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace plaza::synthetic {

struct SensorOptions {
  double blur_px = 0.6;        ///< sigma of the lens's point spread
  double vignetting = 0.25;    ///< light lost in the corners, [0, 1]
  double noise = 1.0;          ///< factor on the noise of a common industrial camera
  double colour_spread = 1.0;  ///< factor on how far cameras differ in colour and exposure
  bool bayer = true;           ///< one colour per pixel, the others interpolated
};

/// A camera behind its lens: from radiance to the 8-bit image that leaves it.
class Sensor {
 public:
  /// `exposure`: radiance of 1 / exposure gives a white pixel. `seed` decides how this camera
  /// differs from the next one.
  Sensor(cv::Size size, const SensorOptions& options, float exposure, std::uint64_t seed);

  /// `radiance`: CV_32FC3, linear red, green, blue; is blurred in place. `key` decides the noise.
  /// Gives CV_8UC3, BGR.
  cv::Mat develop(cv::Mat& radiance, std::uint32_t key) const;

 private:
  void expose(cv::Mat& radiance) const;
  cv::Mat mosaic(const cv::Mat& exposed, std::uint32_t key) const;
  float noisy(float value, std::uint32_t key) const;

  SensorOptions options_;
  Eigen::Matrix3f colour_;          // of this camera from linear RGB, exposure included
  std::vector<float> falloff_;      // by pixel
  std::vector<std::uint8_t> tone_;  // 8-bit value of a linear one in [0, 1], 4096 steps
};

/// The exposure with which a camera's automatic would take a picture of this radiance: a tenth of
/// the pixels are brighter than 0.6 of white.
float automatic_exposure(const cv::Mat& radiance);

}  // namespace plaza::synthetic
