#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "plugins/sources/synthetic/people/ground_motion.h"
#include "plugins/sources/synthetic/people/person.h"

namespace plaza::synthetic {

/// What arms do besides swinging.
enum class ActKind : std::uint8_t {
  kHandshake,  ///< right hands meet halfway to the partner
  kHug,        ///< both arms around the partner
  kGesture,    ///< hands move in front of the body, as talkers' do
  kArmsCrossed,
  kHandsOnHips,
  kHandsInPockets,
  kHandsBehind,
  kPhone,  ///< the right hand holds something to look at
};

/// The body that a handshake or a hug is with. Its motion outlives the act.
struct Partner {
  const GroundMotion* motion = nullptr;
  double stature_m = 0;
};

/// An act of one body; it is blended in and out within `ramp_s` inside of its interval.
struct Act {
  ActKind kind = ActKind::kGesture;
  double begin_s = 0;
  double end_s = 0;
  double ramp_s = 0.6;
  std::uint64_t seed = 0;  ///< of small movements; partners who shake hands have the same
  Partner partner;         ///< of kHandshake and kHug
};

/// Where an act wants the wrists, and how firmly (0 not at all, 1 completely), left and right.
struct HandGoal {
  Eigen::Vector3d wrist_m = Eigen::Vector3d::Zero();   ///< world
  Eigen::Vector3d pointing = Eigen::Vector3d::Zero();  ///< of the hand; zero: as the forearm
  double weight = 0;
};
struct ActGoals {
  HandGoal hands[2];
  double lean_rad = 0;  ///< of the trunk, forward
  double head_down_rad = 0;
};

/// `position_m` and `heading_rad` are those of the acting body at the moment.
ActGoals act_goals(const Act& act, const Proportions& proportions,
                   const Eigen::Vector2d& position_m, double heading_rad, double seconds);

/// A smooth wave of time without a visible period, within +-1, that differs between `seed`s and
/// changes on the scale of `period_s`.
double slow_wave(std::uint64_t seed, double seconds, double period_s);

}  // namespace plaza::synthetic
