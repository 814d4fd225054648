#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plugins/sources/synthetic/people/person.h"
#include "plugins/sources/synthetic/world/cast.h"
#include "plugins/sources/synthetic/world/scenario_info.h"
#include "plugins/sources/synthetic/world/stage.h"

namespace plaza::synthetic {

struct WorldOptions {
  std::string scenario = "four-crossing";  ///< one of World::scenarios()
  std::uint64_t seed = 1;
  double duration_s = 20;
  std::optional<int> people;  ///< 2-10, for scenarios with any_number; else their own
  Stage stage;
};

/// People who move on a stage as a scenario has them. Everything is decided while constructing, so
/// the rest is a pure function that any number of threads may call. A longer duration continues a
/// shorter one: what happens at a moment depends on scenario, seed, people and stage only.
class World {
 public:
  /// Throws UserError for an unknown scenario, a number of people outside 2-10 or for a scenario
  /// that has its own, or an area smaller than 3 m x 3 m.
  explicit World(const WorldOptions& options);

  /// A world is moved, not copied.
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  static std::vector<ScenarioInfo> scenarios();

  const Stage& stage() const { return stage_; }
  /// Everyone who appears at any time. A person who leaves and comes back is one member.
  const std::vector<CastMember>& cast() const { return cast_; }

  /// Everyone who is in the world at a moment, outside of the observed area too, in the order of
  /// the cast. Defined from 0.5 s before the start to 0.5 s after the end, so that exposures may
  /// reach beyond both; earlier and later moments are taken as these.
  std::vector<PersonState> at(double seconds) const;

  /// The identity that the truth gives a person at a moment: one per stay in the observed area, so
  /// who leaves it and returns gets a new one (thesis 3.3.1). None outside of the area. A step
  /// across the border and back within a second does not end a stay, but has no identity itself.
  std::optional<std::size_t> identity(std::size_t person, double seconds) const;

 private:
  struct Presence;
  /// A stay in the observed area.
  struct Visit {
    std::size_t person = 0;
    double begin_s = 0;
    double end_s = 0;
  };
  void find_visits();

  Stage stage_;
  std::vector<CastMember> cast_;
  double duration_s_;
  std::vector<std::unique_ptr<Presence>> presences_;  // in the order in which they begin
  std::vector<Visit> visits_;                         // the index is the identity
};

}  // namespace plaza::synthetic
