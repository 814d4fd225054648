#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "modalities/common/body_scale.h"
#include "modalities/edges/background.h"
#include "modalities/edges/edge_image.h"
#include "modalities/edges/fast_transform.h"

namespace plaza::edges {

/// What became of an edge pixel, bits of a label.
enum EdgeLabel : std::uint8_t {
  kEdge = 1,        ///< an edge of the image (Theta_fu)
  kSegmented = 2,   ///< left by the subtraction of the background (Theta_f)
  kForeground = 4,  ///< foreground in the end: segmented and no speck, or brought back by linking
  kExplained = 8,   ///< taken away by an accepted template
  kVisited = 16,    ///< while pieces are counted
};

struct SegmentationOptions {
  double orientation_threshold = 0.9;  ///< Th_s of (4.1)
  int min_contour_px = 1;              ///< smaller pieces (8-neighbours) are dropped before linking
  double least_piece_m = 0;            ///< with a BodyScale: see drop_short_pieces(); 0: none
  double longest_line_m = 0;           ///< with a BodyScale: see drop_long_lines(); 0: none
  int link_px = 5;          ///< most pixels that a contour grows at an end; 0: no linking
  int link_end_points = 1;  ///< linking ends when fewer end points than this have moved
};

/// Labels with a border of one pixel around the image, so that neighbours need no test.
class LabelImage {
 public:
  explicit LabelImage(cv::Size size) : labels_(size.height + 2, size.width + 2, std::uint8_t{0}) {}
  void clear() { labels_.setTo(0); }
  void copy(const LabelImage& other) { other.labels_.copyTo(labels_); }
  std::uint8_t& at(int x, int y) { return labels_(y + 1, x + 1); }
  std::uint8_t at(int x, int y) const { return labels_(y + 1, x + 1); }
  cv::Size size() const { return {labels_.cols - 2, labels_.rows - 2}; }

 private:
  cv::Mat1b labels_;
};

/// Labels every edge pixel and lists those of the foreground.
///
/// Removed is what lies near an edge of the background and runs its way (4.1), and of the rest what
/// is too small to be a contour, or by its shape of no person; linking then lets
/// contours grow from their end points along removed edges (thesis 4.3.2, Figure 4.5): an end point
/// takes one neighbour that is an edge of the image, which becomes the new end point unless it has
/// met another contour. `labels` must be of the edges' size and clear; `points` is overwritten.
void segment(const EdgeImage& image, const ViewBackground* background,
             const SegmentationOptions& options, LabelImage& labels, std::vector<EdgePoint>& points,
             const BodyScale* scale = nullptr);

}  // namespace plaza::edges
