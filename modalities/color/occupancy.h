#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
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
  std::span<const CountSpan> spans(std::uint32_t begin, std::uint32_t end) const {
    return std::span(spans_).subspan(begin, end - begin);
  }

 private:
  std::uint32_t append(const std::vector<RowSpan>& spans);

  cv::Size image_;
  std::vector<SpanTemplate> templates_;
  std::vector<CountSpan> spans_;
};

/// `spans` (by rising row) grown by `radius` pixels to all sides, as a square brush would, cut to
/// the image, without overlaps, by rising row.
std::vector<RowSpan> dilated(const std::vector<RowSpan>& spans, int radius, cv::Size image);

/// Spans as one list, by rising index and without overlaps.
std::vector<CountSpan> united(std::vector<CountSpan> spans);

/// What is counted in silhouettes.
struct Countable {
  const RowCounts& foreground;           ///< without what is blind
  const RowCounts& blind;                ///< pixels that count nowhere; empty: none
  std::span<const CountSpan> explained;  ///< neither do these; see united()
};

/// Share of foreground inside the silhouette minus its share in the ring, in [-1, 1]. Nothing when
/// less than `least_visible` of the silhouette is left to look at, parts outside the image counted
/// as not visible. A ring without a pixel to look at counts as free of foreground.
std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                const Countable& seen, double least_visible);

}  // namespace plaza::color
