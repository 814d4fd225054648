#include "framework/execution/run.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <opencv2/core/utility.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "framework/cache/bytes.h"
#include "framework/cache/node_cache.h"
#include "framework/execution/evaluate.h"
#include "framework/execution/frame_loop.h"
#include "framework/execution/frame_reader.h"
#include "framework/execution/guard.h"
#include "framework/execution/learn.h"
#include "framework/execution/missing_views.h"
#include "framework/execution/plan.h"
#include "framework/execution/progress.h"
#include "framework/execution/render.h"
#include "framework/execution/reuse.h"
#include "framework/execution/run_faults.h"
#include "framework/execution/run_output.h"
#include "framework/execution/stop.h"
#include "framework/results/branches.h"
#include "framework/results/summary.h"
#include "plaza/core/error.h"
#include "plaza/data/frames.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/track.h"

namespace plaza {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// One run from its check to its last file.
class Run {
 public:
  Run(const ResolvedPipeline& pipeline, std::shared_ptr<const Scene> scene,
      const RunOptions& options, int threads)
      : pipeline_(pipeline),
        scene_(std::move(scene)),
        options_(options),
        threads_(threads),
        cache_(options.cache_folder),
        node_cache_(options.cache_folder,
                    options.cache_limit_bytes.value_or(default_cache_limit(options.cache_folder)),
                    feature_loaders(pipeline)),
        progress_(options.progress),
        output_(pipeline, *scene_, options) {}

  RunReport execute() {
    check();
    open_output();
    if (!stopped_ && faults_.attempt([this] { learn(); }) && !stopped_) {
      stream();
      flush();
      if (!ended()) render();
      if (!faults_.any()) faults_.attempt([this] { evaluate(); });
    }
    finish();
    output_.write({.frame = end_frame_, .stopped = stopped_}, missing_views_, *reuse_, faults_);
    faults_.rethrow();
    return std::move(report_);
  }

 private:
  bool ended() const { return faults_.any() || stopped_; }

  void check() {
    if (options_.first_frame < 0 ||
        (options_.end_frame && *options_.end_frame <= options_.first_frame)) {
      throw UserError("the range of frames is empty; --frames A:B needs 0 <= A < B");
    }
    assembly_ = assemble(pipeline_, scene_, options_.output_folder);
    plan_ = make_plan(pipeline_, assembly_);
    branches_ = find_branches(pipeline_);
    let_work();
    tasks_ = learning_tasks(plan_, pipeline_, *scene_);
    recall();
    reader_.open(!missing_.empty());
    if (const auto count = reader_.frame_count(); count && options_.first_frame >= *count) {
      throw UserError("--frames begins at " + std::to_string(options_.first_frame) + ", but '" +
                      plan_.nodes[plan_.clock].name + "' has only " + std::to_string(*count) +
                      " frames (0 to " + std::to_string(*count - 1) + ")");
    }
  }

  /// Says who has to be called at all.
  void let_work() {
    reuse_ = std::make_unique<Reuse>(node_cache_, options_);
    stopped_ = !reuse_->begin(plan_, branches_, pipeline_, *scene_);
  }

  /// Takes what was learned before from the cache; what a plugin will not take is learned again.
  void recall() {
    std::set<std::size_t> distrusted;
    while (true) {
      const Recall recall = recall_models(tasks_, plan_, cache_, distrusted);
      if (!recall.refused_node) {
        missing_ = recall.missing;
        return;
      }
      distrusted.insert(*recall.refused_node);
      assembly_ = assemble(pipeline_, scene_, options_.output_folder);
      plan_ = make_plan(pipeline_, assembly_);
      let_work();
      tasks_ = learning_tasks(plan_, pipeline_, *scene_);
    }
  }

  void open_output() {
    output_.open(plan_, branches_);
    draws_.assign(plan_.nodes.size(), false);
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) add_render_task(i);
  }

  void add_render_task(std::size_t index) {
    const PlannedNode& node = plan_.nodes[index];
    auto* const renderer = dynamic_cast<Renderer*>(node.node.get());
    if (renderer == nullptr || !node.works) return;
    RenderTask task{.node = index, .renderer = renderer, .tracks = {}, .ground_truth = {}};
    const ComponentDeclaration& declaration = node.resolved->entry->declaration;
    if (const auto input = input_of_type(declaration, Tracks::kPort)) {
      task.tracks = output_.recorder().tracks_in(node.inputs.at(*input));
    }
    if (const auto input = input_of_type(declaration, GroundTruth::kPort)) {
      task.ground_truth_slot = node.inputs.at(*input);
    }
    renderers_.push_back(std::move(task));
    draws_[index] = true;
  }

  void learn() {
    if (!renderers_.empty() || !missing_.empty()) reader_.keep(options_.output_folder);
    if (missing_.empty()) return;
    if (!learn_models(missing_, plan_, reader_, threads_, progress_)) {
      stopped_ = true;
      return;
    }
    report_.notes = store_models(missing_, plan_, cache_);
  }

  void stream() {
    end_frame_ = options_.first_frame;
    if (reuse_->replay_end()) {
      reader_.replay_clock(*reuse_->replay_end(),
                           [this](FrameState& state) { reuse_->replay_node(plan_.clock, state); });
    }
    if (!faults_.attempt([this] { reader_.seek(options_.first_frame); })) return;
    FrameLoop loop;
    loop.read = [this](FrameState& state) {
      if (options_.end_frame && reader_.next() >= *options_.end_frame) return false;
      return reader_.read(state);
    };
    if (options_.reuse) {
      loop.stages.push_back(
          {.ordered = false, .work = [this](FrameState& s) { reuse_->replay(s, plan_.clock); }});
    }
    for (const ExecutionPlan::Group& group : plan_.groups) {
      loop.stages.push_back(
          {.ordered = group.memory, .work = [this, &group](FrameState& s) { process(group, s); }});
    }
    loop.done = [this](FrameState& state) { done(state); };
    loop.rest = [this](FrameState& state) { output_.recorder().add_rest(state); };

    std::optional<std::int64_t> total = reader_.frame_count();
    if (options_.end_frame)
      total = std::min(total.value_or(*options_.end_frame), *options_.end_frame);
    if (total) total = *total - options_.first_frame;
    progress_.begin("stream", total);
    const LoopEnd end = run_frames(loop, threads_);
    progress_.end();
    streamed_ = true;
    stopped_ = end.stopped;
    failed_node_ = end.failed_node;
    if (end.fault) faults_.keep(end.fault);
  }

  void process(const ExecutionPlan::Group& group, FrameState& state) const {
    auto start = SteadyClock::now();
    for (const std::size_t index : group.nodes) {
      const PlannedNode& node = plan_.nodes[index];
      if (!node.works) continue;
      state.failed_node = index;  // until it has not failed
      guarded(node.name, state.frame, [&] {
        NodeIo io(state.frame, state.time_ns, state.slots.data(), node.inputs, node.outputs);
        node.node->process(io);
      });
      const auto end = SteadyClock::now();
      state.node_ns[index] = (end - start) / std::chrono::nanoseconds(1);
      start = end;
    }
    state.failed_node.reset();
  }

  void done(FrameState& state) {
    output_.recorder().add_frame(state);
    for (std::size_t i = 0; i < timings_.size(); ++i) {
      timings_[i].seconds += 1e-9 * static_cast<double>(state.node_ns[i]);
      if (plan_.nodes[i].works && !draws_[i])
        ++timings_[i].calls;  // those that draw are counted where they do
    }
    reuse_->recordings().add(state, timings_);
    for (RenderTask& task : renderers_) {
      if (task.ground_truth_slot < 0) continue;
      task.ground_truth.push_back(state.slots[static_cast<std::size_t>(task.ground_truth_slot)]);
    }
    if (plan_.frames_slot >= 0) {
      const PayloadPtr& frames = state.slots[static_cast<std::size_t>(plan_.frames_slot)];
      if (frames) missing_views_.add(dynamic_cast<const FrameSet&>(*frames));
    }
    for (PayloadPtr& slot : state.slots) slot.reset();  // images go as soon as nobody needs them
    end_frame_ = state.frame + 1;
    ++report_.frames;
    progress_.tick();
  }

  /// Lets everything with memory give what it still holds; after a fault everything but what
  /// failed.
  void flush() {
    if (!streamed_) return;
    FrameState state;
    state.reset(end_frame_, scene_->time_of_frame(end_frame_), plan_.slot_count,
                plan_.nodes.size());
    if (!faults_.attempt([&] { reuse_->replay_flush(state); })) return;
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
      const PlannedNode& node = plan_.nodes[i];
      if (node.source != nullptr || i == failed_node_ || !node.works) continue;
      const auto start = SteadyClock::now();
      const bool good = faults_.attempt([&] {
        guarded(node.name, std::nullopt, [&] {
          NodeIo io(state.frame, state.time_ns, state.slots.data(), node.inputs, node.outputs);
          node.node->flush(io);
        });
      });
      if (!good && !failed_node_) failed_node_ = i;
      timings_[i].seconds += std::chrono::duration<double>(SteadyClock::now() - start).count();
    }
    faults_.attempt([&] { output_.recorder().add_flushed(state); });
    if (!ended()) reuse_->recordings().add_flush(state);
  }

  void render() {
    if (renderers_.empty()) return;
    std::vector<double> seconds(plan_.nodes.size(), 0);
    const RenderEnd end = render_frames(renderers_, plan_, reader_, options_.first_frame,
                                        end_frame_, threads_, seconds, progress_);
    for (const RenderTask& task : renderers_) {
      timings_[task.node].seconds += seconds[task.node];
      if (!end.fault && !end.stopped) timings_[task.node].calls = report_.frames;
    }
    stopped_ = end.stopped;
    failed_node_ = end.failed_node;
    if (end.fault) faults_.keep(end.fault);
  }

  void evaluate() {
    report_.evaluation = evaluate_branch(branches_.front(), plan_);
    for (std::size_t b = 1; b < branches_.size(); ++b) {
      if (branches_[b].evaluators.empty()) continue;
      report_.branches[branches_[b].name] = evaluate_branch(branches_[b], plan_);
    }
  }

  /// Closes what sinks and renderers hold open, so that their files are valid however the run
  /// ended.
  void finish() {
    const auto add = [this](const std::string& name, const auto& close) {
      faults_.attempt([&] {
        const std::vector<Artifact> artifacts = guarded(name, std::nullopt, close);
        report_.artifacts.insert(report_.artifacts.end(), artifacts.begin(), artifacts.end());
      });
    };
    for (const PlannedNode& node : plan_.nodes) {
      if (auto* const sink = dynamic_cast<Sink*>(node.node.get()); sink != nullptr && node.works) {
        add(node.name, [&] { return sink->finish(!ended()); });
      }
    }
    for (const RenderTask& task : renderers_) {
      if (task.begun)
        add(plan_.nodes[task.node].name, [&] { return task.renderer->end(!ended()); });
    }
  }

  const ResolvedPipeline& pipeline_;
  const std::shared_ptr<const Scene> scene_;
  const RunOptions& options_;
  const int threads_;
  const ModelCache cache_;
  const NodeCache node_cache_;
  std::unique_ptr<Reuse> reuse_;
  Progress progress_;

  Assembly assembly_;
  ExecutionPlan plan_;
  FrameReader reader_{plan_, *scene_};
  std::vector<Branch> branches_;
  std::vector<LearningTask> tasks_;
  std::vector<LearningTask> missing_;
  RunOutput output_;
  RunReport& report_ = output_.report();
  std::vector<NodeTiming>& timings_ = output_.timings();
  MissingViews missing_views_{*scene_};
  std::vector<RenderTask> renderers_;
  std::vector<bool> draws_;  ///< by node: is it a renderer

  std::int64_t end_frame_ = 0;
  bool streamed_ = false;
  bool stopped_ = false;
  RunFaults faults_;
  std::optional<std::size_t> failed_node_;
};

/// A stop that was asked for is over with the run it was meant for.
struct StopScope {
  StopScope() = default;
  ~StopScope() { clear_stop_request(); }
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;
};

}  // namespace

RunReport run_pipeline(const ResolvedPipeline& pipeline, std::shared_ptr<const Scene> scene,
                       const RunOptions& options) {
  const StopScope stop_scope;
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  // more threads than cores on request: results must not depend on the number, and tests say so
  const tbb::global_control allow(
      tbb::global_control::max_allowed_parallelism,
      static_cast<std::size_t>(std::max(threads, tbb::info::default_concurrency())));
  cv::setNumThreads(
      1);  // frames are the unit of concurrency; OpenCV's own threads would only fight
  tbb::task_arena arena(threads);
  return arena.execute([&] {
    while (true) {
      try {
        return Run(pipeline, scene, options, threads).execute();
      } catch (const DamagedEntry& damaged) {  // it goes, and is computed again
        std::error_code ignored;
        if (!std::filesystem::remove(damaged.file(), ignored)) throw;
      }
    }
  });
}

}  // namespace plaza
