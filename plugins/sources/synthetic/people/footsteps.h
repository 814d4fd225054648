#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "plugins/sources/synthetic/people/ground_motion.h"
#include "plugins/sources/synthetic/people/person.h"

namespace plaza::synthetic {

/// Where a foot stands flat: the ankle projected down, and the foot's direction.
struct Plant {
  Eigen::Vector2d ankle_m = Eigen::Vector2d::Zero();
  double yaw_rad = 0;
};

/// One swing of one foot from plant to plant.
struct Step {
  double lift_s = 0;
  double land_s = 0;
  Plant from;
  Plant to;
  double running = 0;  ///< 0 walking, 1 running
};

/// A foot at one moment.
struct FootState {
  Eigen::Vector3d ankle_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0;
  double pitch_rad = 0;  ///< positive: heel up
  double swing = 0;      ///< 0 on the ground, rising to 1 in the middle of a swing
};

/// The steps with which a body follows its motion over the ground. A foot on the ground stays where
/// it is: it rolls over heel and toes, and never slides. While the body moves, feet step in turn,
/// each to where it will carry the body best in the middle of its time on the ground; while it
/// stands or turns on the spot, a foot steps only when it is too far from where it belongs.
class Footsteps {
 public:
  Footsteps(const GroundMotion& motion, const Proportions& proportions, std::uint64_t seed);

  /// side 0 is the left foot, 1 the right.
  FootState foot(std::size_t side, double seconds) const;
  const std::vector<Step>& steps(std::size_t side) const { return steps_[side]; }

 private:
  FootState on_ground(const Plant& plant, const Step* last, const Step* next, double seconds) const;
  FootState in_swing(const Step& step, double seconds) const;

  Proportions proportions_;
  std::array<Plant, 2> first_;
  std::array<std::vector<Step>, 2> steps_;
};

}  // namespace plaza::synthetic
