#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modalities/edges/fast_transform.h"
#include "plaza/geometry/silhouette.h"

namespace plaza::edges {

/// Pixels that count nowhere, because accepted people account for them; by image rows and by image
/// columns, as planes are, so that a plane's index finds them.
class HiddenRegion {
 public:
  /// No pixel.
  explicit HiddenRegion(const PlaneLayout& layout);

  /// Adds what is inside the image of these spans, moved by up to `margin_px` to all sides: up and
  /// down by as much or not at all, which covers what lies between wherever a silhouette is higher.
  void add(std::span<const RowSpan> spans, int margin_px);
  bool at(int x, int y) const {
    return wide_[static_cast<std::size_t>(y) * wide_stride_ + static_cast<std::size_t>(x)] != 0;
  }
  /// Not 0 where hidden, by index in a plane whose rows are those of the image (`steep`) or its
  /// columns.
  const std::uint8_t* plane(bool steep) const { return steep ? wide_.data() : tall_.data(); }

 private:
  cv::Size size_;
  std::size_t wide_stride_, tall_stride_;
  std::vector<std::uint8_t> wide_, tall_;
};

}  // namespace plaza::edges
