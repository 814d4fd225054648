#include "plugins/sources/synthetic/world/scenarios.h"

namespace plaza::synthetic {

const std::vector<ScenarioEntry>& scenario_table() {
  static const std::vector<ScenarioEntry> table = [] {
    std::vector<ScenarioEntry> entries;
    const auto add = [&](const char* name, const char* challenge, bool indoor, int people,
                         bool any_number, MakeScenario make) {
      ScenarioEntry& entry = entries.emplace_back();
      entry.info.name = name;
      entry.info.challenge = challenge;
      entry.info.indoor = indoor;
      entry.info.people = people;
      entry.info.any_number = any_number;
      entry.make = make;
    };
    add("two-targets", "close interaction for a very long time by shaking hands", true, 2, false,
        &make_two_targets);
    add("three-boxmotion", "notable speed, walking with rotational motion, mutual occlusion", true,
        3, false, &make_boxmotion);
    add("three-targets", "frequent crossing, close interaction, being occluded", true, 3, false,
        &make_three_targets);
    add("four-interaction", "very long interaction, very slow motion, standing still", true, 4,
        false, &make_interaction);
    add("four-crossing", "very dark clothing, frequent close crossing", true, 4, false,
        &make_crossing);
    add("six-targets", "high density and heavy occlusion in a small area, entering and leaving",
        true, 6, false, &make_six_targets);
    add("twins", "two pairs in the same clothing meet, stay in contact, and swap places or don't",
        true, 4, false, &make_twins);
    add("crowd", "any number of people who walk, stand and meet", true, 5, true, &make_crowd);
    add("standing", "two of four people stand still for more than a minute", true, 4, false,
        &make_standing);
    add("campus", "outdoors: few people who walk and run through", false, 4, false, &make_campus);
    add("terrace", "outdoors: up to nine people at close quarters", false, 9, false, &make_terrace);
    return entries;
  }();
  return table;
}

}  // namespace plaza::synthetic
