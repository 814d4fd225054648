#pragma once

#include <string>
#include <vector>

#include "framework/scene/calibration.h"
#include "plaza/geometry/scene.h"

namespace plaza {

/// What is wrong with a rotation matrix, or empty. Up to 1e-3 of deviation is rounding.
std::string rotation_fault(const Eigen::Matrix3d& rotation);
/// The rotation nearest to a nearly orthonormal matrix.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& rotation);

/// Faults of one camera's lens against its image.
std::vector<std::string> lens_faults(const Camera& camera);

/// Faults of one camera's place in the scene: units, height above the ground, area in view.
/// `unit` is the calibration's ("mm", "cm", "m"; empty: homographies, where it has another name).
std::vector<std::string> placement_faults(const Camera& camera, const GroundArea& area,
                                          const Body& body, const std::string& unit);

}  // namespace plaza
