#pragma once

#include <cstdint>
#include <vector>

#include "framework/execution/frame_reader.h"
#include "framework/execution/plan.h"
#include "framework/execution/progress.h"
#include "framework/results/track_store.h"
#include "plaza/component/renderer.h"

namespace plaza {

/// A renderer and what it draws.
struct RenderTask {
  std::size_t node = 0;
  Renderer* renderer = nullptr;
  const TrackStore* tracks = nullptr;    ///< null: it draws no tracks
  int ground_truth_slot = -1;            ///< -1: none
  std::vector<PayloadPtr> ground_truth;  ///< kept while streaming, from the first frame on
  bool begun = false;
};

struct RenderEnd {
  bool stopped = false;
  std::exception_ptr fault;
  std::optional<std::size_t> failed_node;
};

/// Reads frames [begin, end) of the clock again and hands them to all renderers, each in order.
/// `seconds` by node grows by what each one took.
RenderEnd render_frames(std::vector<RenderTask>& tasks, const ExecutionPlan& plan,
                        FrameReader& reader, std::int64_t begin, std::int64_t end, int threads,
                        std::vector<double>& seconds, Progress& progress);

}  // namespace plaza
