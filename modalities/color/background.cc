#include "modalities/color/background.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "plaza/core/error.h"
#include "plaza/core/parallel.h"

namespace plaza::color {
namespace {

/// Of a Gaussian, standard deviation over median absolute deviation.
constexpr float kSigmaOfMad = 1.4826F;

/// How often each of 256 values occurred at one pixel.
class ValueCounts {
 public:
  void add(int value) { ++counts_[static_cast<std::size_t>(value)]; }
  /// The lower median of `total` values, which is one of them.
  int median(std::size_t total) const {
    const std::size_t rank = (total - 1) / 2;
    std::size_t below = 0;
    for (std::size_t value = 0; value < counts_.size(); ++value) {
      below += counts_[value];
      if (below > rank) return static_cast<int>(value);
    }
    return 0;
  }

 private:
  std::array<std::size_t, 256> counts_ = {};
};

void learn_row(const std::vector<cv::Mat>& samples, int y, Background& background) {
  auto* const colour = background.image.ptr<uchar>(y);
  auto* const noise = background.noise.ptr<float>(y);
  std::vector<const uchar*> rows;
  rows.reserve(samples.size());
  for (const cv::Mat& sample : samples) rows.push_back(sample.ptr<uchar>(y));
  for (int x = 0; x < background.image.cols; ++x) {
    float sum = 0;
    for (int i = 3 * x; i < 3 * x + 3; ++i) {
      ValueCounts values;
      for (const uchar* row : rows) values.add(row[i]);
      const int middle = values.median(rows.size());
      ValueCounts deviations;
      for (const uchar* row : rows) deviations.add(std::abs(row[i] - middle));
      colour[i] = static_cast<uchar>(middle);
      sum += static_cast<float>(deviations.median(rows.size()));
    }
    noise[x] = kSigmaOfMad * sum / 3.0F;
  }
}

}  // namespace

void BackgroundLearner::add(const cv::Mat& image) {
  if (!samples_.empty() && image.size() != samples_.front().size()) {
    throw UserError("the background is learned from images of one size, but after " +
                    std::to_string(samples_.front().cols) + "x" +
                    std::to_string(samples_.front().rows) + " came " + std::to_string(image.cols) +
                    "x" + std::to_string(image.rows));
  }
  if (seen_++ % stride_ != 0) return;
  if (samples_.size() == most_samples_) {
    // samples stand at 0, s, 2s, ...: with every second one gone they stand at 0, 2s, 4s, ...
    const std::size_t position = samples_.size() * stride_;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples_.size(); i += 2) samples_[kept++] = samples_[i];
    samples_.resize(kept);
    stride_ *= 2;
    if (position % stride_ != 0) return;
  }
  samples_.push_back(image);
}

Background BackgroundLearner::background() const {
  Background background;
  if (samples_.empty()) return background;
  background.image.create(samples_.front().size(), CV_8UC3);
  background.noise.create(samples_.front().size(), CV_32FC1);
  parallel_for(static_cast<std::size_t>(background.image.rows),
               [&](std::size_t y) { learn_row(samples_, static_cast<int>(y), background); });
  return background;
}

}  // namespace plaza::color
