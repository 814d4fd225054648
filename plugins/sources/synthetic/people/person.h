#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plaza::synthetic {

/// The rigid segments of a body, each named by what it carries. Left and right are the person's.
enum class Segment : std::uint8_t {
  kPelvis,
  kAbdomen,
  kChest,
  kNeck,
  kHead,
  kLeftUpperArm,
  kLeftForearm,
  kLeftHand,
  kRightUpperArm,
  kRightForearm,
  kRightHand,
  kLeftThigh,
  kLeftShin,
  kLeftFoot,
  kRightThigh,
  kRightShin,
  kRightFoot,
};
inline constexpr std::size_t kSegmentCount = 17;

/// Lengths between joints, metres, of one person. The ground is at z = 0 and soles stand on it when
/// the body is upright: stature = ankle + shin + thigh + pelvis + abdomen + chest + neck + head.
struct Proportions {
  double stature_m = 1.75;
  double ankle_m = 0.08;           ///< sole to ankle
  double shin_m = 0.43;            ///< ankle to knee
  double thigh_m = 0.43;           ///< knee to hip joint
  double pelvis_m = 0.12;          ///< hip joints up to the lumbar joint
  double abdomen_m = 0.17;         ///< lumbar to thoracic joint
  double chest_m = 0.23;           ///< thoracic joint to the base of the neck
  double neck_m = 0.07;            ///< base of the neck to the base of the head
  double head_m = 0.22;            ///< base of the head to the crown
  double upper_arm_m = 0.30;       ///< shoulder to elbow
  double forearm_m = 0.26;         ///< elbow to wrist
  double hand_m = 0.18;            ///< wrist to finger tips
  double foot_m = 0.26;            ///< heel to toes
  double hip_width_m = 0.18;       ///< between the hip joints
  double shoulder_width_m = 0.38;  ///< between the shoulder joints
  double girth = 1.0;              ///< factor on all cross-sections: slim 0.85, stout 1.25
};

/// One body at one moment. `world_from_segment[s]` places segment s: its origin is the proximal
/// joint (pelvis: the middle between the hip joints; abdomen: lumbar; chest: thoracic; neck: base
/// of the neck; head: base of the head; arms: shoulder, elbow, wrist; legs: hip, knee, ankle), its
/// axes are those of the upright body at rest: x forward, y to the person's left, z up. At rest
/// arms hang down, so limbs extend along -z, spine and head along +z, feet along +x.
struct BodyPose {
  std::array<Eigen::Isometry3d, kSegmentCount> world_from_segment;
  const Eigen::Isometry3d& operator[](Segment s) const {
    return world_from_segment[static_cast<std::size_t>(s)];
  }
  Eigen::Isometry3d& operator[](Segment s) {
    return world_from_segment[static_cast<std::size_t>(s)];
  }
};

/// A person that is in the world at one moment.
struct PersonState {
  std::size_t person = 0;      ///< index into the world's cast
  Eigen::Vector2d position_m;  ///< the pelvis projected down
  double heading_rad = 0;      ///< torso yaw, 0 along +x, counter-clockwise seen from above
  BodyPose pose;
};

}  // namespace plaza::synthetic
