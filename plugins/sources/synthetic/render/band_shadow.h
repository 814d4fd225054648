#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "plugins/sources/synthetic/render/rays.h"

namespace plaza::synthetic {

/// The shadow of something long and straight that moves far away in front of the light, out of
/// every camera's sight: a tree before a window, a mast before the sun. A band over the ground that
/// goes up whatever stands in it, aslant to the light.
///
/// It takes its share of the direct light of *all* lamps, as if they were one and far away. That is
/// exact for the sun; for lamps below a ceiling it stands for daylight that no room here has.
struct BandShadow {
  float share = 0;               ///< of the direct light that it takes; 0: none
  Vec3 towards = Vec3::UnitZ();  ///< to the light; z > 0, any length
  Eigen::Vector2f across{1, 0};  ///< unit vector on the ground, across the band
  Eigen::Vector2f origin{0, 0};  ///< from where `middle_m` counts
  float middle_m = 0;            ///< of the band on the ground, along `across`
  float half_width_m = 0.5f;     ///< to where half of the share is taken
  float edge_m = 0.15f;          ///< over which the shadow fades, > 0

  /// Share of the direct light that is left at `p`.
  float left(const Vec3& p) const {
    if (share <= 0) return 1;
    const Eigen::Vector2f ground = p.head<2>() - (p.z() / towards.z()) * towards.head<2>();
    const float off = std::abs((ground - origin).dot(across) - middle_m);
    const float t = std::clamp((half_width_m - off) / edge_m + 0.5f, 0.0f, 1.0f);
    return 1 - share * t * t * (3 - 2 * t);
  }
};

}  // namespace plaza::synthetic
