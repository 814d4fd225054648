#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "plaza/geometry/scene.h"

namespace plaza {

/// A person somewhere in a view, whose box hides what stands behind.
struct Screen {
  Box box;
  double distance_m = 0;  ///< on the ground, from the camera
};

/// Share of the body's axis that `camera` sees of a person at `position_m`, [0, 1]: what is outside
/// the image, behind a static occluder or behind a nearer person's box does not count.
double visible_share(const Scene& scene, std::size_t camera, const Eigen::Vector2d& position_m,
                     std::span<const Screen> people);

/// Distance on the ground between a camera and a position, m.
double ground_distance(const Camera& camera, const Eigen::Vector2d& position_m);

}  // namespace plaza
