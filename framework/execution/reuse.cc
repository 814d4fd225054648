#include "framework/execution/reuse.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "framework/cache/payload_codec.h"
#include "framework/execution/stop.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr std::chrono::milliseconds kPoll{20};

const ComponentDeclaration& declaration_of(const ExecutionPlan& plan, std::size_t node) {
  return plan.nodes[node].resolved->entry->declaration;
}

}  // namespace

Reuse::Reuse(const NodeCache& cache, const RunOptions& options)
    : cache_(cache),
      options_(options),
      frames_{options.first_frame, options.end_frame},
      recordings_(cache, options.least_gain, options.first_frame) {}

std::string Reuse::key_of(const Place& place) const {
  return keys_.nodes[place.node] + " output " + std::to_string(place.output);
}

/// Opens all entries that there are. What is open can't be taken away by another process.
void Reuse::look(const ExecutionPlan& plan) {
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    const auto& outputs = declaration_of(plan, i).outputs;
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      const Place place{i, o};
      if (kept_.contains(place) || !can_keep(outputs[o].type)) continue;
      if (auto reader = cache_.open(key_of(place))) kept_[place] = std::move(reader);
    }
  }
}

/// What working nodes give to others that the cache could have and has not.
std::vector<Place> Reuse::missing(const ExecutionPlan& plan, const Demand& demand) const {
  std::vector<Place> places;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    const auto& outputs = declaration_of(plan, i).outputs;
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      if (!demand.works[i] || !demand.wanted[i][o] || !can_keep(outputs[o].type)) continue;
      if (!kept_.contains({i, o})) places.push_back({i, o});
    }
  }
  return places;
}

/// Takes all of these locks, one after the other in an order that all processes share, so that none
/// waits for another in a circle. False when a stop was requested.
bool Reuse::lock(std::vector<Place> places) {
  std::sort(places.begin(), places.end(),
            [this](const Place& a, const Place& b) { return key_of(a) < key_of(b); });
  locks_.clear();
  for (const Place& place : places) {
    while (true) {
      if (stop_requested()) return false;
      if (auto lock = cache_.try_lock(key_of(place))) {
        locks_[place] = std::move(*lock);
        break;
      }
      std::this_thread::sleep_for(kPoll);
    }
  }
  return true;
}

bool Reuse::begin(ExecutionPlan& plan, const std::vector<Branch>& branches,
                  const ResolvedPipeline& pipeline, const Scene& scene) {
  plan_ = &plan;
  without_cache_ =
      demand_of(plan, branches, options_.draw, [](std::size_t, std::size_t) { return false; });
  demand_ = without_cache_;
  if (options_.reuse) {
    LibraryIdentities libraries;
    keys_ = stream_keys(plan, pipeline, scene, frames_, libraries);
    if (!settle(plan, branches)) return false;
  } else if (options_.draw) {
    return true;  // everybody works
  }
  bool replays = false;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) plan.nodes[i].works = demand_.works[i];
  for (const auto& [place, reader] : kept_) {
    if (reader->info().declined || demand_.works[place.node]) continue;
    if (!demand_.wanted[place.node][place.output]) continue;
    replays = true;
    replay_end_ = reader->info().first_frame + reader->info().frames;
  }
  if (plan.nodes[plan.clock].works || !replays) {  // somebody has to say where the end is
    plan.nodes[plan.clock].works = true;
    replay_end_.reset();
  }
  return true;
}

bool Reuse::settle(const ExecutionPlan& plan, const std::vector<Branch>& branches) {
  const auto kept = [this](std::size_t node, std::size_t output) {
    const auto it = kept_.find({node, output});
    return it != kept_.end() && !it->second->info().declined;
  };
  std::vector<Place> places;
  while (true) {
    look(plan);
    demand_ = demand_of(plan, branches, options_.draw, kept);
    places = missing(plan, demand_);
    const bool mine = std::all_of(places.begin(), places.end(),
                                  [this](const Place& p) { return locks_.contains(p); });
    if (mine) break;
    try {
      if (!lock(places)) return false;
    } catch (const UserError& error) {  // a folder that can't be written is no reason not to run
      recordings_.troubles().push_back(std::string("results of nodes are not kept: ") +
                                       error.what());
      places.clear();
      break;
    }
  }
  recordings_.begin(plan, known_seconds());
  for (const Place& place : places) {
    recordings_.open(place, key_of(place), std::move(locks_.at(place)));
  }
  locks_.clear();
  return true;
}

/// What entries say that their nodes, and those above, took.
Recordings::Seconds Reuse::known_seconds() const {
  Recordings::Seconds known;
  for (const auto& [place, reader] : kept_) {
    if (!reader->info().declined)
      known.insert(reader->info().seconds.begin(), reader->info().seconds.end());
  }
  return known;
}

void Reuse::replay_node(std::size_t node, FrameState& state) const {
  const PlannedNode& planned = plan_->nodes[node];
  for (std::size_t o = 0; o < planned.outputs.size(); ++o) {
    if (!demand_.wanted[node][o]) continue;
    const auto it = kept_.find({node, o});
    if (it == kept_.end() || it->second->info().declined) continue;
    state.slots[static_cast<std::size_t>(planned.outputs[o])] = it->second->payload(state.frame);
  }
}

void Reuse::replay(FrameState& state, std::optional<std::size_t> but) const {
  for (std::size_t i = 0; i < plan_->nodes.size(); ++i) {
    if (!plan_->nodes[i].works && i != but) replay_node(i, state);
  }
}

void Reuse::replay_flush(FrameState& state) const {
  for (const auto& [place, reader] : kept_) {
    const PlannedNode& node = plan_->nodes[place.node];
    if (node.works || !demand_.wanted[place.node][place.output] || reader->info().declined)
      continue;
    state.slots[static_cast<std::size_t>(node.outputs[place.output])] = reader->flushed();
  }
}

double Reuse::node_seconds(const std::vector<NodeTiming>& timings) const {
  const Recordings::Seconds known = known_seconds();
  double seconds = 0;
  for (std::size_t i = 0; i < plan_->nodes.size(); ++i) {
    const PlannedNode& node = plan_->nodes[i];
    if (!without_cache_.works[i]) continue;  // a clock that nobody reads only counts frames
    if (node.works) {
      seconds += timings[i].seconds;
    } else {
      const auto it = known.find(node.name);
      if (it != known.end()) seconds += it->second;
    }
  }
  return seconds;
}

std::vector<std::string> Reuse::kept_notes() const {
  for (const auto& [place, reader] : kept_) {
    if (replay_end_ && !reader->info().declined) return reader->info().notes;
  }
  return {};
}

}  // namespace plaza
