#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "plaza/core/export.h"
#include "plaza/geometry/box.h"
#include "plaza/geometry/camera.h"

namespace plaza {

/// A point of a silhouette's outline.
struct ContourPoint {
  Eigen::Vector2f pixel;
  Eigen::Vector2f normal;  ///< unit length, outward
};

/// Foreground pixels [begin, end) of one image row.
struct RowSpan {
  std::int32_t row = 0;
  std::int32_t begin = 0;
  std::int32_t end = 0;

  bool operator==(const RowSpan&) const = default;
};

/// A model at a pose, seen by a camera. Empty contour and spans: not visible at all.
struct Silhouette {
  std::vector<ContourPoint> contour;  ///< not cut at the image border
  std::vector<RowSpan> spans;         ///< cut to the image, by rising row, without overlap
  Box box;                            ///< of the whole silhouette, not cut
  double inside_share = 0;            ///< share of the silhouette's area inside the image, [0, 1]
};

/// An upright convex solid: a convex polygon, moved from `bottom_m` up to `top_m`.
struct Prism {
  std::vector<Eigen::Vector2d> base_m;  ///< corners in order around, at least 3, metres
  double bottom_m = 0;                  ///< height above the ground
  double top_m = 0;                     ///< above bottom_m
};

/// An upright cylinder as a prism, with as many sides as it takes for this camera: the outlines
/// differ by at most 0.02 px, as far as 512 sides can do it.
PLAZA_API Prism cylinder_prism(const Eigen::Vector2d& centre_m, double radius_m, double bottom_m,
                               double top_m, const Camera& camera);

/// Silhouette of the union of convex solids, exact under any camera: outlines are found in ideal
/// coordinates, where they are convex, and then go through the lens.
///
/// contour: the boundary of the union, one point every `step_px` (> 0) along it. What ends at the
/// limits of sight has no outline there: beyond twice the image's radius about the optical axis, or
/// where the lens folds back, solids are cut; the box ends there too, and the share counts up to
/// there.
/// spans: the pixels whose centres lie on the union.
///
/// Nothing is visible when the solids are behind the camera, when no part of them is in the image,
/// or when the camera is inside one of them.
PLAZA_API Silhouette silhouette_of(std::span<const Prism> solids, const Camera& camera,
                                   double step_px = 1);

}  // namespace plaza
