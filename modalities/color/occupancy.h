#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "plaza/component/modality.h"
#include "plaza/component/models.h"

namespace plaza::color {

/// Running counts along the rows of a mask: the number of set pixels in any span of a row is one
/// difference. Empty: of no image.
class RowCounts {
 public:
  RowCounts() = default;
  /// Of an 8-bit mask, 0 or not 0, at most 65535 wide.
  explicit RowCounts(const cv::Mat& mask);

  bool empty() const { return counts_.empty(); }
  /// Index of the count of pixels left of (row, x), 0 <= x <= width.
  static std::uint32_t index(std::int32_t row, std::int32_t x, int width) {
    return static_cast<std::uint32_t>(row) * (static_cast<std::uint32_t>(width) + 1) +
           static_cast<std::uint32_t>(x);
  }
  std::uint16_t operator[](std::uint32_t i) const { return counts_[i]; }
  /// Counts some rows anew, after `mask` changed there.
  void recount(const cv::Mat& mask, int first_row, int end_row);

 private:
  std::vector<std::uint16_t> counts_;
};

/// A span of pixels as two indices of RowCounts.
struct CountSpan {
  std::uint32_t begin = 0, end = 0;
};

/// How the ring around a silhouette lies, as shares of the silhouette's height.
struct RingShape {
  double gap = 0;    ///< between silhouette and ring; 0: none
  double width = 0;  ///< of the ring; at least one pixel
};

/// One template: the spans of the silhouette, then those of all that lies within the gap, then
/// those of all that lies within the ring, each cut to the image.
struct SpanTemplate {
  std::uint32_t inner = 0;       ///< first span of the silhouette
  std::uint32_t near = 0;        ///< first span of the silhouette and gap
  std::uint32_t outer = 0;       ///< first span of the silhouette, gap and ring
  std::uint32_t end = 0;         ///< behind the last
  std::uint32_t inner_area = 0;  ///< pixels
  std::uint32_t near_area = 0;   ///< pixels, the silhouette included
  std::uint32_t outer_area = 0;  ///< pixels, silhouette and gap included
  float full_area = 0;           ///< pixels of the silhouette, parts outside the image included
};

/// Templates of one view, made for RowCounts.
class SpanTemplates final : public TemplateBatch {
 public:
  explicit SpanTemplates(cv::Size image) : image_(image) {}
  void add(const Silhouette& silhouette, const RingShape& ring);

  std::size_t size() const override { return templates_.size(); }
  cv::Size image() const { return image_; }
  const SpanTemplate& at(std::size_t i) const { return templates_.at(i); }
  const CountSpan& span(std::uint32_t i) const { return spans_[i]; }

 private:
  std::uint32_t append(const std::vector<RowSpan>& spans);

  cv::Size image_;
  std::vector<SpanTemplate> templates_;
  std::vector<CountSpan> spans_;
};

/// `spans` (by rising row) grown by `radius` pixels to all sides, as a square brush would, cut to
/// the image, without overlaps, by rising row.
std::vector<RowSpan> dilated(const std::vector<RowSpan>& spans, int radius, cv::Size image);

/// Share of foreground inside the silhouette minus its share in the ring, in [-1, 1]; pixels that
/// are set in `explained` count nowhere (empty: none are). Nothing when less than `least_visible`
/// of the silhouette is left to look at, parts outside the image counted as not visible. A ring
/// without a pixel to look at counts as free of foreground.
std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                const RowCounts& foreground, const RowCounts& explained,
                                double least_visible);

}  // namespace plaza::color
