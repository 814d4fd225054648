#pragma once

#include <Eigen/Geometry>

#include "plugins/sources/synthetic/people/person.h"

namespace plaza::synthetic {

/// Where the sole touches the ground, as shares of foot_m from the ankle along the foot's x axis.
/// In the foot's frame heel and toes are at z = -ankle_m.
inline constexpr double kHeelShare = -0.27;
inline constexpr double kToeShare = 0.73;

/// Rotations of the joints of one body, and where its pelvis is. Rotations of the trunk are
/// relative to the segment below (the pelvis: to the world); those of limbs are absolute, since
/// inverse kinematics gives them so.
struct JointRotations {
  Eigen::Vector3d pelvis_m = Eigen::Vector3d::Zero();  ///< middle between the hip joints, world
  Eigen::Quaterniond pelvis = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond lumbar = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond thoracic = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond neck = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond head = Eigen::Quaterniond::Identity();
  struct Arm {
    Eigen::Quaterniond upper = Eigen::Quaterniond::Identity();
    Eigen::Quaterniond fore = Eigen::Quaterniond::Identity();
    Eigen::Quaterniond hand = Eigen::Quaterniond::Identity();
  };
  struct Leg {
    Eigen::Quaterniond thigh = Eigen::Quaterniond::Identity();
    Eigen::Quaterniond shin = Eigen::Quaterniond::Identity();
    Eigen::Quaterniond foot = Eigen::Quaterniond::Identity();
  };
  std::array<Arm, 2> arms;  ///< left, right
  std::array<Leg, 2> legs;  ///< left, right
};

/// The segments that there are on both sides, by side: left, right.
struct SideSegments {
  Segment upper_arm, forearm, hand, thigh, shin, foot;
};
inline constexpr std::array<SideSegments, 2> kSides = {{
    {Segment::kLeftUpperArm, Segment::kLeftForearm, Segment::kLeftHand, Segment::kLeftThigh,
     Segment::kLeftShin, Segment::kLeftFoot},
    {Segment::kRightUpperArm, Segment::kRightForearm, Segment::kRightHand, Segment::kRightThigh,
     Segment::kRightShin, Segment::kRightFoot},
}};

/// The shoulder joint in the chest's frame; `left` is 1 for the left one and -1 for the right.
Eigen::Vector3d shoulder_offset(const Proportions& proportions, double left);

/// Places all segments: each one starts where the segment before it ends.
BodyPose place_segments(const Proportions& proportions, const JointRotations& joints);

/// The rotation whose z axis is -`direction` (a limb at rest hangs along -z) and whose x axis is
/// as near to `forward` as that allows. Neither vector needs to be normalised; they must not be
/// parallel.
Eigen::Quaterniond limb_along(const Eigen::Vector3d& direction, const Eigen::Vector3d& forward);

/// The directions of two bones that join `root` and `target`, both unit vectors.
struct TwoBones {
  Eigen::Vector3d upper;
  Eigen::Vector3d lower;
};
/// Inverse kinematics of a limb of two bones: the joint between them bends towards `pole` (a
/// direction). A target out of reach is approached in a straight line.
TwoBones reach(const Eigen::Vector3d& root, const Eigen::Vector3d& target, double upper_m,
               double lower_m, const Eigen::Vector3d& pole);

/// Rotation about the vertical axis.
Eigen::Quaterniond yaw_rotation(double radians);

}  // namespace plaza::synthetic
