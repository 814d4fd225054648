#include "framework/execution/frame_loop.h"

#include <tbb/parallel_pipeline.h>

#include <atomic>
#include <memory>

#include "framework/execution/stop.h"

namespace plaza {
namespace {

/// Runs `work`, leaving what it throws in the frame: nothing but frames passes from stage to stage.
template <class Work>
void attempt(FrameState& state, const Work& work) {
  try {
    work(state);
  } catch (...) {
    state.fault = std::current_exception();
  }
}

/// After the frame that failed, or with it.
void leave(const FrameLoop& loop, FrameState& state) {
  if (loop.rest) attempt(state, loop.rest);
}

void end_with(const FrameLoop& loop, LoopEnd& end, FrameState& state) {
  end.fault = state.fault;
  end.failed_node = state.failed_node;
  leave(loop, state);
}

LoopEnd run_in_sequence(const FrameLoop& loop) {
  LoopEnd end;
  FrameState state;
  while (true) {
    if (stop_requested()) {
      end.stopped = true;
      return end;
    }
    bool more = true;
    attempt(state, [&](FrameState& s) {
      more = loop.read(s);
      if (!more) return;
      for (const Stage& stage : loop.stages) stage.work(s);
      loop.done(s);
    });
    if (state.fault) {
      end_with(loop, end, state);
      return end;
    }
    if (!more) return end;
    ++end.frames;
  }
}

class ParallelLoop {
 public:
  ParallelLoop(const FrameLoop& loop, int threads)
      : loop_(loop), states_(static_cast<std::size_t>(2 * threads + 2)) {}

  LoopEnd run() {
    using Chain = tbb::filter<void, FrameState*>;
    Chain chain = tbb::make_filter<void, FrameState*>(
        tbb::filter_mode::serial_in_order,
        [this](tbb::flow_control& control) { return next(control); });
    for (const Stage& stage : loop_.stages) {
      chain = chain & (stage.ordered ? ordered(stage) : unordered(stage));
    }
    tbb::parallel_pipeline(states_.size(), chain & tbb::make_filter<FrameState*, void>(
                                                       tbb::filter_mode::serial_in_order,
                                                       [this](FrameState* s) { end(*s); }));
    return end_;
  }

 private:
  using Filter = tbb::filter<FrameState*, FrameState*>;

  FrameState* next(tbb::flow_control& control) {
    if (failing_.load(std::memory_order_relaxed)) {
      control.stop();
      return nullptr;
    }
    if (stop_requested()) {
      end_.stopped = true;
      control.stop();
      return nullptr;
    }
    // frames end in order, so the state of the frame that is states_.size() before this one is free
    FrameState& state = states_[next_++ % states_.size()];
    bool more = true;
    attempt(state, [&](FrameState& s) { more = loop_.read(s); });
    if (state.fault) {
      failing_ = true;
    } else if (!more) {
      control.stop();
      return nullptr;
    }
    return &state;
  }

  Filter unordered(const Stage& stage) {
    return tbb::make_filter<FrameState*, FrameState*>(tbb::filter_mode::parallel,
                                                      [this, &stage](FrameState* state) {
                                                        pass(stage, *state);
                                                        return state;
                                                      });
  }

  Filter ordered(const Stage& stage) {
    return tbb::make_filter<FrameState*, FrameState*>(
        tbb::filter_mode::serial_in_order,
        [this, &stage, dead = std::make_shared<bool>(false)](FrameState* state) {
          if (!*dead) pass(stage, *state);
          *dead = *dead || state->fault;  // also what failed just now: the next frame must not pass
          return state;
        });
  }

  void pass(const Stage& stage, FrameState& state) {
    if (state.fault) return;
    attempt(state, stage.work);
    if (state.fault) failing_ = true;
  }

  void end(FrameState& state) {
    if (end_.fault) {
      leave(loop_, state);
      return;
    }
    if (!state.fault) attempt(state, loop_.done);
    if (state.fault) {
      failing_ = true;
      end_with(loop_, end_, state);
      return;
    }
    ++end_.frames;
  }

  const FrameLoop& loop_;
  std::vector<FrameState> states_;
  std::size_t next_ = 0;
  std::atomic<bool> failing_{false};
  LoopEnd end_;  // `stopped` is written by the first filter, the rest by the last one
};

}  // namespace

void FrameState::reset(std::int64_t next_frame, std::int64_t next_time_ns, std::size_t slot_count,
                       std::size_t node_count) {
  frame = next_frame;
  time_ns = next_time_ns;
  slots.assign(slot_count, nullptr);
  node_ns.assign(node_count, 0);
  fault = nullptr;
  failed_node.reset();
}

LoopEnd run_frames(const FrameLoop& loop, int threads) {
  if (threads <= 1) return run_in_sequence(loop);
  return ParallelLoop(loop, threads).run();
}

}  // namespace plaza
