#include "modalities/color/cast_shadow.h"

#include <array>
#include <opencv2/imgproc.hpp>

namespace plaza::color {
namespace {

constexpr double kDarkest = 1.0 / 3;
constexpr double kBrightest = 1.02;  ///< noise
constexpr double kBluer = 7.0 / 6;   ///< than the next channel, at most
constexpr double kRedder = 0.96;     ///< noise

bool may_be_shadow(const cv::Vec3b& seen, const cv::Vec3b& ground) {
  std::array<double, 3> left;  // of blue, green, red
  for (int c = 0; c < 3; ++c) {
    left[static_cast<std::size_t>(c)] = (seen[c] + 1.0) / (ground[c] + 1.0);
  }
  for (const double share : left) {
    if (share < kDarkest || share > kBrightest) return false;
  }
  for (std::size_t c = 0; c < 2; ++c) {
    const double step = left[c] / left[c + 1];
    if (step < kRedder || step > kBluer) return false;
  }
  return true;
}

}  // namespace

cv::Mat without_shadows(const cv::Mat& mask, const cv::Mat& image, const cv::Mat& background,
                        const BodyScale& scale, double most_m) {
  cv::Mat seen, ground, out = mask.clone();
  cv::blur(image, seen, cv::Size(3, 3));
  cv::blur(background, ground, cv::Size(3, 3));
  for (int y = mask.rows - 2; y >= 0; --y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<uchar>(y, x) == 0 || mask.at<uchar>(y + 1, x) != 0) continue;
      const int most = static_cast<int>(most_m * scale.px_per_m(x, y));
      for (int v = y; v > y - most && v >= 0 && mask.at<uchar>(v, x) != 0; --v) {
        if (!may_be_shadow(seen.at<cv::Vec3b>(v, x), ground.at<cv::Vec3b>(v, x))) break;
        out.at<uchar>(v, x) = 0;
      }
    }
  }
  return out;
}

}  // namespace plaza::color
