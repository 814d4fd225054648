#pragma once

#include <memory>
#include <vector>

#include "plugins/sources/synthetic/people/acts.h"
#include "plugins/sources/synthetic/people/footsteps.h"
#include "plugins/sources/synthetic/people/ground_motion.h"
#include "plugins/sources/synthetic/people/person.h"

namespace plaza::synthetic {

/// How one person holds and moves itself; drawn per person, so that no two walk alike.
struct Manner {
  double arm_swing = 1.0;      ///< factor on the swing of the arms
  double elbow_rad = 0.25;     ///< bend of a hanging arm
  double arms_out_rad = 0.10;  ///< how far arms hang away from the body
  double lean_rad = 0.03;      ///< of the trunk, forward
  double sway = 1.0;           ///< factor on sideways movements of pelvis and trunk
  double bounce = 1.0;         ///< factor on knee bend, and so on the bob of the pelvis
  static Manner draw(std::uint64_t seed);
};

/// A body's whole motion, from where it is on the ground (planned elsewhere) down to each joint.
/// Feet follow the ground motion in steps; the pelvis rises and falls as far as the legs allow,
/// shifts over the leg that carries and turns with it; the chest counter-turns; arms swing with
/// the opposite leg, or do what an act wants.
class BodyMotion {
 public:
  /// Motions of partners in `acts` must outlive this object; so must `motion`.
  BodyMotion(const Proportions& proportions, const GroundMotion& motion, std::vector<Act> acts,
             std::uint64_t seed);

  double start_s() const { return motion_->start_s(); }
  double end_s() const { return motion_->end_s(); }
  /// Everything of the state but `person`.
  PersonState at(double seconds) const;
  const Footsteps& footsteps() const { return footsteps_; }

 private:
  struct Gait;
  Gait gait_at(double seconds) const;
  double highest_pelvis(double seconds) const;
  double pelvis_height(double seconds) const;

  Proportions proportions_;
  const GroundMotion* motion_;
  std::vector<Act> acts_;
  std::uint64_t seed_;
  Manner manner_;
  Footsteps footsteps_;
  std::vector<double> pelvis_height_;  // every 1 / GroundMotion::kRateHz
};

}  // namespace plaza::synthetic
