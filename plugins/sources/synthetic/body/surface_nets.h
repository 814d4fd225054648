#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace plaza::synthetic {

struct ClosedSurface {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// The zero set of a signed distance inside `bounds` as triangles of about `cell_m`, by surface
/// nets (S. Gibson, "Constrained elastic surface nets", 1998): one vertex per cell that the surface
/// crosses. Closed as long as the surface stays inside the bounds.
ClosedSurface surface_nets(const std::function<float(const Eigen::Vector3f&)>& distance,
                           const Eigen::AlignedBox3f& bounds, float cell_m);

}  // namespace plaza::synthetic
