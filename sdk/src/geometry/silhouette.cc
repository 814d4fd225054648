#include "plaza/geometry/silhouette.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "convex_outline.h"

namespace plaza {
namespace {

/// A straight line bends in a lens by less than a hundredth of a pixel over this length.
constexpr double kPiece_px = 8;
/// How far outside an outline a point must be covered by another solid to be no boundary.
constexpr double kNudge_px = 0.02;

/// Pixel of an ideal point, for a camera whose pose is undone first: Camera speaks of the world.
class Sight {
 public:
  explicit Sight(const Camera& camera)
      : camera_(camera), world_from_camera_(camera.pose().rotation.transpose()) {}

  std::optional<Eigen::Vector2d> pixel(const Eigen::Vector2d& ideal) const {
    return camera_.project(world_from_camera_ *
                           (Eigen::Vector3d(ideal.x(), ideal.y(), 1) - camera_.pose().translation));
  }

  /// Ideal radius about the optical axis within which every point has a pixel: twice what the image
  /// needs, or less where the lens folds back.
  double reach() const {
    const double right = camera_.width() - 0.5, bottom = camera_.height() - 0.5;
    double needed = 0;
    for (const double x : {-0.5, 0.5 * right, right}) {
      for (const double y : {-0.5, 0.5 * bottom, bottom}) {
        const auto ray = camera_.ray({x, y});
        if (!ray) continue;  // beyond the fold: no point of the world appears there
        const Eigen::Vector3d d = camera_.pose().rotation * ray->direction;
        needed = std::max(needed, (d.head<2>() / d.z()).norm());
      }
    }
    double reach = 2 * needed;
    constexpr int kDirections = 32;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      if (pixel(reach * direction)) continue;
      double low = 0, high = reach;
      while (high - low > 1e-6 * reach) {
        const double middle = 0.5 * (low + high);
        (pixel(middle * direction) ? low : high) = middle;
      }
      reach = low;
    }
    return reach;
  }

 private:
  const Camera& camera_;
  Eigen::Matrix3d world_from_camera_;
};

struct PathPoint {
  Eigen::Vector2d pixel;
  Eigen::Vector2d ideal;
  bool open = false;  ///< as in OutlineCorner
};
using Path = std::vector<PathPoint>;  ///< closed

/// The outline as it appears in the image, in short pieces; empty when a corner has no pixel.
Path through_lens(const ConvexOutline& outline, const Sight& sight) {
  Path path;
  path.reserve(2 * outline.size());
  std::vector<Eigen::Vector2d> corners;
  for (const OutlineCorner& corner : outline) {
    const auto pixel = sight.pixel(corner.ideal);
    if (!pixel) return {};
    corners.push_back(*pixel);
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t j = (i + 1) % outline.size();
    const int pieces =
        std::max(1, static_cast<int>(std::ceil((corners[j] - corners[i]).norm() / kPiece_px)));
    path.push_back({corners[i], outline[i].ideal, outline[i].open});
    for (int k = 1; k < pieces; ++k) {
      const Eigen::Vector2d ideal =
          outline[i].ideal + k * (outline[j].ideal - outline[i].ideal) / pieces;
      const auto pixel = sight.pixel(ideal);
      if (!pixel) return {};
      path.push_back({*pixel, ideal, outline[i].open});
    }
  }
  return path;
}

double area_of(const Path& path) {
  double twice = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    twice += cross(path[i].pixel, path[(i + 1) % path.size()].pixel);
  }
  return 0.5 * twice;
}

/// Points every `step_px` along the path, but where sight ends or another solid covers them.
void add_contour(const Path& path, std::span<const ConvexOutline> outlines, std::size_t own,
                 double step_px, std::vector<ContourPoint>& contour) {
  double length = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    length += (path[(i + 1) % path.size()].pixel - path[i].pixel).norm();
  }
  const double count = std::max(1.0, std::round(length / step_px));
  const double step = length / count;
  const double outward = area_of(path) > 0 ? 1 : -1;
  double until_next = 0.5 * step;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const PathPoint& a = path[i];
    const PathPoint& b = path[(i + 1) % path.size()];
    const Eigen::Vector2d along = b.pixel - a.pixel;
    const double piece = along.norm();
    if (!(piece > 0)) continue;
    for (; until_next < piece; until_next += step) {
      if (a.open) continue;
      const double t = until_next / piece;
      const Eigen::Vector2d ideal_along = b.ideal - a.ideal;
      // ideal outlines have positive area: outward is to the right
      const Eigen::Vector2d nudge =
          kNudge_px / piece * Eigen::Vector2d(ideal_along.y(), -ideal_along.x());
      const Eigen::Vector2d outside = a.ideal + t * ideal_along + nudge;
      bool covered = false;
      for (std::size_t o = 0; o < outlines.size() && !covered; ++o) {
        covered = o != own && contains(outlines[o], outside);
      }
      if (covered) continue;
      const Eigen::Vector2d normal = outward / piece * Eigen::Vector2d(along.y(), -along.x());
      contour.push_back({(a.pixel + t * along).cast<float>(), normal.cast<float>()});
    }
    until_next -= piece;
  }
}

/// Pixels whose centres the path encloses.
void add_spans(const Path& path, std::vector<RowSpan>& spans) {
  std::vector<std::pair<std::int32_t, double>> crossings;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Vector2d* a = &path[i].pixel;
    const Eigen::Vector2d* b = &path[(i + 1) % path.size()].pixel;
    if (a->y() > b->y()) std::swap(a, b);
    const auto first = static_cast<std::int32_t>(std::ceil(a->y()));
    const auto end = static_cast<std::int32_t>(std::ceil(b->y()));
    for (std::int32_t row = first; row < end; ++row) {
      const double t = (row - a->y()) / (b->y() - a->y());
      crossings.emplace_back(row, a->x() + t * (b->x() - a->x()));
    }
  }
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const auto begin = static_cast<std::int32_t>(std::ceil(crossings[i].second));
    const auto end = static_cast<std::int32_t>(std::floor(crossings[i + 1].second)) + 1;
    if (begin < end) spans.push_back({crossings[i].first, begin, end});
  }
}

/// Spans without overlap, by rising row.
std::vector<RowSpan> merged(std::vector<RowSpan> spans) {
  std::sort(spans.begin(), spans.end(), [](const RowSpan& a, const RowSpan& b) {
    return a.row < b.row || (a.row == b.row && a.begin < b.begin);
  });
  std::vector<RowSpan> out;
  for (const RowSpan& span : spans) {
    if (!out.empty() && out.back().row == span.row && out.back().end >= span.begin) {
      out.back().end = std::max(out.back().end, span.end);
    } else {
      out.push_back(span);
    }
  }
  return out;
}

double area_of(const std::vector<RowSpan>& spans) {
  double area = 0;
  for (const RowSpan& span : spans) area += span.end - span.begin;
  return area;
}

std::vector<RowSpan> cut_to_image(const std::vector<RowSpan>& spans, const Camera& camera) {
  std::vector<RowSpan> out;
  out.reserve(spans.size());
  for (RowSpan span : spans) {
    if (span.row < 0 || span.row >= camera.height()) continue;
    span.begin = std::max(span.begin, 0);
    span.end = std::min(span.end, camera.width());
    if (span.begin < span.end) out.push_back(span);
  }
  return out;
}

Box box_of(const std::vector<Path>& paths) {
  Eigen::Vector2d least = paths[0][0].pixel, most = least;
  for (const Path& path : paths) {
    for (const PathPoint& p : path) {
      least = least.cwiseMin(p.pixel);
      most = most.cwiseMax(p.pixel);
    }
  }
  return {least.x(), least.y(), most.x() - least.x(), most.y() - least.y()};
}

}  // namespace

Prism cylinder_prism(const Eigen::Vector2d& centre_m, double radius_m, double bottom_m,
                     double top_m, const Camera& camera) {
  // a polygon of n sides leaves its circle by r (1 - cos(pi / n)), about r pi^2 / (2 n^2)
  const CameraFromWorld& pose = camera.pose();
  const Eigen::Vector3d middle(centre_m.x(), centre_m.y(), 0.5 * (bottom_m + top_m));
  const double depth = (pose.rotation * middle + pose.translation).z();
  const double size = radius_m + 0.5 * (top_m - bottom_m);
  double sides = 512;
  if (depth > 2 * size) {
    const Eigen::Vector3d across = pose.rotation.row(0).transpose();
    const auto a = camera.project(middle), b = camera.project(middle + 0.01 * across);
    if (a && b) {
      const double radius_px = 100 * (*b - *a).norm() * radius_m * depth / (depth - size);
      sides = std::clamp(std::ceil(std::numbers::pi * std::sqrt(radius_px / 0.04)), 64.0, 512.0);
    }
  }
  Prism prism{{}, bottom_m, top_m};
  const auto n = static_cast<int>(sides);
  prism.base_m.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    prism.base_m.emplace_back(centre_m +
                              radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return prism;
}

Silhouette silhouette_of(std::span<const Prism> solids, const Camera& camera, double step_px) {
  if (!(step_px > 0)) throw std::invalid_argument("the step along a contour must be positive");
  const Sight sight(camera);
  std::vector<ConvexOutline> outlines;
  for (const Prism& solid : solids) {
    if (contains(solid, camera.centre())) return {};
    ConvexOutline outline = outline_of(solid, camera.pose());
    if (!outline.empty()) outlines.push_back(std::move(outline));
  }
  std::optional<double> reach;
  const double certain = 0.1;  // every camera has pixels so near to its axis; most solids are there
  std::vector<Path> paths;
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    double radius = 0;
    for (const OutlineCorner& c : outlines[i]) radius = std::max(radius, c.ideal.norm());
    Path path;
    if (radius > certain && !reach) reach = sight.reach();
    if (radius > certain && radius > *reach) {
      path = through_lens(cut_to_disc(outlines[i], *reach), sight);
    } else {
      path = through_lens(outlines[i], sight);
    }
    if (path.empty()) continue;
    paths.push_back(std::move(path));
    owners.push_back(i);
  }
  Silhouette s;
  if (paths.empty()) return s;
  s.box = box_of(paths);
  const bool beside = s.box.right() < -0.5 || s.box.bottom() < -0.5 ||
                      s.box.left > camera.width() - 0.5 || s.box.top > camera.height() - 0.5;
  if (beside) return s;
  std::vector<RowSpan> all;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    add_contour(paths[i], outlines, owners[i], step_px, s.contour);
    add_spans(paths[i], all);
  }
  all = merged(std::move(all));
  s.spans = cut_to_image(all, camera);
  const bool touches = std::any_of(s.contour.begin(), s.contour.end(), [&](const ContourPoint& p) {
    return camera.contains(p.pixel.cast<double>());
  });
  if (s.spans.empty() && !touches) {
    s.contour.clear();
    return s;
  }
  const double area = area_of(all);
  const Eigen::Vector2d middle(s.box.left + 0.5 * s.box.width, s.box.top + 0.5 * s.box.height);
  // smaller than a pixel: there or not there
  s.inside_share = area > 0 ? area_of(s.spans) / area : (camera.contains(middle) ? 1.0 : 0.0);
  return s;
}

}  // namespace plaza
