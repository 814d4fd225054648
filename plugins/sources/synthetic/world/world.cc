#include "plugins/sources/synthetic/world/world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plaza/core/error.h"
#include "plugins/sources/synthetic/people/proportions.h"
#include "plugins/sources/synthetic/people/random.h"
#include "plugins/sources/synthetic/people/skeleton.h"

namespace plaza::synthetic {

World::World(const WorldOptions& options) : stage_(options.stage), duration_s_(options.duration_s) {
  for (std::uint64_t person = 0; person < 2; ++person) {
    CastMember member;
    member.looks_seed = mix(options.seed, person);
    member.proportions = draw_proportions(member.looks_seed);
    member.clothing_key = member.looks_seed;
    cast_.push_back(member);
  }
}

const std::vector<ScenarioInfo>& World::scenarios() {
  static const std::vector<ScenarioInfo> all = {
      {"two-targets", "two people walk past each other", true, 2}};
  return all;
}

std::vector<PersonState> World::at(double seconds) const {
  const double t = std::clamp(seconds, -0.5, duration_s_ + 0.5);
  std::vector<PersonState> states;
  for (std::size_t person = 0; person < cast_.size(); ++person) {
    const double side = person == 0 ? 1.0 : -1.0;
    const double swing = std::sin(0.4 * t) * (stage_.area.size().x() / 2 - 0.5);
    PersonState state;
    state.person = person;
    state.position_m = stage_.area.center() + Eigen::Vector2d(side * swing, side * 0.5);
    state.heading_rad = side * std::cos(0.4 * t) > 0 ? 0.0 : std::numbers::pi;
    JointRotations joints;
    const Proportions& p = cast_[person].proportions;
    joints.pelvis_m = {state.position_m.x(), state.position_m.y(),
                       p.ankle_m + p.shin_m + p.thigh_m};
    joints.pelvis = yaw_rotation(state.heading_rad);
    for (auto& arm : joints.arms) {
      arm.upper = arm.fore = arm.hand = joints.pelvis;
    }
    for (auto& leg : joints.legs) {
      leg.thigh = leg.shin = leg.foot = joints.pelvis;
    }
    state.pose = place_segments(p, joints);
    states.push_back(std::move(state));
  }
  return states;
}

std::optional<std::size_t> World::identity(std::size_t person, double seconds) const {
  for (const PersonState& state : at(seconds)) {
    if (state.person == person && stage_.area.contains(state.position_m)) {
      return person;
    }
  }
  return std::nullopt;
}

}  // namespace plaza::synthetic
