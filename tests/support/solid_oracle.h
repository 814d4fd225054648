#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "plaza/component/models.h"

namespace plaza::test {

/// Whether a ray meets a solid in front of its origin.
using RayTest = std::function<bool(const Ray&)>;

/// Exact intersection of a ray with an upright cylinder, the discs at its ends included.
inline bool meets_cylinder(const Ray& ray, const Eigen::Vector2d& centre, double radius,
                           double bottom, double top) {
  // between the planes: an interval of the ray; inside the infinite cylinder: another one
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  const double dz = ray.direction.z();
  if (dz == 0) {
    if (ray.origin.z() < bottom || ray.origin.z() > top) return false;
  } else {
    const double a = (bottom - ray.origin.z()) / dz, b = (top - ray.origin.z()) / dz;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  const Eigen::Vector2d d = ray.direction.head<2>(), o = ray.origin.head<2>() - centre;
  const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - radius * radius;
  if (a == 0) {
    if (c > 0) return false;
  } else {
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return false;
    const double root = std::sqrt(discriminant);
    enter = std::max(enter, (-b - root) / a);
    leave = std::min(leave, (-b + root) / a);
  }
  return enter < leave;
}

/// Exact intersection of a ray with an upright box, by slabs in the box's own frame.
inline bool meets_box(const Ray& ray, const Pose& pose, const Eigen::Vector3d& size) {
  const Eigen::Rotation2Dd body_from_world(-pose.heading_rad);
  Eigen::Vector3d origin = ray.origin, direction = ray.direction;
  origin.head<2>() = body_from_world * (ray.origin.head<2>() - pose.position_m);
  direction.head<2>() = body_from_world * ray.direction.head<2>();
  const Eigen::Vector3d low(-size.x() / 2, -size.y() / 2, 0);
  const Eigen::Vector3d high(size.x() / 2, size.y() / 2, size.z());
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) {
      if (origin[i] < low[i] || origin[i] > high[i]) return false;
      continue;
    }
    const double a = (low[i] - origin[i]) / direction[i], b = (high[i] - origin[i]) / direction[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

/// Which pixels see the solid, one ray per pixel centre; where the lens gives none, nothing is
/// seen.
struct Rendering {
  enum Seen : char { kMiss, kHit, kNoRay };
  int width = 0, height = 0;
  std::vector<Seen> seen;
  bool hit(int x, int y) const { return at(x, y) == kHit; }
  bool miss(int x, int y) const { return at(x, y) == kMiss; }
  Seen at(int x, int y) const { return seen[static_cast<std::size_t>(y * width + x)]; }
  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
};

inline Rendering render(const Camera& camera, const RayTest& meets) {
  Rendering r{camera.width(), camera.height(), {}};
  for (int y = 0; y < r.height; ++y) {
    for (int x = 0; x < r.width; ++x) {
      const auto ray = camera.ray({x, y});
      r.seen.push_back(!ray ? Rendering::kNoRay : meets(*ray) ? Rendering::kHit : Rendering::kMiss);
    }
  }
  return r;
}

/// How a silhouette differs from a rendering of the solid; pixels.
struct Disagreement {
  int pixels = 0;         ///< that one of the two calls inside and the other one outside
  double farthest = 0;    ///< of these pixels from the nearest contour point, along its normal
  double off_edge = 0;    ///< of a contour point from the solid's edge as rays see it
  int wrong_normals = 0;  ///< contour points whose normal doesn't point out of the solid
  int points = 0;         ///< contour points that were looked at
};

/// Distance of a contour point from the edge along its normal, by bisection with rays; up to 1 px.
inline double distance_to_edge(const Camera& camera, const RayTest& meets, const ContourPoint& p,
                               bool& outward) {
  const Eigen::Vector2d at = p.pixel.cast<double>(), n = p.normal.cast<double>();
  const auto hit = [&](double s) {
    const auto ray = camera.ray(at + s * n);
    return ray && meets(*ray);
  };
  for (const double reach : {0.1, 0.25, 0.5, 1.0}) {
    outward = hit(-reach) && !hit(reach);
    if (!outward) continue;
    double inside = -reach, outside = reach;
    while (outside - inside > 1e-3) {
      const double middle = 0.5 * (inside + outside);
      (hit(middle) ? inside : outside) = middle;
    }
    return std::abs(0.5 * (inside + outside));
  }
  return 1;
}

inline Disagreement compare(const Silhouette& s, const Camera& camera, const RayTest& meets) {
  Disagreement d;
  const Rendering truth = render(camera, meets);
  std::vector<char> filled(truth.seen.size(), 0);
  for (const RowSpan& span : s.spans) {
    for (int x = span.begin; x < span.end; ++x)
      filled[static_cast<std::size_t>(span.row * truth.width + x)] = 1;
  }
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      if ((filled[static_cast<std::size_t>(y * truth.width + x)] != 0) == truth.hit(x, y)) continue;
      ++d.pixels;
      double nearest = std::numeric_limits<double>::infinity();
      for (const ContourPoint& p : s.contour) {
        nearest = std::min(nearest, (p.pixel.cast<double>() - Eigen::Vector2d(x, y)).norm());
      }
      // points are 1 px apart: the outline between them is up to half a pixel nearer
      d.farthest = std::max(d.farthest, std::sqrt(std::max(0.0, nearest * nearest - 0.25)));
    }
  }
  for (const ContourPoint& p : s.contour) {
    // the border of the image is no place to look at both sides
    const Eigen::Vector2d at = p.pixel.cast<double>();
    if (!(at.x() > 2 && at.y() > 2 && at.x() < truth.width - 3 && at.y() < truth.height - 3))
      continue;
    bool outward = false;
    d.off_edge = std::max(d.off_edge, distance_to_edge(camera, meets, p, outward));
    if (!outward) ++d.wrong_normals;
    ++d.points;
  }
  return d;
}

/// Pixels just inside the solid's rendered edge that no contour point is near to.
inline int edge_without_contour(const Silhouette& s, const Rendering& truth) {
  int missing = 0;
  std::vector<char> near(truth.seen.size(), 0);
  for (const ContourPoint& p : s.contour) {
    const int cx = static_cast<int>(std::lround(p.pixel.x()));
    const int cy = static_cast<int>(std::lround(p.pixel.y()));
    for (int y = cy - 2; y <= cy + 2; ++y) {
      for (int x = cx - 2; x <= cx + 2; ++x) {
        if (truth.inside(x, y)) near[static_cast<std::size_t>(y * truth.width + x)] = 1;
      }
    }
  }
  for (int y = 1; y + 1 < truth.height; ++y) {
    for (int x = 1; x + 1 < truth.width; ++x) {
      const bool edge = truth.hit(x, y) && (truth.miss(x - 1, y) || truth.miss(x + 1, y) ||
                                            truth.miss(x, y - 1) || truth.miss(x, y + 1));
      if (edge && near[static_cast<std::size_t>(y * truth.width + x)] == 0) ++missing;
    }
  }
  return missing;
}

}  // namespace plaza::test
