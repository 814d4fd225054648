#include "modalities/color/label_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

namespace plaza::color {
namespace {

constexpr int kNeighbours = 8;
constexpr int kWindow = 9;

std::uint16_t steps(double units) {
  return static_cast<std::uint16_t>(std::clamp(std::lround(units * kStepsPerUnit), 0L, 65535L));
}

/// Labels 0 and 1 with a margin of one pixel left and right of every row.
class Labels {
 public:
  explicit Labels(cv::Size size)
      : size_(size),
        stride_(static_cast<std::size_t>(size.width) + 2),
        values_(stride_ * static_cast<std::size_t>(size.height)) {}

  std::uint8_t* row(int y) { return values_.data() + static_cast<std::size_t>(y) * stride_ + 1; }
  const std::uint8_t* row(int y) const {
    return values_.data() + static_cast<std::size_t>(y) * stride_ + 1;
  }
  void repeat_border(int y) {
    std::uint8_t* const r = row(y);
    r[-1] = r[0];
    r[size_.width] = r[size_.width - 1];
  }
  std::array<const std::uint8_t*, 3> around(int y) const {
    return {row(std::max(y - 1, 0)), row(y), row(std::min(y + 1, size_.height - 1))};
  }

 private:
  cv::Size size_;
  std::size_t stride_;
  std::vector<std::uint8_t> values_;
};

Labels labels_of(const cv::Mat& mask) {
  Labels labels(mask.size());
  for (int y = 0; y < mask.rows; ++y) {
    const auto* const in = mask.ptr<uchar>(y);
    std::uint8_t* const out = labels.row(y);
    for (int x = 0; x < mask.cols; ++x) out[x] = in[x] >> 7;
    labels.repeat_border(y);
  }
  return labels;
}

cv::Mat mask_of(const Labels& labels, cv::Size size) {
  cv::Mat mask(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    const std::uint8_t* const in = labels.row(y);
    auto* const out = mask.ptr<uchar>(y);
    for (int x = 0; x < size.width; ++x) out[x] = static_cast<uchar>(-in[x]);
  }
  return mask;
}

}  // namespace

LabelFieldSteps::LabelFieldSteps(const LabelFieldOptions& options)
    : threshold(steps(options.threshold)),
      neighbourhood(steps(options.neighbourhood)),
      previous(steps(options.previous)) {}

std::uint16_t LabelFieldSteps::start(bool with_previous) const {
  const int value =
      threshold + neighbourhood * kNeighbours / 2 + (with_previous ? previous * kWindow / 2 : 0);
  return static_cast<std::uint16_t>(std::min(value, 65535));
}

cv::Mat solve_labels(const cv::Mat& strength, const cv::Mat& previous,
                     const LabelFieldOptions& options, const RowKernels& kernels, int* rounds) {
  const cv::Size size = strength.size();
  const int n = size.width;
  const LabelFieldSteps step(options);
  cv::Mat threshold(size, CV_16UC1);
  if (previous.empty()) {
    threshold.setTo(cv::Scalar(step.start(false)));
  } else {
    const Labels before = labels_of(previous);
    for (int y = 0; y < size.height; ++y) {
      kernels.threshold(before.around(y).data(), step.start(true), step.previous,
                        threshold.ptr<std::uint16_t>(y), n);
    }
  }

  Labels now(size);
  Labels next(size);
  const int half = step.neighbourhood * (kNeighbours / 2);
  for (int y = 0; y < size.height; ++y) {
    const auto* const s = strength.ptr<std::uint16_t>(y);
    const auto* const t = threshold.ptr<std::uint16_t>(y);
    std::uint8_t* const out = now.row(y);
    for (int x = 0; x < n; ++x) out[x] = s[x] > std::max(t[x] - half, 0) ? 1 : 0;
    now.repeat_border(y);
  }
  int changed_rounds = 0;
  for (int i = 0; i < options.iterations; ++i) {
    bool changed = false;
    for (int y = 0; y < size.height; ++y) {
      kernels.label(strength.ptr<std::uint16_t>(y), threshold.ptr<std::uint16_t>(y),
                    now.around(y).data(), step.neighbourhood, next.row(y), n);
      next.repeat_border(y);
      changed = changed || std::memcmp(next.row(y), now.row(y), static_cast<std::size_t>(n)) != 0;
    }
    if (!changed) break;
    ++changed_rounds;
    std::swap(now, next);
  }
  if (rounds != nullptr) *rounds = changed_rounds;
  return mask_of(now, size);
}

}  // namespace plaza::color
