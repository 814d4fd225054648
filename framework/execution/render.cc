#include "framework/execution/render.h"

#include <chrono>

#include "framework/execution/guard.h"

namespace plaza {
namespace {

void render_one(const RenderTask& task, const ExecutionPlan& plan, std::int64_t begin,
                const FrameState& state) {
  RenderFrame frame{.frame = state.frame,
                    .time_ns = state.time_ns,
                    .frames = {},
                    .tracks = {},
                    .ground_truth = {}};
  const PayloadPtr& images = state.slots[static_cast<std::size_t>(plan.frames_slot)];
  frame.frames = static_cast<const FrameSet*>(images.get());
  if (task.tracks != nullptr) frame.tracks = task.tracks->at(state.frame);
  if (const auto index = static_cast<std::size_t>(state.frame - begin);
      index < task.ground_truth.size()) {
    frame.ground_truth = static_cast<const GroundTruth*>(task.ground_truth[index].get());
  }
  task.renderer->render(frame);
}

}  // namespace

RenderEnd render_frames(std::vector<RenderTask>& tasks, const ExecutionPlan& plan,
                        FrameReader& reader, std::int64_t begin, std::int64_t end, int threads,
                        std::vector<double>& seconds, Progress& progress) {
  RenderEnd result;
  std::optional<std::size_t> beginning;
  try {
    for (RenderTask& task : tasks) {
      beginning = task.node;
      const std::string& name = plan.nodes[task.node].name;
      if (plan.frames_slot < 0) {
        guarded(name, std::nullopt, [&] {
          throw UserError("draws on images, but '" + plan.nodes[plan.clock].name + "' gives none");
        });
      }
      task.begun = true;  // an end belongs to every beginning, also to one that fails
      guarded(name, std::nullopt, [&] { task.renderer->begin(begin, end); });
    }
    beginning.reset();
    reader.seek(begin);
  } catch (...) {
    result.fault = std::current_exception();
    result.failed_node = beginning;
    return result;
  }

  FrameLoop loop;
  loop.read = [&](FrameState& state) {
    if (reader.next() >= end) return false;
    if (reader.read_clock(state)) return true;
    state.failed_node = plan.clock;
    guarded(plan.nodes[plan.clock].name, reader.next(), []() -> bool {
      throw UserError("gave fewer frames when it was read again; did its files change?");
    });
    return false;
  };
  for (const RenderTask& task : tasks) {
    loop.stages.push_back({.ordered = true, .work = [&task, &plan, begin](FrameState& state) {
                             const auto start = std::chrono::steady_clock::now();
                             state.failed_node = task.node;
                             guarded(plan.nodes[task.node].name, state.frame,
                                     [&] { render_one(task, plan, begin, state); });
                             state.failed_node.reset();
                             state.node_ns[task.node] = (std::chrono::steady_clock::now() - start) /
                                                        std::chrono::nanoseconds(1);
                           }});
  }
  loop.done = [&](FrameState& state) {
    for (const RenderTask& task : tasks) {
      seconds[task.node] += 1e-9 * static_cast<double>(state.node_ns[task.node]);
    }
    state.slots.clear();
    progress.tick();
  };
  progress.begin("render", end - begin);
  const LoopEnd loop_end = run_frames(loop, threads);
  progress.end();
  result.stopped = loop_end.stopped;
  result.fault = loop_end.fault;
  result.failed_node = loop_end.failed_node;
  return result;
}

}  // namespace plaza
