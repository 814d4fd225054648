#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <vector>

#include "plaza/data/payload.h"

namespace plaza {

/// One frame on its way through the nodes. States are used again for later frames.
struct FrameState {
  std::int64_t frame = 0;  ///< from 0
  std::int64_t time_ns = 0;
  std::vector<PayloadPtr> slots;
  std::vector<std::int64_t> node_ns;  ///< time spent in each node
  std::vector<bool> wanted;           ///< while learning: who learns from this frame
  std::exception_ptr fault;
  std::optional<std::size_t> failed_node;

  void reset(std::int64_t next_frame, std::int64_t next_time_ns, std::size_t slot_count,
             std::size_t node_count);
};

/// Something to be done with every frame.
struct Stage {
  bool ordered = true;  ///< one frame at a time, in order; else different frames at once
  std::function<void(FrameState&)> work;
};

/// Frames are read in order, pass all stages, and are done in order.
struct FrameLoop {
  std::function<bool(FrameState&)> read;  ///< false: the end
  std::vector<Stage> stages;
  std::function<void(FrameState&)> done;  ///< only frames that passed all stages
  /// May be empty. The frame that failed and those that were on their way behind it, in order: they
  /// aren't done, but what ordered stages put into them may be about frames that are. What this
  /// throws is lost, since one fault has been kept.
  std::function<void(FrameState&)> rest;
};

struct LoopEnd {
  std::int64_t frames = 0;   ///< that are done
  bool stopped = false;      ///< by request_stop()
  std::exception_ptr fault;  ///< of the earliest frame that failed, on any number of threads
  std::optional<std::size_t> failed_node;
};

/// With one thread plainly one frame after the other: the reference. With more, up to 2 * threads +
/// 2 frames are on their way at once, in the current task arena. Ordered stages never see a frame
/// after one that failed before them; frames that are done are the same in both modes.
LoopEnd run_frames(const FrameLoop& loop, int threads);

}  // namespace plaza
