#include "convex_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace plaza {
namespace {

/// Solids are cut here; what is nearer to the camera's plane than a tenth of a millimetre is seen
/// only by a camera that touches it.
constexpr double kNear_m = 1e-4;
constexpr int kDiscSides = 64;

/// Convex hull by Andrew's monotone chain; collinear points are left out.
ConvexOutline hull_of(std::vector<Eigen::Vector2d>& points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  if (points.size() < 3) return {};
  std::vector<Eigen::Vector2d> hull;
  hull.reserve(points.size() + 1);
  const auto add = [&hull](const Eigen::Vector2d& p, std::size_t least) {
    while (hull.size() >= least + 2 &&
           !(cross(hull.back() - hull[hull.size() - 2], p - hull.back()) > 0)) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Eigen::Vector2d& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  hull.pop_back();  // the first point again
  if (hull.size() < 3) return {};
  ConvexOutline outline;
  outline.reserve(hull.size());
  for (const Eigen::Vector2d& p : hull) outline.push_back({p, false});
  return outline;
}

}  // namespace

ConvexOutline outline_of(const Prism& prism, const CameraFromWorld& pose) {
  const std::size_t n = prism.base_m.size();
  std::vector<Eigen::Vector3d> corners(2 * n);  // in the camera's frame: bottom, then top
  bool all_in_front = true, any_in_front = false;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    const Eigen::Vector2d& base = prism.base_m[i < n ? i : i - n];
    corners[i] =
        pose.rotation * Eigen::Vector3d(base.x(), base.y(), i < n ? prism.bottom_m : prism.top_m) +
        pose.translation;
    const bool in_front = corners[i].z() > kNear_m;
    all_in_front = all_in_front && in_front;
    any_in_front = any_in_front || in_front;
  }
  if (!any_in_front) return {};
  std::vector<Eigen::Vector2d> points;
  points.reserve(4 * n);
  for (const Eigen::Vector3d& c : corners) {
    if (c.z() > kNear_m) points.emplace_back(c.head<2>() / c.z());
  }
  if (!all_in_front) {
    // a cut convex body is the hull of its corners in front and of where its edges meet the plane
    const auto meet = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      if ((a.z() > kNear_m) == (b.z() > kNear_m)) return;
      const double t = (kNear_m - a.z()) / (b.z() - a.z());
      points.emplace_back((a + t * (b - a)).head<2>() / kNear_m);
    };
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = i + 1 < n ? i + 1 : 0;
      meet(corners[i], corners[j]);
      meet(corners[n + i], corners[n + j]);
      meet(corners[i], corners[n + i]);
    }
  }
  return hull_of(points);
}

bool contains(const Prism& prism, const Eigen::Vector3d& x_world) {
  if (x_world.z() < prism.bottom_m || x_world.z() > prism.top_m) return false;
  // left of all edges or right of all of them, whichever way round the corners go
  bool left = true, right = true;
  for (std::size_t i = 0; i < prism.base_m.size(); ++i) {
    const Eigen::Vector2d& a = prism.base_m[i];
    const Eigen::Vector2d& b = prism.base_m[(i + 1) % prism.base_m.size()];
    const double side = cross(b - a, x_world.head<2>() - a);
    left = left && side >= 0;
    right = right && side <= 0;
  }
  return left || right;
}

bool contains(const ConvexOutline& outline, const Eigen::Vector2d& ideal) {
  if (outline.size() < 3) return false;
  const Eigen::Vector2d& origin = outline[0].ideal;
  const Eigen::Vector2d p = ideal - origin;
  // the fan of triangles about corner 0: find the wedge that holds the point
  std::size_t low = 1, high = outline.size() - 1;
  if (cross(outline[low].ideal - origin, p) < 0 || cross(outline[high].ideal - origin, p) > 0) {
    return false;
  }
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (cross(outline[middle].ideal - origin, p) >= 0 ? low : high) = middle;
  }
  return cross(outline[high].ideal - outline[low].ideal, ideal - outline[low].ideal) >= 0;
}

ConvexOutline cut_to_disc(const ConvexOutline& outline, double radius) {
  ConvexOutline current = outline, next;
  for (int side = 0; side < kDiscSides && !current.empty(); ++side) {
    const double angle = 2 * std::numbers::pi * side / kDiscSides;
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    const double limit = radius * std::cos(std::numbers::pi / kDiscSides);
    const auto beyond = [&](const OutlineCorner& c) { return c.ideal.dot(normal) - limit; };
    next.clear();
    for (std::size_t i = 0; i < current.size(); ++i) {  // Sutherland and Hodgman
      const OutlineCorner& a = current[i];
      const OutlineCorner& b = current[(i + 1) % current.size()];
      const double da = beyond(a), db = beyond(b);
      if (da <= 0) next.push_back(a);
      if ((da <= 0) == (db <= 0)) continue;
      // leaving, the edge that starts here runs along the limit; entering, it goes on as it was
      next.push_back({a.ideal + da / (da - db) * (b.ideal - a.ideal), da <= 0 || a.open});
    }
    current.swap(next);
  }
  return current.size() < 3 ? ConvexOutline() : current;
}

}  // namespace plaza
