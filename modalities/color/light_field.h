#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

namespace plaza::color {

/// How the light of an image differs from that of a background: logarithms of factors on the values
/// of blue, green and red. A camera with any gamma curve turns a factor on the light into a factor
/// on its values, so nothing needs to be known of the curve.
struct LightField {
  std::array<float, 3> all = {};  ///< of the whole view
  cv::Mat3f here;                 ///< further, by cells of kCellPx square; empty: nowhere
};

/// Side of a cell, px: shadows have softer edges, people are larger.
inline constexpr int kCellPx = 16;

struct LightOptions {
  double rate_per_s =
      0.5;  ///< by which `here` changes at most; 0: the light is the same everywhere
};

// Light is measured in cells: a cell's factor is the ratio of sums over its pixels that can be
// compared, neither dark nor clipped in either image and at least a few pixels away from
// foreground. All images are 8-bit BGR, masks 8-bit, of one size.

/// The light of the whole view: the median over cells of `image` against `background`, which feels
/// nothing of people who hide less than half of them and follows any change at once.
/// `foreground` may be empty. With too few cells that can be compared it is `before`.
std::array<float, 3> light_of_all(const cv::Mat& image, const cv::Mat& background,
                                  const cv::Mat& foreground, const std::array<float, 3>& before);

/// What the light of cells becomes further (LightField::here) once it is known what is foreground
/// in this image, `seconds` after the one before: towards what is seen, at a limited rate. The edge
/// of a slow shadow takes a second to pass a cell; who walks in is foreground before, and not
/// compared. Cells that can't be compared take on, at the same rate, what is around them.
cv::Mat3f light_of_cells(const cv::Mat& image, const cv::Mat& background, const cv::Mat& foreground,
                         const LightField& light, double seconds, const LightOptions& options);

/// The image as it would be in the background's light. Factors are interpolated between cells.
/// Where a channel is clipped and would be darker than the background, which is all that a
/// clipped value can say, it becomes the background's.
cv::Mat relight(const cv::Mat& image, const cv::Mat& background, const LightField& light);

}  // namespace plaza::color
