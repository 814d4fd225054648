#include "framework/execution/frame_reader.h"

#include <chrono>
#include <utility>

#include "framework/execution/guard.h"
#include "plaza/data/frames.h"

namespace plaza {
namespace {

std::size_t index_of(const ExecutionPlan& plan, const PlannedNode& node) {
  return static_cast<std::size_t>(&node - plan.nodes.data());
}

}  // namespace

void FrameReader::replay_clock(std::int64_t end, std::function<void(FrameState&)> fill) {
  info_ = {.frame_count = end, .rereadable = true};
  fill_ = std::move(fill);
}

void FrameReader::open(bool with_clock) {
  for (const PlannedNode& node : plan_.nodes) {
    const bool clock = index_of(plan_, node) == plan_.clock;
    if (node.source == nullptr || !(node.works || (clock && with_clock))) continue;
    const SourceInfo info = guarded(node.name, std::nullopt, [&] {
      return node.source->open(clock ? SourceRole::kClock : SourceRole::kFollower);
    });
    if (clock) info_ = info;
  }
  next_ = 0;
}

void FrameReader::keep(const std::filesystem::path& folder) {
  if (info_.rereadable || spool_) return;
  spool_ = std::make_unique<Spool>(folder);
  kept_from_ = live_next_;
}

void FrameReader::seek(std::int64_t frame) {
  for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
    const PlannedNode& node = plan_.nodes[i];
    // a clock that does not work has been opened for learners alone, unless it is replaced
    const bool works = i == plan_.clock ? !fill_ : node.works;
    if (node.source == nullptr || !works) continue;
    if (i == plan_.clock && !info_.rereadable) continue;
    guarded(node.name, frame, [&] { node.source->seek(frame); });
  }
  const PlannedNode& clock = plan_.nodes[plan_.clock];
  if (!info_.rereadable) {
    if (frame < live_next_ && (!spool_ || frame < kept_from_)) {
      throw InternalError("frame " + std::to_string(frame + 1) + " of the live source '" +
                          clock.name + "' was not kept");
    }
    FrameState skipped;
    while (live_next_ < frame) {
      next_ = live_next_;
      if (!read_clock(skipped)) {
        throw UserError("the live source '" + clock.name + "' ended after " +
                        std::to_string(live_next_) + " frames, before the first one asked for");
      }
    }
  }
  next_ = frame;
}

bool FrameReader::read_source(const PlannedNode& node, FrameState& state) const {
  const auto start = std::chrono::steady_clock::now();
  const std::size_t index = index_of(plan_, node);
  state.failed_node = index;  // until it has not failed
  const bool more = guarded(node.name, state.frame, [&] {
    NodeIo io(state.frame, state.time_ns, state.slots.data(), node.inputs, node.outputs);
    return node.source->read(io);
  });
  state.failed_node.reset();
  state.node_ns[index] +=
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - start)
          .count();
  return more;
}

bool FrameReader::read_live(const PlannedNode& clock, FrameState& state) {
  if (state.frame < live_next_) {  // again, from what was kept
    const std::int64_t index = state.frame - kept_from_;
    const std::vector<PayloadPtr>& others = kept_.at(static_cast<std::size_t>(index));
    for (std::size_t o = 0; o < clock.outputs.size(); ++o) {
      const int slot = clock.outputs[o];
      state.slots[static_cast<std::size_t>(slot)] =
          slot == plan_.frames_slot ? PayloadPtr(spool_->read(index)) : others[o];
    }
    return true;
  }
  if (!read_source(clock, state)) return false;
  ++live_next_;
  if (!spool_) return true;
  std::vector<PayloadPtr>& others = kept_.emplace_back(clock.outputs.size());
  for (std::size_t o = 0; o < clock.outputs.size(); ++o) {
    const PayloadPtr& payload = state.slots[static_cast<std::size_t>(clock.outputs[o])];
    if (clock.outputs[o] == plan_.frames_slot) {
      spool_->append(dynamic_cast<const FrameSet&>(*payload));
    } else {
      others[o] = payload;
    }
  }
  return true;
}

bool FrameReader::read_clock(FrameState& state) {
  state.reset(next_, scene_.time_of_frame(next_), plan_.slot_count, plan_.nodes.size());
  const PlannedNode& clock = plan_.nodes[plan_.clock];
  if (fill_) {
    if (next_ >= info_.frame_count) return false;
    fill_(state);
    ++next_;
    return true;
  }
  if (!(info_.rereadable ? read_source(clock, state) : read_live(clock, state))) return false;
  if (plan_.frames_slot >= 0 && !state.slots[static_cast<std::size_t>(plan_.frames_slot)]) {
    guarded(clock.name, state.frame, [] {
      throw InternalError("gave a frame without emitting Frames; a missing view is an empty image");
    });
  }
  ++next_;
  return true;
}

void FrameReader::read_background(std::int64_t index, FrameState& state) const {
  state.reset(index, scene_.time_of_frame(index), plan_.slot_count, plan_.nodes.size());
  const PlannedNode& clock = plan_.nodes[plan_.clock];
  state.failed_node = plan_.clock;
  guarded(clock.name, std::nullopt, [&] {
    state.slots[static_cast<std::size_t>(plan_.frames_slot)] = clock.source->background(index);
  });
  state.failed_node.reset();
}

bool FrameReader::read(FrameState& state) {
  if (!read_clock(state)) return false;
  for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
    const PlannedNode& node = plan_.nodes[i];
    if (node.source == nullptr || i == plan_.clock || !node.works) continue;
    if (!read_source(node, state)) {
      state.failed_node = i;
      guarded(node.name, state.frame, [] {
        throw InternalError("ended; only the first source may, the others say 'nothing here'");
      });
    }
  }
  return true;
}

}  // namespace plaza
