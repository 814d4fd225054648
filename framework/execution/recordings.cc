#include "framework/execution/recordings.h"

#include <chrono>

#include "framework/cache/component_key.h"
#include "framework/cache/payload_codec.h"
#include "framework/execution/guard.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

using SteadyClock = std::chrono::steady_clock;

// frames that say what computing and reading back take; the first ones also fill caches
constexpr std::int64_t kMeasuredFrames = 10;

}  // namespace

void Recordings::begin(const ExecutionPlan& plan, Seconds known) {
  plan_ = &plan;
  known_ = std::move(known);
}

void Recordings::open(const Place& place, const std::string& key, FileLock lock) {
  Recording recording{.place = place, .lock = std::move(lock), .writer = nullptr};
  try {
    recording.writer = cache_.create(key);
    recordings_.push_back(std::move(recording));
  } catch (const UserError& error) {
    give_up(recording, error.what());
  }
}

void Recordings::end(Recording& recording) {
  recording.writer.reset();
  recording.lock = {};
}

void Recordings::give_up(Recording& recording, const std::string& why) {
  end(recording);
  troubles_.push_back("what '" + plan_->nodes[recording.place.node].name +
                      "' gives is not kept: " + why);
}

void Recordings::decline(Recording& recording, const std::vector<NodeTiming>& timings) {
  try {
    recording.writer->clear();
    EntryInfo info = info_of(recording.place, recording.frames, timings);
    info.declined = true;
    recording.writer->commit(info);
    end(recording);
  } catch (const UserError& error) {
    give_up(recording, error.what());
  }
}

const PayloadPtr& Recordings::payload_of(const Recording& recording,
                                         const FrameState& state) const {
  const PlannedNode& node = plan_->nodes[recording.place.node];
  return state.slots[static_cast<std::size_t>(node.outputs[recording.place.output])];
}

/// The payload's bytes; none of them when nothing was given, nothing when they can't be had.
std::optional<std::string> Recordings::encode(const Place& place, const PayloadPtr& payload) const {
  if (!payload) return std::string();
  return guarded(plan_->nodes[place.node].name, std::nullopt,
                 [&] { return encode_payload(*payload, cache_.loaders()); });
}

void Recordings::add(const FrameState& state, const std::vector<NodeTiming>& timings) {
  for (Recording& recording : recordings_) {
    if (recording.writer) add(recording, state, timings);
  }
}

void Recordings::add(Recording& recording, const FrameState& state,
                     const std::vector<NodeTiming>& timings) {
  const PayloadPtr& payload = payload_of(recording, state);
  const std::optional<std::string> bytes = encode(recording.place, payload);
  if (!bytes) return decline(recording, timings);  // something in it can't be kept, now or ever
  try {
    if (payload && recording.frames < kMeasuredFrames) measure(recording, *payload, *bytes);
    recording.writer->add(*bytes);
  } catch (const DamagedEntry& error) {  // a feature that does not take back what it saved
    return give_up(recording, error.what());
  } catch (const UserError& error) {
    return give_up(recording, error.what());
  }
  ++recording.frames;
  if (recording.frames == kMeasuredFrames &&
      timings[recording.place.node].seconds < least_gain_ * recording.read_s) {
    decline(recording, timings);
  } else if (recording.writer->bytes() > cache_.limit_bytes()) {
    give_up(recording, "it is larger than the cache may be");
  }
}

void Recordings::measure(Recording& recording, const Payload& payload,
                         const std::string& bytes) const {
  const auto start = SteadyClock::now();
  decode_payload(payload.port(), bytes, cache_.loaders(), "what is read back");
  recording.read_s += std::chrono::duration<double>(SteadyClock::now() - start).count();
}

void Recordings::add_flush(const FrameState& state) {
  for (Recording& recording : recordings_) {
    if (!recording.writer) continue;
    const auto bytes = encode(recording.place, payload_of(recording, state));
    try {
      if (!bytes) throw UserError("something in it can't be kept");
      recording.writer->add(*bytes);
    } catch (const UserError& error) {
      give_up(recording, error.what());
    }
  }
}

EntryInfo Recordings::info_of(const Place& place, std::int64_t frames,
                              const std::vector<NodeTiming>& timings) const {
  const ComponentDeclaration& declaration = plan_->nodes[place.node].resolved->entry->declaration;
  EntryInfo info;
  info.use = declaration.name;
  info.node = plan_->nodes[place.node].name;
  info.port = declaration.outputs[place.output].type;
  info.first_frame = first_frame_;
  info.frames = frames;
  for (const std::size_t above : nodes_above(*plan_, place.node)) {
    const std::string& name = plan_->nodes[above].name;
    const auto known = known_.find(name);  // it was replayed, or stands above one that was
    if (plan_->nodes[above].works) {
      info.seconds[name] = timings[above].seconds;
    } else if (known != known_.end()) {
      info.seconds[name] = known->second;
    }
  }
  return info;
}

void Recordings::commit(std::int64_t frames, const std::vector<NodeTiming>& timings,
                        const std::vector<std::string>& notes) {
  bool any = false;
  for (Recording& recording : recordings_) {
    if (!recording.writer) continue;
    try {
      EntryInfo info = info_of(recording.place, frames, timings);
      info.notes = notes;
      recording.writer->commit(info);
      end(recording);
      any = true;
    } catch (const UserError& error) {
      give_up(recording, error.what());
    }
  }
  if (any) cache_.make_room();
}

}  // namespace plaza
