#include "plugins/sources/synthetic/world/world.h"

#include <algorithm>
#include <cmath>

#include "plaza/core/error.h"
#include "plugins/sources/synthetic/people/body_motion.h"
#include "plugins/sources/synthetic/people/random.h"
#include "plugins/sources/synthetic/world/director.h"
#include "plugins/sources/synthetic/world/scenarios.h"

namespace plaza::synthetic {
namespace {

constexpr double kWarmUpS = 2.0;  // people are in motion when the first frame is taken
constexpr double kMarginS = 0.5;  // exposures reach beyond the first and last frame
constexpr double kSmoothingS = 0.12;
constexpr double kBriefAbsenceS = 1.0;

const ScenarioEntry& find_scenario(const WorldOptions& options) {
  std::string known;
  for (const ScenarioEntry& entry : scenario_table()) {
    if (entry.info.name == options.scenario) {
      return entry;
    }
    known += (known.empty() ? "" : ", ") + entry.info.name;
  }
  throw UserError("there is no scenario \"" + options.scenario + "\"; there are " + known);
}

int number_of_people(const ScenarioInfo& info, const WorldOptions& options) {
  if (!options.people) {
    return info.people;
  }
  if (!info.any_number && *options.people != info.people) {
    throw UserError("scenario \"" + info.name + "\" has its own number of people, " +
                    std::to_string(info.people) + "; leave out \"people\" or take \"crowd\"");
  }
  if (*options.people < 2 || *options.people > 10) {
    throw UserError("a crowd of " + std::to_string(*options.people) +
                    " people can't be had; ask for 2 to 10");
  }
  return *options.people;
}

}  // namespace

/// A person from coming to going. Bodies refer to each other's ground motion: it stays in place.
struct World::Presence {
  std::size_t person = 0;
  GroundMotion motion;
  std::unique_ptr<BodyMotion> body;
};

World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

World::World(const WorldOptions& options) : stage_(options.stage), duration_s_(options.duration_s) {
  const ScenarioEntry& entry = find_scenario(options);
  const int people = number_of_people(entry.info, options);
  if ((stage_.area.size().array() < 3.0).any() || stage_.doors.empty()) {
    throw UserError("people need an area of 3 m x 3 m or more and a door, scenario \"" +
                    entry.info.name + "\" got " + std::to_string(stage_.area.size().x()) + " m x " +
                    std::to_string(stage_.area.size().y()) + " m and " +
                    std::to_string(stage_.doors.size()) + " doors");
  }
  if (!(duration_s_ >= 0) || duration_s_ > 86400) {
    throw UserError("a world lasts between 0 s and a day, not " + std::to_string(duration_s_) +
                    " s");
  }
  Director director(stage_, options.seed, -kWarmUpS);
  const std::unique_ptr<Scenario> scenario = entry.make(people);
  // longer than needed, so that smoothing and steps at the end don't depend on where it is
  director.run(*scenario, duration_s_ + kMarginS + 2.5);
  const std::vector<Stay> stays = director.take_stays();
  cast_ = director.take_cast();

  for (const Stay& stay : stays) {
    presences_.push_back(std::make_unique<Presence>(Presence{
        stay.person,
        GroundMotion(stay.start_s, stay.position_m, stay.heading_rad).smoothed(kSmoothingS),
        nullptr}));
  }
  for (std::size_t i = 0; i < stays.size(); ++i) {
    std::vector<Act> acts;
    for (const Stay::StayAct& done : stays[i].acts) {
      Act act;
      act.kind = done.kind;
      act.begin_s = done.begin_s;
      act.end_s = done.end_s;
      act.seed = done.seed;
      for (const auto& other : presences_) {
        if (other->person == done.partner && other->motion.start_s() <= done.begin_s &&
            other->motion.end_s() >= done.begin_s) {
          act.partner = {&other->motion, cast_[done.partner].proportions.stature_m};
        }
      }
      acts.push_back(act);
    }
    Presence& presence = *presences_[i];
    const CastMember& member = cast_[presence.person];
    // people of the same looks don't walk alike
    presence.body =
        std::make_unique<BodyMotion>(member.proportions, presence.motion, std::move(acts),
                                     mix(mix(options.seed, member.looks_seed), presence.person));
  }
  find_visits();
}

std::vector<ScenarioInfo> World::scenarios() {
  std::vector<ScenarioInfo> infos;
  for (const ScenarioEntry& entry : scenario_table()) {
    infos.push_back(entry.info);
  }
  return infos;
}

std::vector<PersonState> World::at(double seconds) const {
  const double t = std::clamp(seconds, -kMarginS, duration_s_ + kMarginS);
  std::vector<PersonState> states;
  for (const auto& presence : presences_) {
    if (t >= presence->motion.start_s() && t <= presence->motion.end_s()) {
      states.push_back(presence->body->at(t));
      states.back().person = presence->person;
    }
  }
  std::stable_sort(states.begin(), states.end(),
                   [](const PersonState& a, const PersonState& b) { return a.person < b.person; });
  return states;
}

void World::find_visits() {
  for (const auto& presence : presences_) {
    bool inside = false;
    const double first = std::max(presence->motion.start_s(), -kMarginS);
    const double last = std::min(presence->motion.end_s(), duration_s_ + kMarginS);
    for (int k = 0; first + k * 0.04 <= last; ++k) {
      const double t = first + k * 0.04;
      if (!stage_.area.contains(presence->body->at(t).position_m)) {
        inside = false;
        continue;
      }
      if (!inside) {
        const auto before = std::find_if(visits_.rbegin(), visits_.rend(), [&](const Visit& visit) {
          return visit.person == presence->person;
        });
        if (before == visits_.rend() || t - before->end_s > kBriefAbsenceS) {
          visits_.push_back({presence->person, t, t});
          inside = true;
          continue;
        }
      }
      inside = true;
      std::find_if(visits_.rbegin(), visits_.rend(), [&](const Visit& visit) {
        return visit.person == presence->person;
      })->end_s = t;
    }
  }
  std::stable_sort(visits_.begin(), visits_.end(),
                   [](const Visit& a, const Visit& b) { return a.begin_s < b.begin_s; });
}

std::optional<std::size_t> World::identity(std::size_t person, double seconds) const {
  const double t = std::clamp(seconds, -kMarginS, duration_s_ + kMarginS);
  for (const auto& presence : presences_) {
    if (presence->person != person || t < presence->motion.start_s() ||
        t > presence->motion.end_s() || !stage_.area.contains(presence->body->at(t).position_m)) {
      continue;
    }
    for (std::size_t i = 0; i < visits_.size(); ++i) {
      // visits are found in steps of 0.04 s
      if (visits_[i].person == person && t > visits_[i].begin_s - 0.04 &&
          t < visits_[i].end_s + 0.04) {
        return i;
      }
    }
  }
  return std::nullopt;
}

}  // namespace plaza::synthetic
