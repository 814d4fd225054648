#pragma once

#include <memory>
#include <vector>

#include "plugins/sources/synthetic/world/director.h"
#include "plugins/sources/synthetic/world/scenario_info.h"

namespace plaza::synthetic {

using MakeScenario = std::unique_ptr<Scenario> (*)(int people);
struct ScenarioEntry {
  ScenarioInfo info;
  MakeScenario make = nullptr;
};

/// Everything in this file's neighbours, in the order in which it is listed to users.
const std::vector<ScenarioEntry>& scenario_table();

// lab_pairs.cc
std::unique_ptr<Scenario> make_two_targets(int people);
std::unique_ptr<Scenario> make_twins(int people);
// lab_walkers.cc
std::unique_ptr<Scenario> make_boxmotion(int people);
std::unique_ptr<Scenario> make_three_targets(int people);
std::unique_ptr<Scenario> make_crossing(int people);
// lab_groups.cc
std::unique_ptr<Scenario> make_interaction(int people);
std::unique_ptr<Scenario> make_six_targets(int people);
std::unique_ptr<Scenario> make_crowd(int people);
// lab_standing.cc
std::unique_ptr<Scenario> make_standing(int people);
// outdoors.cc
std::unique_ptr<Scenario> make_campus(int people);
std::unique_ptr<Scenario> make_terrace(int people);

}  // namespace plaza::synthetic
