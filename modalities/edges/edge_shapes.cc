#include "modalities/edges/edge_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plaza::edges {
namespace {

constexpr float kAgree = 0.924F;     ///< cosine of 22.5 degrees
constexpr double kSlimPx = 4;        ///< an edge's zigzag and two neighbouring edges
constexpr double kSlimShare = 0.04;  ///< of a line's length: how far a lens may bend it

/// Foreground edges that hang together, each visited once: from each one in turn on, neighbours
/// that `joins(from, to)` lets in. `drop(region)` says which are no foreground.
template <class Joins, class Drop>
void drop_regions(LabelImage& labels, std::vector<EdgePoint>& points, const Joins& joins,
                  const Drop& drop) {
  std::vector<EdgePoint> region;
  std::vector<EdgePoint> dropped;
  for (const EdgePoint seed : points) {
    if ((labels.at(seed.x, seed.y) & kVisited) != 0) continue;
    region.assign(1, seed);
    labels.at(seed.x, seed.y) |= kVisited;
    for (std::size_t i = 0; i < region.size(); ++i) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const EdgePoint p = {static_cast<std::int16_t>(region[i].x + dx),
                               static_cast<std::int16_t>(region[i].y + dy)};
          std::uint8_t& label = labels.at(p.x, p.y);
          if ((label & (kForeground | kVisited)) != kForeground) continue;
          if (!joins(region, p)) continue;
          label |= kVisited;
          region.push_back(p);
        }
      }
    }
    if (drop(region)) dropped.insert(dropped.end(), region.begin(), region.end());
  }
  for (const EdgePoint p : points) {
    labels.at(p.x, p.y) &= static_cast<std::uint8_t>(~kVisited);
  }
  for (const EdgePoint p : dropped) {
    labels.at(p.x, p.y) &= static_cast<std::uint8_t>(~kForeground);
  }
  std::erase_if(points,
                [&](const EdgePoint p) { return (labels.at(p.x, p.y) & kForeground) == 0; });
}

/// Pixels per metre at the lowest pixel of a region; 0 where nobody can be seen.
double scale_at(const BodyScale& scale, const std::vector<EdgePoint>& region) {
  const EdgePoint lowest = *std::max_element(
      region.begin(), region.end(), [](const EdgePoint a, const EdgePoint b) { return a.y < b.y; });
  return static_cast<double>(scale.px_per_m(lowest.x, lowest.y));
}

/// Extent of a region along a direction of unit length.
double extent_along(const std::vector<EdgePoint>& region, double x, double y) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const EdgePoint p : region) {
    const double at = x * p.x + y * p.y;
    least = std::min(least, at);
    most = std::max(most, at);
  }
  return most - least + 1;
}

}  // namespace

void drop_short_pieces(const BodyScale& scale, double least_m, LabelImage& labels,
                       std::vector<EdgePoint>& points) {
  drop_regions(
      labels, points, [](const std::vector<EdgePoint>&, EdgePoint) { return true; },
      [&](const std::vector<EdgePoint>& piece) {
        const double extent = std::max(extent_along(piece, 1, 0), extent_along(piece, 0, 1));
        return extent < least_m * scale_at(scale, piece);
      });
}

void drop_long_lines(const EdgeImage& image, const BodyScale& scale, double longest_m,
                     LabelImage& labels, std::vector<EdgePoint>& points) {
  cv::Vec2f sum;  // of the region's gradients, each of unit length
  const auto gradient = [&](EdgePoint p) {
    const cv::Vec2f g(image.dx(p.y, p.x), image.dy(p.y, p.x));
    const float length = std::hypot(g[0], g[1]);
    return length > 0 ? g / length : g;
  };
  drop_regions(
      labels, points,
      [&](const std::vector<EdgePoint>& region, EdgePoint p) {
        if (region.size() == 1) sum = gradient(region.front());
        const cv::Vec2f g = gradient(p);
        if (g.dot(sum) < kAgree * std::hypot(sum[0], sum[1])) return false;
        sum += g;
        return true;
      },
      [&](const std::vector<EdgePoint>& region) {
        const double px_per_m = scale_at(scale, region);
        if (px_per_m == 0 || static_cast<double>(region.size()) < longest_m * px_per_m / 2) {
          return false;
        }
        const double norm = std::hypot(sum[0], sum[1]);
        const double x = sum[0] / norm, y = sum[1] / norm;
        const double length = extent_along(region, -y, x);
        return length > longest_m * px_per_m &&
               extent_along(region, x, y) <= std::max(kSlimPx, kSlimShare * length);
      });
}

}  // namespace plaza::edges
