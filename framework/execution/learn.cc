#include "framework/execution/learn.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "framework/execution/guard.h"
#include "framework/execution/learning_key.h"
#include "framework/execution/stop.h"
#include "plaza/component/learner.h"
#include "plaza/data/frames.h"

namespace plaza {
namespace {

constexpr std::int64_t kAll = std::numeric_limits<std::int64_t>::max();

/// One learner on its way through the pass.
struct Pupil {
  const LearningTask* task = nullptr;
  LearningPlan plan;
  std::int64_t end = 0;      ///< frames from here on are none of its business
  std::int64_t matched = 0;  ///< frames that qualified; every n-th of them is learned from
  std::int64_t seen = 0;
};

/// Which pupils want the frame, by frame state: decided where frames are read, used where they are
/// learned.
class Pass {
 public:
  Pass(std::vector<Pupil>& pupils, const ExecutionPlan& plan, FrameReader& reader)
      : pupils_(pupils), plan_(plan), reader_(reader) {
    for (const Pupil& pupil : pupils_) end_ = std::max(end_, pupil.end);
  }
  std::int64_t end() const { return end_; }

  /// Moves on to the next frame that anybody wants and reads it, backgrounds first.
  bool read(FrameState& state) {
    if (read_background(state)) return true;
    const std::optional<std::int64_t> known_end = reader_.frame_count();
    for (std::int64_t frame = next_; frame < end_; ++frame) {
      if (stop_requested()) return false;
      std::vector<bool> wanted = wanted_by(frame);
      const bool anybody = std::find(wanted.begin(), wanted.end(), true) != wanted.end();
      // beyond the announced end only reading tells whether there is more
      if (!anybody && known_end && frame < *known_end) continue;
      if (frame != reader_.next() && !reach(frame, known_end, state)) return false;
      next_ = frame + 1;
      if (!reader_.read_clock(state)) return false;
      if (!anybody) continue;
      state.wanted = std::move(wanted);
      return true;
    }
    return false;
  }

  void learn(std::size_t p, FrameState& state) {
    Pupil& pupil = pupils_[p];
    if (!state.wanted[p]) return;
    const PayloadPtr& frames = state.slots[static_cast<std::size_t>(plan_.frames_slot)];
    state.failed_node = pupil.task->node;
    guarded(plan_.nodes[pupil.task->node].name, state.frame,
            [&] { pupil.task->learner->learn(static_cast<const FrameSet&>(*frames)); });
    state.failed_node.reset();
    ++pupil.seen;
  }

 private:
  bool read_background(FrameState& state) {
    while (next_background_ < reader_.background_count()) {
      if (stop_requested()) return false;
      const std::int64_t index = next_background_++;
      std::vector<bool> wanted(pupils_.size(), false);
      for (std::size_t p = 0; p < pupils_.size(); ++p) {
        Pupil& pupil = pupils_[p];
        if (pupil.plan.people_free_only) wanted[p] = pupil.matched++ % pupil.plan.every == 0;
      }
      if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) continue;
      reader_.read_background(index, state);
      state.wanted = std::move(wanted);
      return true;
    }
    return false;
  }

  /// Makes `frame` the next one to be read; false where the source has ended before it. Where it
  /// announced its end nothing may be sought, so the frame before is read once more.
  bool reach(std::int64_t frame, std::optional<std::int64_t> known_end, FrameState& state) {
    if (!known_end || frame < *known_end || frame == 0) {
      reader_.seek(frame);
      return true;
    }
    reader_.seek(frame - 1);
    return reader_.read_clock(state);
  }

  std::vector<bool> wanted_by(std::int64_t frame) {
    std::optional<bool> free;  // asked once, and only if somebody wants to know
    std::vector<bool> wanted(pupils_.size(), false);
    for (std::size_t p = 0; p < pupils_.size(); ++p) {
      Pupil& pupil = pupils_[p];
      if (frame >= pupil.end) continue;
      if (pupil.plan.people_free_only) {
        const PlannedNode& clock = plan_.nodes[plan_.clock];
        if (!free)
          free = guarded(clock.name, frame, [&] { return clock.source->people_free(frame); });
        if (!*free) continue;
      }
      wanted[p] = pupil.matched++ % pupil.plan.every == 0;
    }
    return wanted;
  }

  std::vector<Pupil>& pupils_;
  const ExecutionPlan& plan_;
  FrameReader& reader_;
  std::int64_t next_ = 0;
  std::int64_t next_background_ = 0;
  std::int64_t end_ = 0;
};

std::vector<Pupil> pupils_of(const std::vector<LearningTask>& tasks, const ExecutionPlan& plan,
                             const FrameReader& reader) {
  std::vector<Pupil> pupils;
  for (const LearningTask& task : tasks) {
    const std::string& name = plan.nodes[task.node].name;
    const auto wanted = guarded(name, std::nullopt, [&] { return task.learner->plan(); });
    if (!wanted) continue;
    if (!wanted->first && !reader.rereadable() && !reader.frame_count()) {
      UserError error("learns from the whole recording, but '" + plan.nodes[plan.clock].name +
                      "' is live and has no end; limit it to a number of first frames");
      error.add_context({.component = name, .frame = {}, .camera = {}});
      throw error;
    }
    if (plan.frames_slot < 0) {
      UserError error("learns from images, but '" + plan.nodes[plan.clock].name + "' gives none");
      error.add_context({.component = name, .frame = {}, .camera = {}});
      throw error;
    }
    pupils.push_back({.task = &task, .plan = *wanted, .end = wanted->first.value_or(kAll)});
  }
  return pupils;
}

}  // namespace

std::vector<LearningTask> learning_tasks(const ExecutionPlan& plan,
                                         const ResolvedPipeline& pipeline, const Scene& scene) {
  std::vector<LearningTask> tasks;
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    Learner* const learner = plan.nodes[i].node->learner();
    if (learner == nullptr || !plan.nodes[i].works) continue;
    tasks.push_back({.node = i, .learner = learner, .key = learning_key(plan, i, pipeline, scene)});
  }
  return tasks;
}

Recall recall_models(const std::vector<LearningTask>& tasks, const ExecutionPlan& plan,
                     const ModelCache& cache, const std::set<std::size_t>& distrusted) {
  Recall recall;
  for (const LearningTask& task : tasks) {
    const auto content = distrusted.contains(task.node) ? std::nullopt : cache.find(task.key);
    if (!content) {
      recall.missing.push_back(task);
      continue;
    }
    std::istringstream in(*content);
    try {
      guarded(plan.nodes[task.node].name, std::nullopt, [&] { task.learner->load(in); });
    } catch (const Error&) {
      // whole, yet not what the plugin expects: the object may be half filled, so it can't go on
      cache.remove(task.key);
      recall.refused_node = task.node;
      return recall;
    }
  }
  return recall;
}

bool learn_models(const std::vector<LearningTask>& tasks, const ExecutionPlan& plan,
                  FrameReader& reader, int threads, Progress& progress) {
  std::vector<Pupil> pupils = pupils_of(tasks, plan, reader);
  if (!pupils.empty()) {
    Pass pass(pupils, plan, reader);
    FrameLoop loop;
    loop.read = [&](FrameState& state) { return pass.read(state); };
    for (std::size_t p = 0; p < pupils.size(); ++p) {
      loop.stages.push_back(
          {.ordered = true, .work = [&pass, p](FrameState& s) { pass.learn(p, s); }});
    }
    loop.done = [&](FrameState& state) {
      state.slots.clear();
      progress.tick();
    };
    progress.begin("learn", std::nullopt);
    const LoopEnd end = run_frames(loop, threads);
    progress.end();
    if (end.fault) std::rethrow_exception(end.fault);
  }
  if (stop_requested()) return false;
  for (const LearningTask& task : tasks) {
    const auto pupil = std::find_if(pupils.begin(), pupils.end(),
                                    [&](const Pupil& p) { return p.task->node == task.node; });
    const std::int64_t seen = pupil == pupils.end() ? 0 : pupil->seen;
    guarded(plan.nodes[task.node].name, std::nullopt, [&] { task.learner->finish(seen); });
  }
  return true;
}

std::vector<std::string> store_models(const std::vector<LearningTask>& tasks,
                                      const ExecutionPlan& plan, const ModelCache& cache) {
  std::vector<std::string> notes;
  for (const LearningTask& task : tasks) {
    std::ostringstream out;
    guarded(plan.nodes[task.node].name, std::nullopt, [&] { task.learner->save(out); });
    try {
      cache.store(task.key, std::move(out).str());
    } catch (const UserError& error) {
      notes.push_back("what '" + plan.nodes[task.node].name +
                      "' learned is not kept for the next run: " + error.what());
    }
  }
  return notes;
}

}  // namespace plaza
