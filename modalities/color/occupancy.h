#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "modalities/common/body_parts.h"
#include "modalities/common/memo.h"
#include "modalities/common/opencl.h"
#include "plaza/component/modality.h"
#include "plaza/component/models.h"

namespace plaza::color {

class ExplainedPatch;

/// Running counts over the rows and columns of a mask: at (x, y) the number of set pixels left of x
/// and above y, so that what lies between two columns and two rows is four look-ups. Modulo 2^32,
/// as are all differences of them. Empty: of no image.
class AreaCounts {
 public:
  AreaCounts() = default;
  /// Of an 8-bit mask, 0 or not 0, at most 65535 wide and high.
  explicit AreaCounts(const cv::Mat& mask);

  bool empty() const { return counts_.empty(); }
  std::size_t stride() const { return stride_; }
  /// [y * stride() + x], 0 <= x <= width, 0 <= y <= height.
  const std::uint32_t* data() const { return counts_.data(); }
  std::size_t size() const { return counts_.size(); }
  /// Whether a pixel in a box, which lies within the mask, is set; of no image: none.
  bool any_in(const cv::Rect& box) const;

 private:
  std::vector<std::uint32_t> counts_;
  std::size_t stride_ = 0;
};

/// A piece of a region's boundary along a column: the running counts at (x, plus_row) less those at
/// (x, minus_row) are its part of the region's count. Right boundaries have plus_row > minus_row,
/// left ones the other way round. Silhouettes are upright, so that a few dozen of these stand for
/// hundreds of rows.
struct BoundaryRun {
  std::uint16_t x = 0, plus_row = 0, minus_row = 0;
};

/// The boundary of spans that don't overlap, from top to bottom.
std::vector<BoundaryRun> boundary_of(const std::vector<RowSpan>& spans);

/// How the ring around a silhouette lies, as shares of the silhouette's height.
struct RingShape {
  double gap = 0;    ///< between silhouette and ring; 0: none
  double width = 0;  ///< of the ring; at least one pixel
};

/// One template, or one of a body's parts: the boundary of the silhouette, then that of all that
/// lies within the gap, then that of all that lies within the ring, each cut to the image.
struct SpanTemplate {
  std::uint32_t inner = 0;       ///< first boundary run of the silhouette
  std::uint32_t near = 0;        ///< first of silhouette and gap
  std::uint32_t outer = 0;       ///< first of silhouette, gap and ring
  std::uint32_t end = 0;         ///< behind the last
  std::uint32_t inner_area = 0;  ///< pixels
  std::uint32_t near_area = 0;   ///< pixels, the silhouette included
  std::uint32_t outer_area = 0;  ///< pixels, silhouette and gap included
  float full_area = 0;           ///< pixels of the silhouette, parts outside the image included
  cv::Rect near_box, outer_box;  ///< pixels; empty where the silhouette is
};

/// Templates of one view on an OpenCL device.
struct DeviceRegions {
  cv::UMat runs;    ///< BoundaryRun
  cv::UMat bounds;  ///< [4 * piece + i] inner, near, outer, end
};

/// Templates of one view, made for AreaCounts. Where bodies are cut into parts, each part is a
/// template of its own: silhouette, gap and ring of the body fall into theirs without overlap, and
/// what is called `piece` below is the body's number * parts() + that of the part from the ground
/// upwards. Without parts, pieces are bodies.
class SpanTemplates final : public TemplateBatch {
 public:
  explicit SpanTemplates(cv::Size image, std::size_t parts = 1) : image_(image), parts_(parts) {}
  /// In one piece; only without parts.
  void add(const Silhouette& silhouette, const RingShape& ring);
  /// Cut into as many as parts().
  void add(const Silhouette& silhouette, const RingShape& ring, const BodyCuts& cuts);

  std::size_t size() const override { return templates_.size() / parts_; }
  std::size_t parts() const { return parts_; }
  std::size_t pieces() const { return templates_.size(); }
  cv::Size image() const { return image_; }
  const SpanTemplate& at(std::size_t piece) const { return templates_.at(piece); }
  /// Around the near boxes of all parts of a body.
  cv::Rect near_box(std::size_t body) const;
  std::span<const BoundaryRun> runs(std::uint32_t begin, std::uint32_t end) const {
    return std::span(runs_).subspan(begin, end - begin);
  }
  const BatchSerial& serial() const { return serial_; }
  /// The same on the OpenCL device, made when first asked for; no template may be added then.
  const opencl::OnDevice<DeviceRegions>& on_device() const { return on_device_; }

 private:
  std::uint32_t append(const std::vector<RowSpan>& spans);
  void add_piece(const std::vector<RowSpan>& inner, const std::vector<RowSpan>& near,
                 const std::vector<RowSpan>& outer, double inside_share);

  cv::Size image_;
  std::size_t parts_;
  std::vector<SpanTemplate> templates_;
  std::vector<BoundaryRun> runs_;
  BatchSerial serial_;
  opencl::OnDevice<DeviceRegions> on_device_;
};

/// `spans` (by rising row) grown by `radius` pixels to all sides, as a square brush would, cut to
/// the image, without overlaps, by rising row.
std::vector<RowSpan> dilated(const std::vector<RowSpan>& spans, int radius, cv::Size image);

/// What is counted in silhouettes.
struct Countable {
  const AreaCounts& foreground;  ///< without what is blind
  const AreaCounts& blind;       ///< pixels that count nowhere; empty: none
  std::span<const std::shared_ptr<const ExplainedPatch>> explained;  ///< neither do these
};

/// Pixels in one region.
struct Counts {
  std::uint32_t set = 0;     ///< foreground that counts
  std::uint32_t hidden = 0;  ///< pixels that don't count
};
/// Counts in the silhouette, with its gap, and with its ring.
struct TemplateCounts {
  Counts inner, near, outer;
};

/// Where nothing is explained. Here and below, `index` is a piece's.
TemplateCounts count(const SpanTemplates& templates, std::size_t index,
                     const AreaCounts& foreground, const AreaCounts& blind);

/// What is left of them after some people were explained.
void take_away(const SpanTemplates& templates, std::size_t index,
               std::span<const std::shared_ptr<const ExplainedPatch>> explained,
               TemplateCounts& counts);

/// Whether at least `least_visible` of a silhouette is left to look at, and at least a pixel.
bool tells(const SpanTemplate& shape, const Counts& inner, double least_visible);

/// What follows from the counts of a template, see occupancy().
std::optional<double> occupancy(const SpanTemplate& shape, const TemplateCounts& counts,
                                double least_visible);
/// The same after some people were explained; `counts` are those where nobody is.
std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                TemplateCounts counts,
                                std::span<const std::shared_ptr<const ExplainedPatch>> explained,
                                double least_visible);

/// Share of foreground inside the silhouette minus its share in the ring, in [-1, 1]. Nothing when
/// less than `least_visible` of the silhouette is left to look at, parts outside the image counted
/// as not visible. A ring without a pixel to look at counts as free of foreground.
std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                const Countable& seen, double least_visible);

}  // namespace plaza::color
