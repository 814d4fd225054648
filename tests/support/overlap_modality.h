#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/data/evidence.h"

namespace plaza::test {

/// A modality for tests of what searches over modalities: pixels brighter than half are people. The
/// log-likelihood of a silhouette is 4.5 * (overlap - 1), the overlap being intersection over union
/// of silhouette and bright pixels within the silhouette's box and a third of its width around.
/// Silhouettes that were explained count nowhere.
class OverlapModality final : public Modality {
 public:
  struct Options {
    double blind_below_share = 0.05;
  };
  static Declaration<Options> declare() {
    Parameters<Options> p;
    p.value("blind_below_share", &Options::blind_below_share)
        .at_least(0)
        .meaning("nothing is said of silhouettes with a smaller share in the image");
    return Declaration<Options>("overlap", "Compares silhouettes with bright pixels.")
        .input<FrameSet>("images")
        .output<EvidenceSet>("bright pixels")
        .parameters(std::move(p));
  }
  OverlapModality(const Options& options, const BuildContext& context)
      : Modality(context), options_(options) {}

 private:
  static constexpr uchar kDark = 0, kBright = 1, kExplained = 2;
  struct Bright final : Evidence {
    cv::Mat pixels;  ///< 8-bit; kBright, kDark or kExplained
    cv::Mat sums;  ///< 32-bit, one column more than the image: bright pixels left of it in the row
    cv::Mat hidden;  ///< the same of explained pixels
    void count() {
      sums = cv::Mat::zeros(pixels.rows, pixels.cols + 1, CV_32S);
      hidden = sums.clone();
      for (int y = 0; y < pixels.rows; ++y) {
        for (int x = 0; x < pixels.cols; ++x) {
          const int pixel = pixels.at<uchar>(y, x);
          sums.at<int>(y, x + 1) = sums.at<int>(y, x) + (pixel == kBright ? 1 : 0);
          hidden.at<int>(y, x + 1) = hidden.at<int>(y, x) + (pixel == kExplained ? 1 : 0);
        }
      }
    }
    static int between(const cv::Mat& counts, int row, int begin, int end) {
      return counts.at<int>(row, end) - counts.at<int>(row, begin);
    }
  };
  struct Silhouettes final : TemplateBatch {
    std::vector<Silhouette> items;
    std::size_t size() const override { return items.size(); }
  };

  Prepared do_prepare(const cv::Mat& image, std::size_t /*camera*/,
                      const Past& /*past*/) const override {
    auto bright = std::make_shared<Bright>();
    bright->pixels = cv::Mat(image.size(), CV_8UC1);
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        bright->pixels.at<uchar>(y, x) = image.at<cv::Vec3b>(y, x)[1] > 127 ? kBright : kDark;
      }
    }
    bright->count();
    return {bright, {}};
  }
  std::unique_ptr<TemplateBatch> do_sample(const ShapeModel& model, std::span<const Pose> poses,
                                           std::size_t camera) const override {
    auto batch = std::make_unique<Silhouettes>();
    for (const Pose& pose : poses) {
      batch->items.push_back(model.silhouette(pose, scene().cameras[camera]));
    }
    return batch;
  }
  void do_match(const Evidence& evidence, const TemplateBatch& templates,
                std::span<const std::uint32_t> which, std::span<double> out) const override {
    const auto& bright = static_cast<const Bright&>(evidence);
    const auto& items = static_cast<const Silhouettes&>(templates).items;
    for (std::size_t i = 0; i < which.size(); ++i) out[i] = likelihood(bright, items[which[i]]);
  }
  double likelihood(const Bright& bright, const Silhouette& s) const {
    if (s.spans.empty() || s.inside_share < options_.blind_below_share) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const int columns = bright.sums.cols - 1, rows = bright.sums.rows;
    const auto clamped = [](double v, int size) {
      return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size)));
    };
    const double room = s.box.width / 3;
    const int left = clamped(s.box.left - room, columns);
    const int right = clamped(s.box.right() + room + 1, columns);
    int near = 0, area = 0, both = 0, hidden_area = 0;
    for (int y = clamped(s.box.top - room, rows); y < clamped(s.box.bottom() + room + 1, rows); ++y)
      near += Bright::between(bright.sums, y, left, right);
    for (const RowSpan& span : s.spans) {
      const int hidden = Bright::between(bright.hidden, span.row, span.begin, span.end);
      area += span.end - span.begin - hidden;
      hidden_area += hidden;
      both += Bright::between(bright.sums, span.row, span.begin, span.end);
    }
    if (hidden_area > 2 * area) return std::numeric_limits<double>::quiet_NaN();
    return 4.5 * (static_cast<double>(both) / (area + near - both) - 1);
  }
  EvidencePtr do_explain(const EvidencePtr& evidence, const TemplateBatch& templates,
                         std::span<const std::uint32_t> which) const override {
    auto rest = std::make_shared<Bright>();
    rest->pixels = static_cast<const Bright&>(*evidence).pixels.clone();
    for (const std::uint32_t index : which) {
      for (const RowSpan& s : static_cast<const Silhouettes&>(templates).items[index].spans) {
        rest->pixels(cv::Rect(s.begin, s.row, s.end - s.begin, 1)).setTo(cv::Scalar(kExplained));
      }
    }
    rest->count();
    return rest;
  }

  Options options_;
};

}  // namespace plaza::test
