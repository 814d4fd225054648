#include "plugins/sources/synthetic/people/skeleton.h"

#include <algorithm>
#include <cmath>

namespace plaza::synthetic {
namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Isometry3d placed(const Vector3d& origin, const Quaterniond& rotation) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = rotation.toRotationMatrix();
  pose.translation() = origin;
  return pose;
}

}  // namespace

BodyPose place_segments(const Proportions& p, const JointRotations& joints) {
  BodyPose pose;
  // puts a segment at `joint` and moves that to where the next one begins
  const auto place = [&pose](Segment segment, Vector3d& joint, const Quaterniond& rotation,
                             double length_m) {
    pose[segment] = placed(joint, rotation);
    joint += rotation * Vector3d(0, 0, length_m);
  };
  const Quaterniond pelvis = joints.pelvis.normalized();
  const Quaterniond abdomen = (pelvis * joints.lumbar).normalized();
  const Quaterniond chest = (abdomen * joints.thoracic).normalized();
  const Quaterniond neck = (chest * joints.neck).normalized();
  const Quaterniond head = (neck * joints.head).normalized();
  Vector3d joint = joints.pelvis_m;
  place(Segment::kPelvis, joint, pelvis, p.pelvis_m);
  place(Segment::kAbdomen, joint, abdomen, p.abdomen_m);
  const Vector3d thoracic = joint;
  place(Segment::kChest, joint, chest, p.chest_m);
  place(Segment::kNeck, joint, neck, p.neck_m);
  pose[Segment::kHead] = placed(joint, head);

  for (std::size_t side = 0; side < 2; ++side) {
    const double left = side == 0 ? 1.0 : -1.0;
    const SideSegments& segments = kSides[side];
    const auto& arm = joints.arms[side];
    joint = thoracic + chest * shoulder_offset(p, left);
    place(segments.upper_arm, joint, arm.upper.normalized(), -p.upper_arm_m);
    place(segments.forearm, joint, arm.fore.normalized(), -p.forearm_m);
    pose[segments.hand] = placed(joint, arm.hand.normalized());

    const auto& leg = joints.legs[side];
    joint = joints.pelvis_m + pelvis * Vector3d(0, left * p.hip_width_m / 2, 0);
    place(segments.thigh, joint, leg.thigh.normalized(), -p.thigh_m);
    place(segments.shin, joint, leg.shin.normalized(), -p.shin_m);
    pose[segments.foot] = placed(joint, leg.foot.normalized());
  }
  return pose;
}

Vector3d shoulder_offset(const Proportions& p, double left) {
  return {-0.01, left * p.shoulder_width_m / 2, p.chest_m * 0.86};
}

Quaterniond limb_along(const Vector3d& direction, const Vector3d& forward) {
  const Vector3d z = -direction.normalized();
  const Vector3d x = (forward - forward.dot(z) * z).normalized();
  Eigen::Matrix3d rotation;
  rotation << x, z.cross(x), z;
  return Quaterniond(rotation);
}

TwoBones reach(const Vector3d& root, const Vector3d& target, double upper_m, double lower_m,
               const Vector3d& pole) {
  const Vector3d offset = target - root;
  // a limb never folds up completely nor stretches to a mathematical line
  const double distance =
      std::clamp(offset.norm(), 0.3 * (upper_m + lower_m), 0.9995 * (upper_m + lower_m));
  const Vector3d along = offset.norm() > 1e-9 ? Vector3d(offset.normalized()) : Vector3d(0, 0, -1);
  const Vector3d side = (pole - pole.dot(along) * along).normalized();
  const double cosine = std::clamp(
      (upper_m * upper_m + distance * distance - lower_m * lower_m) / (2 * upper_m * distance),
      -1.0, 1.0);
  const double sine = std::sqrt(1 - cosine * cosine);
  const Vector3d upper = cosine * along + sine * side;
  return {upper, (distance * along - upper_m * upper).normalized()};
}

Quaterniond yaw_rotation(double radians) {
  return Quaterniond(Eigen::AngleAxisd(radians, Vector3d::UnitZ()));
}

}  // namespace plaza::synthetic
