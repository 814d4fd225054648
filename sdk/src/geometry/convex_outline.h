#pragma once

#include <Eigen/Core>
#include <vector>

#include "plaza/geometry/silhouette.h"

namespace plaza {

/// Corner of a convex outline in ideal image coordinates (x / z, y / z).
struct OutlineCorner {
  Eigen::Vector2d ideal;
  bool open = false;  ///< sight ends along the edge that starts here: it is no outline of the solid
};
/// Counter-clockwise where x points right and y up, that is, of positive area.
using ConvexOutline = std::vector<OutlineCorner>;

/// Twice the area of the triangle (0, a, b), positive counter-clockwise.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Outline of the part of a prism that is in front of the camera's centre; empty when there is
/// none.
ConvexOutline outline_of(const Prism& prism, const CameraFromWorld& pose);

/// Whether a point of the world is inside the prism or on it.
bool contains(const Prism& prism, const Eigen::Vector3d& x_world);
/// Whether an ideal point is inside the outline or on it.
bool contains(const ConvexOutline& outline, const Eigen::Vector2d& ideal);

/// Cuts the outline to a regular polygon inside the disc about the optical axis.
ConvexOutline cut_to_disc(const ConvexOutline& outline, double radius);

}  // namespace plaza
