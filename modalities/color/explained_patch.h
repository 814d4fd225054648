#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "modalities/color/occupancy.h"

namespace plaza::color {

/// What one accepted person accounts for in a view: the pixels of a silhouette and its gap, counted
/// within their box alone, so that it costs as little as the person is large.
class ExplainedPatch {
 public:
  /// `region` is the boundary of spans inside `box`; `before`: what counts nowhere already. Both
  /// masks are of the image's size; `blind` may be empty.
  ExplainedPatch(std::span<const BoundaryRun> region, const cv::Rect& box,
                 const cv::Mat& foreground, const cv::Mat& blind,
                 std::span<const std::shared_ptr<const ExplainedPatch>> before);

  const cv::Rect& box() const { return box_; }
  /// How much of a region's foreground this takes away, and how many pixels it hides that weren't
  /// hidden before. Runs as boundary_of() orders them.
  Counts count(std::span<const BoundaryRun> runs) const;
  /// Whether it hides a pixel of the image.
  bool hides(int x, int y) const {
    return box_.contains({x, y}) && region_[index(x - box_.x, y - box_.y)] != 0;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(box_.width) +
           static_cast<std::size_t>(x);
  }

  cv::Rect box_;
  std::vector<std::uint8_t> region_;  ///< by index(): whether a pixel belongs to the person
  std::vector<Counts> counts_;        ///< running counts as AreaCounts has them, of the box
};

}  // namespace plaza::color
