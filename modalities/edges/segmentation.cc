#include "modalities/edges/segmentation.h"

#include <array>
#include <cmath>

#include "modalities/edges/edge_shapes.h"

namespace plaza::edges {
namespace {

/// The eight neighbours, going round.
constexpr std::array<EdgePoint, 8> kAround = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
/// The same, nearest ones first.
constexpr std::array<EdgePoint, 8> kNearestFirst = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

EdgePoint operator+(EdgePoint a, EdgePoint b) {
  return {static_cast<std::int16_t>(a.x + b.x), static_cast<std::int16_t>(a.y + b.y)};
}

/// Whether the foreground around a pixel is one piece of one or two pixels: a contour ends here.
bool is_end_point(const LabelImage& labels, EdgePoint p) {
  int count = 0, begins = 0;
  bool before = (labels.at(p.x + kAround[7].x, p.y + kAround[7].y) & kForeground) != 0;
  for (const EdgePoint step : kAround) {
    const bool here = (labels.at(p.x + step.x, p.y + step.y) & kForeground) != 0;
    count += here ? 1 : 0;
    begins += here && !before ? 1 : 0;
    before = here;
  }
  return begins == 1 && count <= 2;
}

bool is_background(const EdgeImage& image, const ViewBackground& background, double threshold,
                   EdgePoint p) {
  if (background.zone(p.y, p.x) == 0) return false;
  const float fx = image.dx(p.y, p.x), fy = image.dy(p.y, p.x);
  const cv::Vec2f& b = background.gradient(p.y, p.x);
  return b[0] * fx + b[1] * fy > static_cast<float>(threshold) * std::sqrt(fx * fx + fy * fy);
}

/// Takes pieces of fewer than `least` pixels out of the foreground and of `points`.
void drop_specks(int least, LabelImage& labels, std::vector<EdgePoint>& points) {
  std::vector<EdgePoint> piece;
  for (const EdgePoint seed : points) {
    if ((labels.at(seed.x, seed.y) & kVisited) != 0) continue;
    piece.assign(1, seed);
    labels.at(seed.x, seed.y) |= kVisited;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const EdgePoint from = piece[i];
      for (const EdgePoint step : kAround) {
        const EdgePoint p = from + step;
        std::uint8_t& label = labels.at(p.x, p.y);
        if ((label & (kForeground | kVisited)) != kForeground) continue;
        label |= kVisited;
        piece.push_back(p);
      }
    }
    if (piece.size() >= static_cast<std::size_t>(least)) continue;
    for (const EdgePoint p : piece) {
      labels.at(p.x, p.y) &= static_cast<std::uint8_t>(~kForeground);
    }
  }
  std::size_t kept = 0;
  for (const EdgePoint p : points) {
    std::uint8_t& label = labels.at(p.x, p.y);
    label &= static_cast<std::uint8_t>(~kVisited);
    if ((label & kForeground) != 0) points[kept++] = p;
  }
  points.resize(kept);
}

void link(const SegmentationOptions& options, LabelImage& labels, std::vector<EdgePoint>& points) {
  std::vector<EdgePoint> ends;
  for (const EdgePoint p : points) {
    if (is_end_point(labels, p)) ends.push_back(p);
  }
  for (int grown = 0; grown < options.link_px; ++grown) {
    std::vector<EdgePoint> next;
    int moved = 0;
    for (const EdgePoint end : ends) {
      for (const EdgePoint step : kNearestFirst) {
        const EdgePoint p = end + step;
        std::uint8_t& label = labels.at(p.x, p.y);
        if ((label & (kEdge | kForeground)) != kEdge) continue;
        label |= kForeground;
        points.push_back(p);
        ++moved;
        if (is_end_point(labels, p)) next.push_back(p);  // else it has met another contour
        break;
      }
    }
    ends = std::move(next);
    if (moved < options.link_end_points || ends.empty()) return;
  }
}

}  // namespace

void segment(const EdgeImage& image, const ViewBackground* background,
             const SegmentationOptions& options, LabelImage& labels, std::vector<EdgePoint>& points,
             const BodyScale* scale) {
  points.clear();
  append_points(image.edges, points);
  std::size_t kept = 0;
  for (const EdgePoint p : points) {
    std::uint8_t& label = labels.at(p.x, p.y);
    label = kEdge;
    if (background != nullptr &&
        is_background(image, *background, options.orientation_threshold, p)) {
      continue;
    }
    label = kEdge | kSegmented | kForeground;
    points[kept++] = p;
  }
  points.resize(kept);
  if (options.min_contour_px > 1) drop_specks(options.min_contour_px, labels, points);
  if (scale != nullptr && options.longest_line_m > 0) {
    drop_long_lines(image, *scale, options.longest_line_m, labels, points);
  }
  if (scale != nullptr && options.least_piece_m > 0) {
    drop_short_pieces(*scale, options.least_piece_m, labels, points);
  }
  if (options.link_px > 0) link(options, labels, points);
}

}  // namespace plaza::edges
