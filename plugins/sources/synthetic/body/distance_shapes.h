#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace plaza::synthetic {

using Vec3 = Eigen::Vector3f;

inline float smoothstep(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// The same place on a body's left half, y >= 0.
inline Vec3 mirrored(const Vec3& p) { return {p.x(), std::abs(p.y()), p.z()}; }

/// Union of two signed distances whose seam is filled over about `k` metres (I. Quilez's
/// polynomial smooth minimum).
inline float smooth_union(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.0f) / k;
  return std::min(a, b) - h * h * k * 0.25f;
}

/// Signed distance to a capsule with another radius at each end, metres.
inline float tapered_capsule(const Vec3& p, const Vec3& a, const Vec3& b, float ra, float rb) {
  const Vec3 ab = b - a;
  const float t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0f, 1.0f);
  return (p - a - t * ab).norm() - (ra + t * (rb - ra));
}

/// Close to the signed distance of an ellipsoid about the origin, exact on its surface.
inline float ellipsoid(const Vec3& p, const Vec3& radii) {
  const float k0 = p.cwiseQuotient(radii).norm();
  const float k1 = p.cwiseQuotient(radii.cwiseProduct(radii)).norm();
  return k1 > 1e-6f ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
}

/// Box about the origin with rounded edges.
inline float rounded_box(const Vec3& p, const Vec3& half, float radius) {
  const Vec3 q = p.cwiseAbs() - half + Vec3::Constant(radius);
  return q.cwiseMax(0.0f).norm() + std::min(q.maxCoeff(), 0.0f) - radius;
}

/// One cross-section of a loft along z: an ellipse about (centre_x, 0).
struct Section {
  float z;
  float half_x;
  float half_y;
  float centre_x;
};

/// Signed distance (close to) of a body made of elliptic cross-sections, sorted by rising z,
/// closed at both ends by planes.
inline float loft(const Vec3& p, std::span<const Section> sections) {
  std::size_t i = 1;
  while (i + 1 < sections.size() && p.z() > sections[i].z) ++i;
  const Section& low = sections[i - 1];
  const Section& high = sections[i];
  const float t = smoothstep(low.z, high.z, p.z());
  const float hx = low.half_x + t * (high.half_x - low.half_x);
  const float hy = low.half_y + t * (high.half_y - low.half_y);
  const float x = p.x() - (low.centre_x + t * (high.centre_x - low.centre_x));
  const float k0 = std::hypot(x / hx, p.y() / hy);
  const float k1 = std::hypot(x / (hx * hx), p.y() / (hy * hy));
  const float side = k1 > 1e-6f ? k0 * (k0 - 1) / k1 : -std::min(hx, hy);
  const float ends = std::max(sections.front().z - p.z(), p.z() - sections.back().z);
  if (ends <= 0) return std::max(side, ends);
  return side > 0 ? std::hypot(side, ends) : ends;
}

}  // namespace plaza::synthetic
