#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "modalities/edges/scan_lines.h"
#include "modalities/edges/sweep.h"

namespace plaza::edges {

/// Where a pixel's nearness lies in a block of planes. Planes of steep directions have image rows
/// as rows, those of flat ones image columns: what is fastest to write (see sweep.h).
class PlaneLayout {
 public:
  /// Throws std::invalid_argument for an empty size or no direction.
  PlaneLayout(cv::Size size, std::vector<Direction> directions);

  cv::Size size() const { return size_; }
  const std::vector<Direction>& directions() const { return directions_; }
  /// Bytes that a block needs, margins included.
  std::size_t bytes() const { return bytes_; }
  /// Index of a pixel's byte in the block; x and y inside the image.
  std::uint32_t offset(std::size_t direction, int x, int y) const {
    const auto d = static_cast<std::uint32_t>(direction);
    return directions_[direction].steep
               ? plane_begin_[d] + static_cast<std::uint32_t>(y) * wide_stride_ +
                     static_cast<std::uint32_t>(x)
               : plane_begin_[d] + static_cast<std::uint32_t>(x) * tall_stride_ +
                     static_cast<std::uint32_t>(y);
  }
  /// The pixel at an offset in the plane of `direction`.
  cv::Point pixel(std::size_t direction, std::uint32_t offset) const;

  std::uint32_t plane_begin(std::size_t direction) const { return plane_begin_[direction]; }
  std::uint32_t wide_stride() const { return wide_stride_; }  ///< of planes with image rows
  std::uint32_t tall_stride() const { return tall_stride_; }  ///< of planes with image columns

 private:
  cv::Size size_;
  std::vector<Direction> directions_;
  std::uint32_t wide_stride_, tall_stride_;
  std::vector<std::uint32_t> plane_begin_;
  std::size_t bytes_ = 0;
};

/// Bytes on cache lines of their own, all 0 at first.
class ByteBlock {
 public:
  explicit ByteBlock(std::size_t bytes);
  std::uint8_t* data() { return bytes_.get(); }
  const std::uint8_t* data() const { return bytes_.get(); }
  std::size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(std::uint8_t* p) const;
  };
  std::size_t size_;
  std::unique_ptr<std::uint8_t[], Free> bytes_;
};

/// A pixel; images have at most 32767 rows and columns.
struct EdgePoint {
  std::int16_t x = 0, y = 0;
  bool operator==(const EdgePoint&) const = default;
};

/// Appends the pixels of an 8-bit image that are not 0, row by row.
void append_points(const cv::Mat1b& edges, std::vector<EdgePoint>& points);

/// The oriented distance transform at memory speed: every direction's plane is filled by two
/// streaming passes (sweep.h). The same distances as transform_by_scanning, pixel by pixel.
///
/// One object per thread: it keeps two images of edges between calls, so that nothing is allocated.
class FastTransform {
 public:
  explicit FastTransform(std::shared_ptr<const PlaneLayout> layout,
                         Sweep sweep = sweep_versions().back().run);

  /// Fills `block` (of layout().bytes(), and never written by anyone else) from edge pixels inside
  /// the image, in any order.
  void run(std::span<const EdgePoint> edges, ByteBlock& block);
  /// The same from an 8-bit image, not 0 at edges.
  void run(const cv::Mat1b& edges, ByteBlock& block);

  /// The same of a part of the image: fills `planes`, of `part.bytes()` and nothing in particular
  /// before, with the transform of the edges inside `window`. `part` has its size and the layout's
  /// directions. Edges outside don't count, so what lies within the gate of its border may be
  /// wrong.
  void run(std::span<const EdgePoint> edges, const cv::Rect& window, const PlaneLayout& part,
           std::uint8_t* planes);

  const PlaneLayout& layout() const { return *layout_; }
  /// How far the lines of a direction move beside, from row `row` - 1 of its plane to row `row`.
  int drift(std::size_t direction, int row) const {
    return drift_[direction * longest_ + static_cast<std::size_t>(row)];
  }

 private:
  void draw(const PlaneLayout& layout, cv::Point origin, std::uint8_t value);
  void sweep_planes(const PlaneLayout& layout, cv::Point origin, std::uint8_t* planes);

  std::shared_ptr<const PlaneLayout> layout_;
  Sweep sweep_;
  std::vector<std::int8_t> drift_;  ///< [direction][row of its plane]
  std::size_t longest_ = 0;
  ByteBlock wide_, tall_;         ///< edges by image rows, by image columns
  std::vector<EdgePoint> drawn_;  ///< what `wide_` and `tall_` hold
  std::vector<EdgePoint> found_;  ///< in an image
};

/// Steps to the nearest edge as the plain transforms give them: kNoEdge beyond the gate.
inline std::uint8_t steps_of(std::uint8_t nearness, const Direction& direction) {
  return nearness == 0 ? std::uint8_t{255}
                       : static_cast<std::uint8_t>(direction.gate + 1 - nearness);
}

}  // namespace plaza::edges
