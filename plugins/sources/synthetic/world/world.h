#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plugins/sources/synthetic/people/person.h"
#include "plugins/sources/synthetic/world/stage.h"

namespace plaza::synthetic {

enum class ClothingStyle {
  kAny,
  kDark,  ///< very dark, hardly telling one person from the other (thesis table 3.1)
};

/// What does not change about a person.
struct CastMember {
  Proportions proportions;
  std::uint64_t looks_seed = 0;    ///< of skin, hair, face
  std::uint64_t clothing_key = 0;  ///< of clothes and shoes: equal keys, equal clothes
  ClothingStyle style = ClothingStyle::kAny;
  bool bag = false;
};

/// A scenario that can be asked for.
struct ScenarioInfo {
  std::string name;
  std::string challenge;  ///< what makes it hard, after the thesis's table 3.1
  bool indoor = true;     ///< plays in a room by default
  int people = 0;         ///< at most present at once, unless another number is asked for
};

struct WorldOptions {
  std::string scenario = "four-crossing";  ///< one of World::scenarios()
  std::uint64_t seed = 1;
  double duration_s = 20;
  std::optional<int> people;  ///< 2-10, instead of the scenario's own number where it has one
  Stage stage;
};

/// People who move on a stage as a scenario has them. Everything is decided while constructing, so
/// the rest is a pure function that any number of threads may call. A longer duration continues a
/// shorter one: what happens at a moment depends on scenario, seed, people and stage only.
class World {
 public:
  /// Throws UserError for an unknown scenario, a number of people outside 2-10 or one that the
  /// scenario can't have, or an area too small for it.
  explicit World(const WorldOptions& options);

  static const std::vector<ScenarioInfo>& scenarios();

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
  Stage stage_;
  std::vector<CastMember> cast_;
  double duration_s_;
};

}  // namespace plaza::synthetic
