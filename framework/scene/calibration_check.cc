#include "framework/scene/calibration_check.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "framework/scene/fields.h"

namespace plaza {
namespace {

constexpr double kRotationTolerance = 1e-3;
constexpr double kFarthest_m = 500;
constexpr double kLowest_m = 0.2;
constexpr double kHighest_m = 300;
// PETS's own View 007 folds back in a corner, on 3 % of its image.
constexpr double kLargestFoldedShare = 0.1;

double metres(const std::string& unit) { return unit == "mm" ? 1e-3 : unit == "cm" ? 1e-2 : 1; }

/// "; is the unit "mm"?" for the unit that would bring `value_m` into [least, most].
std::string unit_question(double value_m, double least, double most, const std::string& unit) {
  for (const std::string candidate : {"mm", "cm", "m"}) {
    const double there = value_m / metres(unit) * metres(candidate);
    if (candidate != unit && there >= least && there <= most) {
      return unit.empty() ? "; check \"metres_per_unit\"" : "; is the unit \"" + candidate + "\"?";
    }
  }
  return "";
}

std::string distance_text(double m) {
  return std::abs(m) >= 1000  ? short_number(m / 1000) + " km"
         : std::abs(m) >= 0.1 ? short_number(m) + " m"
                              : short_number(m * 1000) + " mm";
}

}  // namespace

std::string rotation_fault(const Eigen::Matrix3d& rotation) {
  const double deviation =
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation <= kRotationTolerance)) {
    return "the rotation matrix is not orthonormal: R times its transpose differs from the "
           "identity "
           "by " +
           short_number(deviation) +
           " (at most 0.001); check that it is complete, by rows, without " +
           "scale, and has at least four digits";
  }
  if (rotation.determinant() < 0) {
    return "the rotation matrix is a reflection (determinant -1): one axis is flipped; check that "
           "the camera's x points right, y down and z forward, and that the world is right-handed";
  }
  return "";
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& rotation) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

std::vector<std::string> lens_faults(const Camera& camera) {
  std::vector<std::string> faults;
  constexpr int kSteps = 32;
  int folded = 0;
  double widest = 1;  // cosine of the angle from the optical axis
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const auto ray =
          camera.ray({(camera.width() - 1.0) * i / kSteps, (camera.height() - 1.0) * j / kSteps});
      if (ray) {
        widest = std::min(widest, camera.pose().rotation.row(2).dot(ray->direction));
      } else {
        ++folded;
      }
    }
  }
  const double share = folded / std::pow(kSteps + 1, 2);
  if (share > kLargestFoldedShare) {
    faults.push_back(
        "the distortion folds back inside the image: " + short_number(std::round(100 * share)) +
        " % of its pixels have no ray; check the coefficients' order and units, and the "
        "image size they were estimated for");
  }
  if (std::acos(std::clamp(widest, -1.0, 1.0)) < 2.5e-3) {
    faults.emplace_back(
        "the field of view is below 0.3 degrees: the focal length is too large for the "
        "image; check its unit");
  } else if (share <= kLargestFoldedShare && widest < std::cos(1.5)) {
    faults.emplace_back(
        "rays at the image's border are more than 86 degrees off the optical axis: the "
        "focal length is too small for the image, or the distortion too strong");
  }
  return faults;
}

std::vector<std::string> placement_faults(const Camera& camera, const GroundArea& area,
                                          const Body& body, const std::string& unit) {
  const Eigen::Vector3d centre = camera.centre();
  const Eigen::Vector2d nearest = centre.head<2>().cwiseMax(area.min_m).cwiseMin(area.max_m);
  const double distance = (centre.head<2>() - nearest).norm();
  const double height = centre.z();
  if (!(distance <= kFarthest_m && height <= kHighest_m)) {
    const bool far = !(distance <= kFarthest_m);
    return {far ? "the camera is " + distance_text(distance) + " from the area" +
                      unit_question(distance, 0, kFarthest_m, unit)
                : "the camera is " + distance_text(height) + " above the ground" +
                      unit_question(height, kLowest_m, kHighest_m, unit)};
  }
  if (!(height > 0)) {
    return {
        "the camera is " + distance_text(std::abs(height)) +
        " below the ground; check that the world's z axis points up, and whether the translation "
        "is the camera's centre or maps world to camera (\"T_is\" of rtk-json)"};
  }
  if (height < kLowest_m) {
    return {"the camera is only " + distance_text(height) + " above the ground" +
            unit_question(height, kLowest_m, kHighest_m, unit)};
  }
  // People at the area's near border may show only their heads.
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d share(double(i) / kSteps, double(j) / kSteps);
      const Eigen::Vector2d p = area.min_m + share.cwiseProduct(area.max_m - area.min_m);
      for (const double z : {0.0, 0.5 * body.height_m, body.height_m}) {
        const auto pixel = camera.project({p.x(), p.y(), z});
        if (pixel && camera.contains(*pixel)) return {};
      }
    }
  }
  return {"the camera, at (" + short_number(centre.x()) + ", " + short_number(centre.y()) + ", " +
          short_number(centre.z()) +
          ") m, sees nobody in the area; check the area, the rotation, and that the calibration "
          "belongs to this scene's world frame (an x or y axis may be mirrored)"};
}

}  // namespace plaza
