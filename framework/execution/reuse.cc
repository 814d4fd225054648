#include "framework/execution/reuse.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "framework/cache/payload_codec.h"
#include "framework/execution/guard.h"
#include "framework/execution/stop.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

using SteadyClock = std::chrono::steady_clock;

// frames that say what computing and reading back take; the first ones also fill caches
constexpr std::int64_t kMeasuredFrames = 10;
constexpr std::chrono::milliseconds kPoll{20};

double seconds_since(SteadyClock::time_point start) {
  return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

const ComponentDeclaration& declaration_of(const ExecutionPlan& plan, std::size_t node) {
  return plan.nodes[node].resolved->entry->declaration;
}

}  // namespace

Reuse::Reuse(const NodeCache& cache, double least_gain, StreamKeys keys, const FrameRange& frames)
    : cache_(cache), least_gain_(least_gain), keys_(std::move(keys)), frames_(frames) {}

std::string Reuse::key_of(const Place& place) const {
  return keys_.nodes[place.first] + " output " + std::to_string(place.second);
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
std::vector<Reuse::Place> Reuse::missing(const ExecutionPlan& plan, const Demand& demand) const {
  std::vector<Place> places;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    const auto& outputs = declaration_of(plan, i).outputs;
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      if (!demand.works[i] || !demand.wanted[i][o] || !can_keep(outputs[o].type)) continue;
      if (!kept_.contains({i, o})) places.emplace_back(i, o);
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

bool Reuse::begin(ExecutionPlan& plan, const std::vector<Branch>& branches, bool draw) {
  plan_ = &plan;
  const auto kept = [this](std::size_t node, std::size_t output) {
    const auto it = kept_.find({node, output});
    return it != kept_.end() && !it->second->info().declined;
  };
  without_cache_ = demand_of(plan, branches, draw, [](std::size_t, std::size_t) { return false; });
  std::vector<Place> places;
  while (true) {
    look(plan);
    demand_ = demand_of(plan, branches, draw, kept);
    places = missing(plan, demand_);
    const bool mine = std::all_of(places.begin(), places.end(),
                                  [this](const Place& p) { return locks_.contains(p); });
    if (mine) break;
    try {
      if (!lock(places)) return false;
    } catch (const UserError& error) {  // a folder that can't be written is no reason not to run
      troubles_.push_back(std::string("results of nodes are not kept: ") + error.what());
      places.clear();
      break;
    }
  }
  std::erase_if(locks_, [&places](const auto& lock) {
    return std::find(places.begin(), places.end(), lock.first) == places.end();
  });

  bool replays = false;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) plan.nodes[i].works = demand_.works[i];
  for (const auto& [place, reader] : kept_) {
    if (reader->info().declined || demand_.works[place.first]) continue;
    if (!demand_.wanted[place.first][place.second]) continue;
    replays = true;
    replay_end_ = reader->info().first_frame + reader->info().frames;
  }
  if (plan.nodes[plan.clock].works || !replays) {  // somebody has to say where the end is
    plan.nodes[plan.clock].works = true;
    replay_end_.reset();
  }
  open_recordings(places);
  return true;
}

void Reuse::open_recordings(const std::vector<Place>& places) {
  for (const Place& place : places) {
    try {
      Recording recording;
      recording.place = place;
      recording.writer = cache_.create(key_of(place));
      recordings_.push_back(std::move(recording));
    } catch (const UserError& error) {
      troubles_.push_back("what '" + plan_->nodes[place.first].name +
                          "' gives is not kept: " + error.what());
    }
  }
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
    const PlannedNode& node = plan_->nodes[place.first];
    if (node.works || !demand_.wanted[place.first][place.second] || reader->info().declined)
      continue;
    state.slots[static_cast<std::size_t>(node.outputs[place.second])] = reader->flushed();
  }
}

void Reuse::give_up(Recording& recording, const std::string& why) {
  recording.writer.reset();
  locks_.erase(recording.place);
  troubles_.push_back("what '" + plan_->nodes[recording.place.first].name +
                      "' gives is not kept: " + why);
}

void Reuse::decline(Recording& recording, const std::vector<NodeTiming>& timings) {
  try {
    recording.writer->clear();
    EntryInfo info = info_of(recording.place, recording.frames, timings);
    info.declined = true;
    recording.writer->commit(info);
    recording.writer.reset();
    locks_.erase(recording.place);
  } catch (const UserError& error) {
    give_up(recording, error.what());
  }
}

/// The payload's bytes; none of them when nothing was given, nothing when they can't be had.
std::optional<std::string> Reuse::encode(const Place& place, const PayloadPtr& payload) const {
  if (!payload) return std::string();
  return guarded(plan_->nodes[place.first].name, std::nullopt,
                 [&] { return encode_payload(*payload, cache_.loaders()); });
}

void Reuse::record(const FrameState& state, const std::vector<NodeTiming>& timings) {
  for (Recording& recording : recordings_) {
    if (!recording.writer) continue;
    const auto [node, output] = recording.place;
    const PayloadPtr& payload =
        state.slots[static_cast<std::size_t>(plan_->nodes[node].outputs[output])];
    const std::optional<std::string> bytes = encode(recording.place, payload);
    if (!bytes) {  // something in it can't be kept, now or ever
      decline(recording, timings);
      continue;
    }
    try {
      if (payload && recording.frames < kMeasuredFrames) {
        const auto start = SteadyClock::now();
        decode_payload(payload->port(), *bytes, cache_.loaders(), "what is read back");
        recording.read_s += seconds_since(start);
      }
    } catch (const DamagedEntry& error) {  // a feature that does not take back what it saved
      give_up(recording, error.what());
      continue;
    }
    try {
      recording.writer->add(*bytes);
    } catch (const UserError& error) {
      give_up(recording, error.what());
      continue;
    }
    ++recording.frames;
    if (recording.frames == kMeasuredFrames &&
        timings[node].seconds < least_gain_ * recording.read_s) {
      decline(recording, timings);
    } else if (recording.writer->bytes() > cache_.limit_bytes()) {
      give_up(recording, "it is larger than the cache may be");
    }
  }
}

void Reuse::record_flush(const FrameState& state) {
  for (Recording& recording : recordings_) {
    if (!recording.writer) continue;
    const auto [node, output] = recording.place;
    const PayloadPtr& payload =
        state.slots[static_cast<std::size_t>(plan_->nodes[node].outputs[output])];
    const auto bytes = encode(recording.place, payload);
    try {
      if (!bytes) throw UserError("something in it can't be kept");
      recording.writer->add(*bytes);
    } catch (const UserError& error) {
      give_up(recording, error.what());
    }
  }
}

EntryInfo Reuse::info_of(const Place& place, std::int64_t frames,
                         const std::vector<NodeTiming>& timings) const {
  const ComponentDeclaration& declaration = declaration_of(*plan_, place.first);
  EntryInfo info;
  info.use = declaration.name;
  info.node = plan_->nodes[place.first].name;
  info.port = declaration.outputs[place.second].type;
  info.first_frame = frames_.first;
  info.frames = frames;
  for (const std::size_t above : nodes_above(*plan_, place.first)) {
    const std::string& name = plan_->nodes[above].name;
    if (plan_->nodes[above].works) {
      info.seconds[name] = timings[above].seconds;
      continue;
    }
    for (const auto& [other, reader] : kept_) {  // it was replayed, or stands above one that was
      const auto it = reader->info().seconds.find(name);
      if (it != reader->info().seconds.end() && !reader->info().declined)
        info.seconds[name] = it->second;
    }
  }
  return info;
}

void Reuse::commit(std::int64_t frames, const std::vector<NodeTiming>& timings,
                   const std::vector<std::string>& notes) {
  bool any = false;
  for (Recording& recording : recordings_) {
    if (!recording.writer) continue;
    try {
      EntryInfo info = info_of(recording.place, frames, timings);
      info.notes = notes;
      recording.writer->commit(info);
      recording.writer.reset();
      any = true;
    } catch (const UserError& error) {
      give_up(recording, error.what());
    }
  }
  locks_.clear();
  if (any) cache_.make_room();
}

double Reuse::node_seconds(const std::vector<NodeTiming>& timings) const {
  std::map<std::string, double> known;
  for (const auto& [place, reader] : kept_) {
    if (!reader->info().declined)
      known.insert(reader->info().seconds.begin(), reader->info().seconds.end());
  }
  double seconds = 0;
  for (std::size_t i = 0; i < plan_->nodes.size(); ++i) {
    const PlannedNode& node = plan_->nodes[i];
    if (node.works) {
      seconds += timings[i].seconds;
    } else if (without_cache_.works[i]) {
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
