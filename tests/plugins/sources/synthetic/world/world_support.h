#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "plugins/sources/synthetic/people/skeleton.h"
#include "plugins/sources/synthetic/world/world.h"

namespace plaza::synthetic {

inline Stage stage_of(const std::string& scenario) {
  for (const ScenarioInfo& info : World::scenarios()) {
    if (info.name == scenario && !info.indoor) {
      return outdoor_stage({{-0.5, -1.5}, {7.0, 9.5}});
    }
  }
  return indoor_stage({{-2, -3}, {2, 3}});
}

inline WorldOptions options_of(const std::string& scenario, std::uint64_t seed,
                               double duration_s = 20) {
  WorldOptions options;
  options.scenario = scenario;
  options.seed = seed;
  options.duration_s = duration_s;
  options.stage = stage_of(scenario);
  return options;
}

/// One person's states at a constant rate, without gaps.
struct Film {
  std::size_t person = 0;
  double start_s = 0;
  std::vector<PersonState> states;
};

inline std::vector<Film> film(const World& world, double duration_s, double rate_hz) {
  std::vector<Film> done;
  std::map<std::size_t, Film> open;
  for (int k = 0; k <= static_cast<int>(duration_s * rate_hz); ++k) {
    const double t = k / rate_hz;
    std::map<std::size_t, Film> still;
    for (PersonState& state : world.at(t)) {
      const auto found = open.find(state.person);
      Film reel = found == open.end() ? Film{state.person, t, {}} : std::move(found->second);
      if (found != open.end()) {
        open.erase(found);
      }
      reel.states.push_back(std::move(state));
      still.emplace(reel.person, std::move(reel));
    }
    for (auto& [person, reel] : open) {
      done.push_back(std::move(reel));
    }
    open = std::move(still);
  }
  for (auto& [person, reel] : open) {
    done.push_back(std::move(reel));
  }
  return done;
}

inline Eigen::Vector3d heel(const PersonState& state, const Proportions& p, bool left) {
  return state.pose[left ? Segment::kLeftFoot : Segment::kRightFoot] *
         Eigen::Vector3d(kHeelShare * p.foot_m, 0, -p.ankle_m);
}

inline Eigen::Vector3d toes(const PersonState& state, const Proportions& p, bool left) {
  return state.pose[left ? Segment::kLeftFoot : Segment::kRightFoot] *
         Eigen::Vector3d(kToeShare * p.foot_m, 0, -p.ankle_m);
}

inline double between(const PersonState& a, const PersonState& b) {
  return (a.position_m - b.position_m).norm();
}

/// Angle between where `a` faces and where `b` is.
inline double off_facing(const PersonState& a, const PersonState& b) {
  const Eigen::Vector2d to = (b.position_m - a.position_m).normalized();
  return std::acos(std::clamp(
      to.dot(Eigen::Vector2d(std::cos(a.heading_rad), std::sin(a.heading_rad))), -1.0, 1.0));
}

}  // namespace plaza::synthetic
