#include "plugins/sources/synthetic/sensor/sensor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "plugins/sources/synthetic/common/pixel_random.h"
#include "plugins/sources/synthetic/people/random.h"

namespace plaza::synthetic {
namespace {

// A 1/3 inch CMOS sensor of the thesis's time.
constexpr float kFullWell = 9000;  // electrons of a white pixel
constexpr float kReadNoise = 22;   // electrons
constexpr int kToneSteps = 4096;
constexpr float kGamma = 2.2f;
constexpr float kBrightShare = 0.9f, kBrightLevel = 0.6f;

/// About a standard normal: the sum of four bytes.
float normal(std::uint32_t key) {
  const std::uint32_t h = hash32(key);
  const auto sum = static_cast<float>((h & 255) + ((h >> 8) & 255) + ((h >> 16) & 255) + (h >> 24));
  return (sum - 510.0f) / 147.8f;
}

float luminance(const Eigen::Vector3f& c) {
  return 0.2126f * c.x() + 0.7152f * c.y() + 0.0722f * c.z();
}

}  // namespace

float automatic_exposure(const cv::Mat& radiance) {
  const auto* pixel = radiance.ptr<Eigen::Vector3f>();
  std::vector<float> levels;
  levels.reserve(radiance.total());
  for (std::size_t i = 0; i < radiance.total(); ++i) levels.push_back(luminance(pixel[i]));
  const auto bright = levels.begin() +
                      static_cast<std::ptrdiff_t>(kBrightShare * static_cast<float>(levels.size()));
  std::nth_element(levels.begin(), bright, levels.end());
  return kBrightLevel / std::max(*bright, 1e-6f);
}

Sensor::Sensor(cv::Size size, const SensorOptions& options, float exposure, std::uint64_t seed)
    : options_(options) {
  Random draw(mix(seed, 0x5e2502));
  const auto vary = [&](double by) {
    return static_cast<float>(1 + options.colour_spread * draw.uniform(-by, by));
  };
  colour_.setIdentity();
  for (int k = 0; k < 3; ++k) colour_(k, k) = vary(0.045);
  for (int row = 0; row < 3; ++row) {  // filters overlap, a little differently in each camera
    for (int column = 0; column < 3; ++column) {
      if (row != column) colour_(row, column) = 0.06f * vary(0.5);
    }
  }
  colour_ *= exposure * vary(0.07) / 1.12f;
  falloff_.reserve(static_cast<std::size_t>(size.area()));
  const float half =
      0.5f * std::hypot(static_cast<float>(size.width), static_cast<float>(size.height));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float r = std::hypot(static_cast<float>(x) - 0.5f * static_cast<float>(size.width),
                                 static_cast<float>(y) - 0.5f * static_cast<float>(size.height)) /
                      half;
      falloff_.push_back(1 - static_cast<float>(options.vignetting) * r * r);
    }
  }
  for (int i = 0; i < kToneSteps; ++i) {
    const float v = (static_cast<float>(i) + 0.5f) / kToneSteps;
    tone_.push_back(static_cast<std::uint8_t>(std::lround(255 * std::pow(v, 1 / kGamma))));
  }
}

void Sensor::expose(cv::Mat& radiance) const {
  auto* pixel = radiance.ptr<Eigen::Vector3f>();
  for (std::size_t i = 0; i < falloff_.size(); ++i) pixel[i] = falloff_[i] * (colour_ * pixel[i]);
  if (options_.blur_px > 0) {
    cv::GaussianBlur(radiance, radiance, cv::Size(), options_.blur_px, options_.blur_px,
                     cv::BORDER_REPLICATE);
  }
}

float Sensor::noisy(float value, std::uint32_t key) const {
  const float electrons = kFullWell * std::clamp(value, 0.0f, 1.2f);
  const float sigma = std::sqrt(electrons + kReadNoise * kReadNoise);
  return (electrons + static_cast<float>(options_.noise) * sigma * normal(key)) / kFullWell;
}

cv::Mat Sensor::mosaic(const cv::Mat& exposed, std::uint32_t key) const {
  const int w = exposed.cols, h = exposed.rows;
  // one colour per pixel: R G / G B; a border of one pixel repeats the one inside by two
  cv::Mat raw(h + 2, w + 2, CV_32FC1);
  for (int y = 0; y < h; ++y) {
    const auto* in = exposed.ptr<cv::Vec3f>(y);
    auto* out = raw.ptr<float>(y + 1) + 1;
    for (int x = 0; x < w; ++x) {
      const int colour = (y & 1) + (x & 1);
      out[x] = noisy(in[x][colour], key + static_cast<std::uint32_t>(y * w + x));
    }
    out[-1] = out[1];
    out[w] = out[w - 2];
  }
  raw.row(2).copyTo(raw.row(0));
  raw.row(h - 1).copyTo(raw.row(h + 1));
  cv::Mat full(h, w, CV_32FC3);
  for (int y = 0; y < h; ++y) {
    const auto* up = raw.ptr<float>(y) + 1;
    const auto* at = raw.ptr<float>(y + 1) + 1;
    const auto* low = raw.ptr<float>(y + 2) + 1;
    auto* out = full.ptr<cv::Vec3f>(y);
    for (int x = 0; x < w; ++x) {
      const float cross = 0.25f * (up[x] + low[x] + at[x - 1] + at[x + 1]);
      if (((x + y) & 1) != 0) {  // green: the other two are left and right, above and below
        const float side = 0.5f * (at[x - 1] + at[x + 1]), upright = 0.5f * (up[x] + low[x]);
        out[x] = (y & 1) == 0 ? cv::Vec3f(side, at[x], upright) : cv::Vec3f(upright, at[x], side);
      } else {
        const float corners = 0.25f * (up[x - 1] + up[x + 1] + low[x - 1] + low[x + 1]);
        out[x] = (y & 1) == 0 ? cv::Vec3f(at[x], cross, corners) : cv::Vec3f(corners, cross, at[x]);
      }
    }
  }
  return full;
}

cv::Mat Sensor::develop(cv::Mat& radiance, std::uint32_t key) const {
  expose(radiance);
  cv::Mat linear = radiance;
  if (options_.bayer) {
    linear = mosaic(radiance, hash32(key));
  } else if (options_.noise > 0) {
    for (int y = 0; y < linear.rows; ++y) {
      auto* row = linear.ptr<float>(y);
      const std::uint32_t mine = hash32(hash32(key) + static_cast<std::uint32_t>(y));
      for (int i = 0; i < 3 * linear.cols; ++i)
        row[i] = noisy(row[i], mine + static_cast<std::uint32_t>(i));
    }
  }
  cv::Mat image(linear.size(), CV_8UC3);
  const auto tone = [&](float v) {
    return tone_[static_cast<std::size_t>(std::clamp(v * kToneSteps, 0.0f, kToneSteps - 1.0f))];
  };
  for (int y = 0; y < linear.rows; ++y) {
    const auto* in = linear.ptr<cv::Vec3f>(y);
    auto* out = image.ptr<cv::Vec3b>(y);
    for (int x = 0; x < linear.cols; ++x) {
      out[x] = {tone(in[x][2]), tone(in[x][1]), tone(in[x][0])};
    }
  }
  return image;
}

}  // namespace plaza::synthetic
