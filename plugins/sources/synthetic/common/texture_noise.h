#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "plugins/sources/synthetic/common/pixel_random.h"

namespace plaza::synthetic {

/// Smooth noise in [-1, 1] with features of size 1, zero mean; a pure function of place and seed.
inline float value_noise(const Eigen::Vector3f& p, std::uint32_t seed) {
  const Eigen::Vector3f base(std::floor(p.x()), std::floor(p.y()), std::floor(p.z()));
  Eigen::Vector3f t = p - base;
  t = t.cwiseProduct(t).cwiseProduct(Eigen::Vector3f::Constant(3) - 2 * t);
  const auto ix = static_cast<std::uint32_t>(static_cast<std::int32_t>(base.x()));
  const auto iy = static_cast<std::uint32_t>(static_cast<std::int32_t>(base.y()));
  const auto iz = static_cast<std::uint32_t>(static_cast<std::int32_t>(base.z()));
  const auto corner = [&](std::uint32_t dx, std::uint32_t dy, std::uint32_t dz) {
    return 2 * to_unit(hash32((ix + dx) * 0x8da6b343u ^ (iy + dy) * 0xd8163841u ^
                              (iz + dz) * 0xcb1ab31fu ^ seed)) -
           1;
  };
  const auto line = [&](std::uint32_t dy, std::uint32_t dz) {
    const float a = corner(0, dy, dz), b = corner(1, dy, dz);
    return a + t.x() * (b - a);
  };
  const auto plane = [&](std::uint32_t dz) {
    const float a = line(0, dz), b = line(1, dz);
    return a + t.y() * (b - a);
  };
  const float a = plane(0), b = plane(1);
  return a + t.z() * (b - a);
}

/// Several octaves of it, about in [-1, 1].
inline float fractal_noise(const Eigen::Vector3f& p, std::uint32_t seed, int octaves) {
  float sum = 0, scale = 1, weight = 0.6f;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * value_noise(scale * p, seed + static_cast<std::uint32_t>(i) * 0x9e3779b9u);
    scale *= 2.03f;
    weight *= 0.5f;
  }
  return sum;
}

}  // namespace plaza::synthetic
