#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

#include "modalities/edges/contour_sums.h"
#include "modalities/edges/fast_transform.h"
#include "modalities/edges/templates.h"

namespace plaza::edges {

/// A part of the oriented distance transform done anew: taking edges away changes nothing beyond
/// the gate around them, and the rest of the image is not copied.
class PlanePatch {
 public:
  /// The transform of `edges` inside `valid`, a rectangle inside the image. `transform` is of
  /// `layout`, the whole image's.
  PlanePatch(const PlaneLayout& layout, const cv::Rect& valid, std::span<const EdgePoint> edges,
             FastTransform& transform);

  const cv::Rect& valid() const { return valid_; }
  const std::uint8_t* bytes() const { return bytes_.get(); }
  /// Index of the byte of a pixel of the image inside valid().
  std::uint32_t offset(std::size_t direction, int x, int y) const {
    return layout_.offset(direction, x - window_.x, y - window_.y);
  }
  /// The planes hold this rectangle of the image.
  const cv::Rect& window() const { return window_; }
  const PlaneLayout& layout() const { return layout_; }  ///< of the window

 private:
  cv::Rect valid_, window_;  ///< what is right, and what was swept for it
  PlaneLayout layout_;       ///< of the window
  std::unique_ptr<std::uint8_t[]> bytes_;
};

using PlanePatches = std::vector<std::shared_ptr<const PlanePatch>>;

/// Patches for edges that were taken away inside `removed` rectangles, when `edges` are left,
/// beside `before`, which were right until then. What overlaps becomes one: patches are disjoint.
PlanePatches patched(const PlaneLayout& layout, PlanePatches before,
                     std::span<const cv::Rect> removed, std::span<const EdgePoint> edges,
                     FastTransform& transform);

/// The sums of a template over planes of which a part is patched.
class PatchedSums {
 public:
  /// Everything must outlive the object, which is one thread's.
  PatchedSums(const std::uint8_t* planes,
              std::span<const std::shared_ptr<const PlanePatch>> patches, SumPieces sum)
      : planes_(planes), patches_(patches), sum_(sum) {}

  /// Whether any of its points may be in a patch.
  bool touches(const EdgeTemplates& templates, std::size_t index);
  /// Writes sums[direction] of the template that touches() was last asked for, and that does.
  void sum(const EdgeTemplates& templates, std::size_t index, ContourSum* sums);

 private:
  /// Where a patch lies in the planes of one direction, by their rows and columns.
  struct Window {
    const std::uint8_t* bytes = nullptr;
    std::ptrdiff_t origin = 0;  ///< of row 0, column 0 of the whole plane from `bytes`
    std::ptrdiff_t stride = 0;
    int first_row = 0, end_row = 0, first_column = 0, end_column = 0;

    bool meets(int row, int column, int end) const {
      return row >= first_row && row < end_row && column < end_column && end > first_column;
    }
  };

  void look_along(std::size_t direction, bool steep);
  void add(const std::uint8_t* bytes, int length) {
    __builtin_prefetch(bytes);  // summed up when all are listed
    bytes_[pieces_] = bytes;
    lengths_[pieces_] = static_cast<std::uint8_t>(length);
    ++pieces_;
  }
  /// A run from column to end of a row, in pieces that lie in one place.
  void add_pieces(int row, int column, int end, const std::uint8_t* row_begin);

  const std::uint8_t* planes_;
  std::span<const std::shared_ptr<const PlanePatch>> patches_;
  SumPieces sum_;
  std::vector<const PlanePatch*> near_;  ///< that the template may reach
  std::vector<Window> windows_;          ///< of near_, in the direction that is being listed
  std::size_t pieces_ = 0;
  std::vector<const std::uint8_t*> bytes_;  ///< of the pieces; longer than there are any
  std::vector<std::uint8_t> lengths_;       ///< likewise
  std::vector<std::uint32_t> counts_;       ///< of pieces, by direction
};

}  // namespace plaza::edges
