#include "modalities/color/criterion.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace plaza::color {
namespace {

constexpr double kDegreesOfFreedom = 26;  // 27 values less the one along the common direction

/// Sum over the 3 x 3 window around (x, y) of `value(y, x)`, border pixels repeated.
template <class Value>
double window_sum(const cv::Size& size, int y, int x, const Value& value) {
  double sum = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      sum += value(std::clamp(y + dy, 0, size.height - 1), std::clamp(x + dx, 0, size.width - 1));
    }
  }
  return sum;
}

/// Rows of 32-bit sums, padded by one pixel at either end; three of them go around.
class RowRing {
 public:
  explicit RowRing(int n) : n_(n), values_(3 * (static_cast<std::size_t>(n) + 2)) {}
  std::int32_t* row(int y) {
    return values_.data() +
           static_cast<std::size_t>((y + 3) % 3) * (static_cast<std::size_t>(n_) + 2) + 1;
  }
  void repeat_border(int y) {
    std::int32_t* const r = row(y);
    r[-1] = r[0];
    r[n_] = r[n_ - 1];
  }

 private:
  int n_;
  std::vector<std::int32_t> values_;
};

}  // namespace

Criterion::Criterion(const Background& background, const CriterionOptions& options)
    : size_(background.image.size()) {
  if (background.empty()) throw std::invalid_argument("the criterion needs a background");
  for (cv::Mat& plane : planes_) plane.create(size_, CV_8UC1);
  energy_.create(size_, CV_32FC1);
  weight_.create(size_, CV_32FC1);
  const double darkness = options.darkness * options.darkness;
  const double least_variance = options.least_noise_px * options.least_noise_px;
  for (int y = 0; y < size_.height; ++y) {
    for (int x = 0; x < size_.width; ++x) {
      const auto& colour = background.image.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) planes_[c].at<uchar>(y, x) = colour[c];
      energy_.at<float>(y, x) =
          static_cast<float>(darkness + window_sum(size_, y, x, [&](int v, int u) {
                               const auto& b = background.image.at<cv::Vec3b>(v, u);
                               return static_cast<double>(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
                             }));
      const double variance = window_sum(size_, y, x,
                                         [&](int v, int u) {
                                           const double sigma = background.noise.at<float>(v, u);
                                           return std::max(sigma * sigma, least_variance);
                                         }) /
                              9;
      weight_.at<float>(y, x) =
          static_cast<float>(kStepsPerUnit * 2 / (kDegreesOfFreedom * variance));
    }
  }
}

cv::Mat Criterion::strength(const cv::Mat& image, const RowKernels& kernels) const {
  CV_Assert(image.size() == size_ && image.type() == CV_8UC3);
  const int n = size_.width;
  cv::Mat out(size_, CV_16UC1);
  RowRing along(n);
  RowRing change(n);
  std::vector<std::int32_t> sums(2 * (static_cast<std::size_t>(n) + 2));
  const auto moments = [&](int y) {
    kernels.moments(image.ptr(y), planes_[0].ptr(y), planes_[1].ptr(y), planes_[2].ptr(y),
                    along.row(y), change.row(y), n);
    along.repeat_border(y);
    change.repeat_border(y);
  };
  moments(0);
  for (int y = 0; y < size_.height; ++y) {
    const int above = std::max(y - 1, 0);
    const int below = std::min(y + 1, size_.height - 1);
    if (below > y) moments(below);
    const std::array<const std::int32_t*, 3> a = {along.row(above), along.row(y), along.row(below)};
    const std::array<const std::int32_t*, 3> c = {change.row(above), change.row(y),
                                                  change.row(below)};
    kernels.strength(a.data(), c.data(), energy_.ptr<float>(y), weight_.ptr<float>(y), sums.data(),
                     out.ptr<std::uint16_t>(y), n);
  }
  return out;
}

}  // namespace plaza::color
