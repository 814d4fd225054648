// Preparation and detection on every fifth frame of PETS 2009 S2.L1, View 001, decoded beforehand:
// pipelines/pets-s2l1.json with everything on, and the thesis's form, pets-s2l1-edges.json.
// Frames are worked on at once by two threads, as the executor does it. Of several turns over the
// frames the fastest counts, since other work on the machine can only make a turn slower.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "framework/config/pipeline.h"
#include "framework/execution/frame_loop.h"
#include "framework/execution/frame_reader.h"
#include "framework/execution/learn.h"
#include "framework/execution/plan.h"
#include "framework/plugin/loader.h"
#include "plugins/detectors/hierarchical-grid/hierarchical_grid.h"
#include "tests/support/into_registry.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

constexpr int kThreads = 2;
constexpr std::int64_t kEvery = 5;  // of 795 frames, 160 in 200 MB

double seconds_of(clockid_t clock) {
  std::timespec now = {};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// All plugins of the build tree; the detector is linked in, so that its search can be asked.
const Registry& registry() {
  static const Registry kRegistry = [] {
    Registry r;
    test::IntoRegistry(r).add<HierarchicalGrid>();
    for (const fs::path& library :
         find_plugins({fs::path(PLAZA_BINARY_DIR) / "lib" / "plaza" / "plugins"})) {
      if (library.filename() != "plaza_hierarchical_grid.so") load_plugin(library, r);
    }
    return r;
  }();
  return kRegistry;
}

/// The pipeline, taught, with its decoded frames.
class Pets {
 public:
  Pets(const std::string& pipeline, const std::vector<std::string>& sets)
      : resolved_(read_pipeline_in_scene(
            {.file = fs::path(PLAZA_SOURCE_DIR) / "pipelines" / pipeline, .sets = sets},
            registry())),
        assembly_(assemble(resolved_.pipeline, resolved_.scene, fs::temp_directory_path())),
        plan_(make_plan(resolved_.pipeline, assembly_)) {
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
      const std::string& name = plan_.nodes[i].name;
      if (name == "color" || name == "edges" || name == "detector") nodes_.push_back(i);
    }
    if (!nodes_.empty()) {
      detector_ = dynamic_cast<const HierarchicalGrid*>(plan_.nodes[nodes_.back()].node.get());
    }
    if (detector_ == nullptr) {
      throw InternalError(pipeline + " has no ground grid any more");
    }
    FrameReader reader(plan_, *resolved_.scene);
    reader.open();
    Progress quiet(ProgressStyle::kQuiet);
    learn_models(learning_tasks(plan_, resolved_.pipeline, *resolved_.scene), plan_, reader,
                 kThreads, quiet);
    reader.seek(0);
    for (FrameState state; reader.read_clock(state);) {
      if (state.frame % kEvery == 0) frames_.push_back(state.slots[frames_slot()]);
    }
  }

  std::size_t size() const { return frames_.size(); }

  /// All frames through both nodes, by the executor's loop.
  void run(const std::function<void(const FrameState&)>& done) const {
    std::size_t next = 0;
    FrameLoop loop;
    loop.read = [&](FrameState& state) {
      if (next == frames_.size()) return false;
      const auto frame = static_cast<std::int64_t>(next) * kEvery;
      state.reset(frame, resolved_.scene->time_of_frame(frame), plan_.slot_count,
                  plan_.nodes.size());
      state.slots[frames_slot()] = frames_[next++];
      return true;
    };
    for (const std::size_t index : nodes_) {
      const PlannedNode& node = plan_.nodes[index];
      loop.stages.push_back({.ordered = node.memory, .work = [&node](FrameState& state) {
                               NodeIo io(state.frame, state.time_ns, state.slots.data(),
                                         node.inputs, node.outputs);
                               node.node->process(io);
                             }});
    }
    loop.done = [&](FrameState& state) {
      done(state);
      state.slots.clear();
    };
    const LoopEnd end = run_frames(loop, kThreads);
    if (end.fault) std::rethrow_exception(end.fault);
  }

  /// The search alone in a frame that run() has been through.
  SearchResult search(const FrameState& state) const {
    const PlannedNode& node = plan_.nodes[nodes_.back()];
    std::vector<PayloadPtr> slots = state.slots;
    return detector_->search(
        NodeIo(state.frame, state.time_ns, slots.data(), node.inputs, node.outputs));
  }

 private:
  std::size_t frames_slot() const { return static_cast<std::size_t>(plan_.frames_slot); }

  PipelineInScene resolved_;
  Assembly assembly_;
  ExecutionPlan plan_;
  std::vector<std::size_t> nodes_;  ///< modalities, detector
  const HierarchicalGrid* detector_ = nullptr;
  std::vector<PayloadPtr> frames_;
};

/// Calls `work` with the taught pipeline on two threads; where something is missing, such as the
/// video, the benchmark is skipped and says what.
template <class Work>
void with_pets(benchmark::State& state, const std::string& pipeline,
               const std::vector<std::string>& sets, const Work& work) {
  cv::setNumThreads(1);
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism, kThreads);
  tbb::task_arena arena(kThreads);
  try {
    arena.execute([&] { work(Pets(pipeline, sets)); });
  } catch (const UserError& error) {
    state.SkipWithError(("can't run " + pipeline + ": " + error.what()).c_str());
  }
}

constexpr const char* kThesisForm = "pets-s2l1-edges.json";

void frame_rate(benchmark::State& state, const std::string& pipeline, const char* figure) {
  with_pets(state, pipeline, {}, [&](const Pets& pets) {
    double best_s = std::numeric_limits<double>::infinity();
    double least_cpu_s = best_s;
    std::size_t people = 0;
    for ([[maybe_unused]] auto _ : state) {
      people = 0;
      const double begin_s = seconds_of(CLOCK_MONOTONIC);
      const double begin_cpu_s = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
      pets.run([&](const FrameState& frame) {
        for (const PayloadPtr& payload : frame.slots) {
          if (const auto* found = dynamic_cast<const Observations*>(payload.get())) {
            people += found->items.size();
          }
        }
      });
      best_s = std::min(best_s, seconds_of(CLOCK_MONOTONIC) - begin_s);
      least_cpu_s = std::min(least_cpu_s, seconds_of(CLOCK_PROCESS_CPUTIME_ID) - begin_cpu_s);
    }
    const auto frames = static_cast<double>(pets.size());
    state.counters[figure] = frames / best_s;
    state.counters["processor_ms_per_set"] = 1e3 * least_cpu_s / frames;
    state.counters["people_per_set"] = static_cast<double>(people) / frames;
  });
}

/// How many silhouettes the hierarchy leaves out, and what one costs that it compares. The only
/// view sees every cell that is counted, so that a cell is a silhouette.
void cells(benchmark::State& state, const std::vector<std::string>& sets, const char* saved,
           const char* microseconds) {
  with_pets(state, kThesisForm, sets, [&](const Pets& pets) {
    double evaluated = 0, exhaustive = 0, cpu_s = 0;
    for ([[maybe_unused]] auto _ : state) {
      pets.run([&](const FrameState& frame) {
        const double begin_s = seconds_of(CLOCK_THREAD_CPUTIME_ID);
        SearchResult result;
        tbb::task_arena(1).execute([&] { result = pets.search(frame); });
        cpu_s += seconds_of(CLOCK_THREAD_CPUTIME_ID) - begin_s;
        evaluated += static_cast<double>(result.evaluated);
        exhaustive += static_cast<double>(result.exhaustive);
      });
    }
    const double sets_of_frames =
        static_cast<double>(state.iterations()) * static_cast<double>(pets.size());
    state.counters[saved] = exhaustive / evaluated;
    if (microseconds != nullptr) state.counters[microseconds] = 1e6 * cpu_s / evaluated;
    state.counters["evaluated_per_set"] = evaluated / sets_of_frames;
    state.counters["exhaustive_per_set"] = exhaustive / sets_of_frames;
  });
}

void as_tuned(benchmark::State& s) {
  cells(s, {}, "detector.cells_saved", "detector.us_per_silhouette");
}
void thesis_rule(benchmark::State& s) {
  cells(s, {"/nodes/detector/spread=0"}, "detector.cells_saved_without_spread", nullptr);
}
/// Cells of a quarter of the side below the same coarsest ones: what a deeper hierarchy saves.
void fine_grid(benchmark::State& s) {
  cells(s, {"/nodes/detector/cells=320", "/nodes/detector/levels=5", "/nodes/detector/spread=0"},
        "detector.cells_saved_fine_grid", nullptr);
}

// named after their figures, so that a filter finds them
BENCHMARK_CAPTURE(frame_rate, full, "pets-s2l1.json", "detector.pets.fps")
    ->Name("detector.pets.fps")
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame_rate, edges, kThesisForm, "detector.pets_edges.fps")
    ->Name("detector.pets_edges.fps")
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(as_tuned)
    ->Name("detector.cells_saved,detector.us_per_silhouette")
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(thesis_rule)
    ->Name("detector.cells_saved_without_spread")
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(fine_grid)
    ->Name("detector.cells_saved_fine_grid")
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plaza
