#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "plaza/geometry/silhouette.h"

namespace plaza {

/// A polygon in pixels that hides what is behind it; its corners in order, at least 3.
using OccluderPolygon = std::vector<Eigen::Vector2d>;

/// The part of a silhouette that is not hidden: without contour points and pixels inside any
/// polygon. The box stays that of the whole silhouette; inside_share becomes the share that is in
/// the image and not hidden.
Silhouette without_hidden(const Silhouette& silhouette, std::span<const OccluderPolygon> polygons);

}  // namespace plaza
