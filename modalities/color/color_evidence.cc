#include "modalities/color/color_evidence.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace plaza::color {
namespace {

cv::Mat coloured(const cv::Mat& grey) {
  cv::Mat bgr;
  cv::cvtColor(grey, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

/// Logarithmic, so that noise (1) is dark, the usual thresholds are grey and full change is white.
cv::Mat strength_picture(const cv::Mat& strength) {
  cv::Mat grey(strength.size(), CV_8UC1);
  const double scale = 255 / std::log2(1.0 + 65535.0 / kStepsPerUnit);
  for (int y = 0; y < strength.rows; ++y) {
    const auto* const in = strength.ptr<std::uint16_t>(y);
    auto* const out = grey.ptr<uchar>(y);
    for (int x = 0; x < strength.cols; ++x) {
      const double units = static_cast<double>(in[x]) / kStepsPerUnit;
      out[x] = static_cast<uchar>(std::lround(scale * std::log2(1.0 + units)));
    }
  }
  return coloured(grey);
}

}  // namespace

ColorEvidence::ColorEvidence(State state, cv::Mat image, Segmentation segmentation,
                             std::shared_ptr<const Background> background,
                             std::shared_ptr<const Blind> blind, Shrink shrink)
    : state_(state),
      shrink_(shrink),
      image_(std::move(image)),
      segmentation_(std::move(segmentation)),
      background_(std::move(background)),
      blind_(std::move(blind)) {
  if (state_ != State::kUsable) return;
  cv::Mat counted = segmentation_.mask;
  if (!blind_->mask.empty()) {
    counted = segmentation_.mask.clone();
    counted.setTo(cv::Scalar(0), blind_->mask);
  }
  counts_ = std::make_shared<AreaCounts>(counted);
}

ColorEvidence::ColorEvidence(const ColorEvidence& other, Patches explained)
    : state_(other.state_),
      shrink_(other.shrink_),
      image_(other.image_),
      segmentation_(other.segmentation_),
      background_(other.background_),
      blind_(other.blind_),
      counts_(other.counts_),
      memos_(other.memos_),
      alone_(other.alone_),
      explained_(std::move(explained)) {}

const cv::Mat& ColorEvidence::lab() const {
  std::call_once(lab_once_, [&] { cv::cvtColor(image_, lab_, cv::COLOR_BGR2Lab); });
  return lab_;
}

std::vector<Picture> ColorEvidence::pictures() const {
  std::vector<Picture> pictures;
  if (background_) {
    pictures.push_back({"background", "learned background", background_->image.clone()});
  }
  if (!segmentation_.strength.empty()) {
    pictures.push_back({"change", "strength of change against the background",
                        strength_picture(segmentation_.strength)});
  }
  if (!segmentation_.mask.empty()) {
    pictures.push_back(
        {"foreground",
         state_ == State::kOtherBackground ? "foreground (not used: nearly all)" : "foreground",
         coloured(segmentation_.mask)});
  }
  return shrink_.back(std::move(pictures));
}

TemplateCounts ColorEvidence::seen(const SpanTemplates& templates, std::size_t piece,
                                   CountMemo& memo) const {
  if (memo.knows(piece)) return memo.at(piece);
  const TemplateCounts counts = color::count(templates, piece, *counts_, blind_->counts);
  memo.keep(piece, counts);
  return counts;
}

TemplateCounts ColorEvidence::left(const SpanTemplates& templates, std::size_t piece,
                                   CountMemo& memo) const {
  TemplateCounts counts = seen(templates, piece, memo);
  take_away(templates, piece, explained_, counts);
  return counts;
}

std::optional<double> ColorEvidence::occupancy(const SpanTemplates& templates, std::size_t index,
                                               double least_visible, CountMemo& memo) const {
  if (state_ != State::kUsable) return std::nullopt;
  return color::occupancy(templates, index, seen(templates, index, memo), explained_,
                          least_visible);
}

std::vector<TemplateCounts> ColorEvidence::count(const OpenclCounter& device,
                                                 const SpanTemplates& templates,
                                                 std::span<const std::uint32_t> which) const {
  const cv::UMat& foreground = on_device_.get([&] { return OpenclCounter::upload(*counts_); });
  const cv::UMat& blind = blind_->on_device.get(
      [&] { return blind_->counts.empty() ? cv::UMat() : OpenclCounter::upload(blind_->counts); });
  return device.count(foreground, blind, counts_->stride(), templates, which);
}

std::shared_ptr<const ColorEvidence> ColorEvidence::without(
    const SpanTemplates& templates, std::span<const std::uint32_t> which) const {
  Patches patches = explained_;
  for (const std::uint32_t index : which) {
    if (!templates.near_box(index).empty()) {
      patches.push_back(patch_of(templates, index, patches));
    }
  }
  return std::shared_ptr<const ColorEvidence>(new ColorEvidence(*this, std::move(patches)));
}

ColorEvidence::PatchPtr ColorEvidence::patch_of(const SpanTemplates& templates, std::size_t body,
                                                const Patches& before) const {
  const cv::Rect box = templates.near_box(body);
  const auto make = [&] {  // with the gap: arms are the person's too
    std::vector<BoundaryRun> runs;
    for (std::size_t piece = body * templates.parts(); piece < (body + 1) * templates.parts();
         ++piece) {
      const SpanTemplate& t = templates.at(piece);
      const std::span<const BoundaryRun> of_piece = templates.runs(t.near, t.outer);
      runs.insert(runs.end(), of_piece.begin(), of_piece.end());
    }
    return std::make_shared<const ExplainedPatch>(runs, box, segmentation_.mask, blind_->mask,
                                                  before);
  };
  const bool alone = std::none_of(before.begin(), before.end(), [&](const PatchPtr& patch) {
    return !(patch->box() & box).empty();
  });
  if (!alone) return make();
  Memo<PatchPtr>& memo = alone_->of(templates.serial(), templates.size());
  if (memo.knows(body)) return memo.at(body);
  PatchPtr patch = make();
  memo.keep(body, patch);
  return patch;
}

}  // namespace plaza::color
