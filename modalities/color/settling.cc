#include "modalities/color/settling.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>

namespace plaza::color {
namespace {

constexpr int kAlike = 16;  // grey levels of each channel: noise, and light that is still followed
constexpr int kForgetting = 4;
constexpr double kOldEnough = 0.9;  // where some pixels are old, others nearly so go with them

bool alike(const cv::Vec3b& a, const cv::Vec3b& b) {
  return std::abs(a[0] - b[0]) <= kAlike && std::abs(a[1] - b[1]) <= kAlike &&
         std::abs(a[2] - b[2]) <= kAlike;
}

int looks_until_settled(const SettlingOptions& options) {
  return static_cast<int>(
      std::clamp(std::ceil(options.after_s / options.interval_s), 1.0, 65535.0));
}

}  // namespace

Settling settle(const Settling& before, const cv::Mat& image, const cv::Mat& foreground,
                double seconds, const SettlingOptions& options) {
  Settling now;
  now.unseen_s = before.unseen_s + seconds;
  if (before.candidate.empty()) {
    now.candidate = image.clone();
    now.age = cv::Mat1w(image.size(), ushort{0});
    return now;
  }
  // half a frame early is nearer than half a frame late
  if (now.unseen_s + seconds / 2 < options.interval_s) {
    now.candidate = before.candidate;
    now.age = before.age;
    return now;
  }
  now.unseen_s = 0;
  now.candidate = before.candidate.clone();
  now.age = before.age.clone();
  const int most = looks_until_settled(options);
  for (int y = 0; y < image.rows; ++y) {
    const auto* f = image.ptr<cv::Vec3b>(y);
    const uchar* const mask = foreground.ptr(y);
    auto* const kept = now.candidate.ptr<cv::Vec3b>(y);
    ushort* const age = now.age[y];
    for (int x = 0; x < image.cols; ++x) {
      if (mask[x] == 0) {
        if (age[x] > 0) --age[x];
      } else if (alike(f[x], kept[x])) {
        age[x] = static_cast<ushort>(std::min(age[x] + 1, most));
      } else {
        age[x] = static_cast<ushort>(std::max(age[x] - kForgetting, 0));
        if (age[x] == 0) kept[x] = f[x];
      }
    }
  }
  return now;
}

std::optional<Background> settled(const Background& background, Settling& settling,
                                  const SettlingOptions& options) {
  if (settling.unseen_s > 0) return std::nullopt;  // nothing has grown older
  const int most = looks_until_settled(options);
  double oldest = 0;
  cv::minMaxLoc(settling.age, nullptr, &oldest);
  if (oldest < most) return std::nullopt;
  Background out;
  out.image = background.image.clone();
  out.noise = background.noise;
  cv::Mat old;
  cv::compare(settling.age, std::ceil(kOldEnough * most), old, cv::CMP_GE);
  settling.candidate.copyTo(out.image, old);
  settling.age = settling.age.clone();
  settling.age.setTo(0, old);
  return out;
}

}  // namespace plaza::color
