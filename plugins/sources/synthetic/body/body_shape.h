#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "plugins/sources/synthetic/body/distance_shapes.h"
#include "plugins/sources/synthetic/body/look.h"
#include "plugins/sources/synthetic/people/person.h"

namespace plaza::synthetic {

/// How far a surface point follows each of up to four segments; weights add up to 1.
struct SkinWeights {
  std::array<std::uint8_t, 4> segment{};
  std::array<float, 4> weight{};
};

/// A clothed body as a smooth solid in its bind pose: upright on the ground at the origin, facing
/// +x, arms held away from the body so that nothing touches that is not joined.
class BodyShape {
 public:
  BodyShape(const Proportions& proportions, const Look& look);

  /// Signed distance to the surface, metres, negative inside; close to it away from the surface.
  float distance(const Vec3& p) const;
  SkinWeights weights(const Vec3& p) const;

  const BodyPose& bind_pose() const { return bind_; }
  /// Box that holds the whole body in the bind pose.
  Eigen::AlignedBox3f bounds() const;

  /// Places in the bind pose that say where clothes begin and end.
  struct Landmarks {
    float ankle, knee, hip, waist, chest, neck, head, crown;  ///< heights
    Vec3 shoulder;           ///< the left one; the right one is its mirror image
    Vec3 arm;                ///< unit vector from the left shoulder to the left finger tips
    float upper_arm, wrist;  ///< along `arm` from the shoulder
    float torso_half_x, torso_half_y;
    float bag_x, bag_z, bag_y;  ///< centre of the bag
  };
  const Landmarks& landmarks() const { return at_; }
  /// On the bag's surface rather than on clothes.
  bool on_bag(const Vec3& p) const;
  /// On hair (or a cap) rather than on skin.
  bool on_hair(const Vec3& p) const;
  /// Distance of a point to the nearer arm's axis, and how far along it (0 at the shoulder).
  struct ArmPlace {
    float along = 0;
    float radial = 0;
  };
  ArmPlace arm_place(const Vec3& p) const;

 private:
  float torso(const Vec3& p) const;
  float arm(const Vec3& mirrored) const;
  float leg(const Vec3& mirrored) const;
  float skirt(const Vec3& p) const;
  float bare_head(const Vec3& p) const;
  float hair(const Vec3& p) const;
  float bag(const Vec3& p) const;

  Proportions body_;
  Look look_;
  BodyPose bind_;
  Landmarks at_{};
  float girth_ = 1;
  float top_thickness_ = 0.01f;
  Vec3 knee_, ankle_;  // of the left leg
  Eigen::Isometry3f foot_from_world_;
  std::array<Section, 7> torso_sections_{};
  std::array<Section, 4> skirt_sections_{};
  bool skirted_ = false;
};

}  // namespace plaza::synthetic
