#pragma once

#include <gtest/gtest.h>

#include "plaza/geometry/camera.h"

namespace plaza::test {

/// Both see the same: world to pixel, and pixel to ray (seen again by the other), within
/// `tolerance_px`, over the whole image and at depths from 1 to 30 m.
inline void expect_same_camera(const Camera& a, const Camera& b, double tolerance_px = 1e-9) {
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  constexpr int kSteps = 16;
  int seen = 0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d pixel(a.width() * (i / double{kSteps}) - 0.5,
                                  a.height() * (j / double{kSteps}) - 0.5);
      const auto ray = a.ray(pixel), other_ray = b.ray(pixel);
      ASSERT_EQ(ray.has_value(), other_ray.has_value()) << a.name() << " " << pixel.transpose();
      if (!ray) continue;
      ++seen;
      for (const double depth_m : {1.0, 30.0}) {
        const Eigen::Vector3d x = ray->origin + depth_m * ray->direction;
        const Eigen::Vector3d other_x = other_ray->origin + depth_m * other_ray->direction;
        const auto wanted = a.project(x), direct = b.project(x), there = a.project(other_x);
        ASSERT_TRUE(wanted && direct && there) << a.name() << " " << pixel.transpose();
        EXPECT_LT((*wanted - *direct).norm(), tolerance_px) << a.name() << " " << pixel.transpose();
        EXPECT_LT((*wanted - *there).norm(), tolerance_px) << a.name() << " " << pixel.transpose();
      }
    }
  }
  EXPECT_GT(seen, kSteps * kSteps / 2) << a.name();
}

}  // namespace plaza::test
