#include "plugins/detectors/hierarchical-grid/occlusion.h"

#include <algorithm>
#include <cmath>

namespace plaza {
namespace {

/// Where the polygon crosses a row of the image, sorted: it covers [x0, x1], [x2, x3], ...
std::vector<double> crossings(const OccluderPolygon& polygon, double row) {
  std::vector<double> xs;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    if ((a.y() <= row) == (b.y() <= row)) continue;
    xs.push_back(a.x() + (row - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(xs.begin(), xs.end());
  return xs;
}

bool covers(const OccluderPolygon& polygon, const Eigen::Vector2d& pixel) {
  const std::vector<double> xs = crossings(polygon, pixel.y());
  const auto left_of =
      std::count_if(xs.begin(), xs.end(), [&](double x) { return x <= pixel.x(); });
  return left_of % 2 == 1;
}

/// The spans without the pixels whose centres the polygon covers.
std::vector<RowSpan> cut(const std::vector<RowSpan>& spans, const OccluderPolygon& polygon) {
  std::vector<RowSpan> out;
  for (const RowSpan& span : spans) {
    const std::vector<double> xs = crossings(polygon, span.row);
    std::int32_t begin = span.begin;
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
      const auto hidden = std::clamp(static_cast<std::int32_t>(std::ceil(xs[i])), begin, span.end);
      if (begin < hidden) out.push_back({span.row, begin, hidden});
      begin = std::clamp(static_cast<std::int32_t>(std::floor(xs[i + 1])) + 1, begin, span.end);
    }
    if (begin < span.end) out.push_back({span.row, begin, span.end});
  }
  return out;
}

double area_of(const std::vector<RowSpan>& spans) {
  double area = 0;
  for (const RowSpan& span : spans) area += span.end - span.begin;
  return area;
}

}  // namespace

Silhouette without_hidden(const Silhouette& silhouette, std::span<const OccluderPolygon> polygons) {
  Silhouette out = silhouette;
  for (const OccluderPolygon& polygon : polygons) {
    std::erase_if(out.contour,
                  [&](const ContourPoint& p) { return covers(polygon, p.pixel.cast<double>()); });
    out.spans = cut(out.spans, polygon);
  }
  const double whole = area_of(silhouette.spans);
  if (whole > 0) out.inside_share = silhouette.inside_share * area_of(out.spans) / whole;
  return out;
}

}  // namespace plaza
