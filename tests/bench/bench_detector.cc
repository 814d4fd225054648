// Preparation and detection, reading excluded, with everything on and in the thesis's form:
// - every fifth frame of PETS 2009 S2.L1, View 001: pets-s2l1.json and pets-s2l1-edges.json;
// - frames of the laboratory's four-crossing in four views of 752 x 480, seed 1, in runs of four
//   so that what remembers the frame before has one: lab.json and baselines/chen2012.json.
// Frames are worked on at once by two threads, as the executor does it. Of several turns over the
// frames the fastest counts, since other work on the machine can only make a turn slower.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <limits>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "tests/bench/taught_clip.h"

namespace plaza::bench {
namespace {

constexpr Chosen kPets = {.every = 5};            // of 795 frames, 160 in 200 MB
constexpr Chosen kLab = {.every = 50, .run = 4};  // of 500 frames, 40 sets in 170 MB

double seconds_of(clockid_t clock) {
  std::timespec now = {};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Calls `work` with the taught pipeline on two threads; where something is missing, such as the
/// video, the benchmark is skipped and says what.
template <class Work>
void with_clip(benchmark::State& state, const std::string& pipeline,
               const std::vector<std::string>& sets, const Chosen& chosen, const Work& work) {
  cv::setNumThreads(1);
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism, kThreads);
  tbb::task_arena arena(kThreads);
  try {
    arena.execute([&] { work(TaughtClip(pipeline, sets, chosen)); });
  } catch (const UserError& error) {
    state.SkipWithError(("can't run " + pipeline + ": " + error.what()).c_str());
  }
}

constexpr const char* kThesisForm = "pets-s2l1-edges.json";

/// Until the baseline has a file of its own, lab.json is the thesis's form itself.
std::string lab_thesis_form() {
  const std::string own = "baselines/chen2012.json";
  return std::filesystem::exists(std::filesystem::path(PLAZA_SOURCE_DIR) / "pipelines" / own)
             ? own
             : "lab.json";
}

void frame_rate(benchmark::State& state, const std::string& pipeline, const Chosen& chosen,
                const char* figure) {
  with_clip(state, pipeline, {}, chosen, [&](const TaughtClip& clip) {
    double best_s = std::numeric_limits<double>::infinity();
    double least_cpu_s = best_s;
    std::size_t people = 0;
    for ([[maybe_unused]] auto _ : state) {
      people = 0;
      const double begin_s = seconds_of(CLOCK_MONOTONIC);
      const double begin_cpu_s = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
      clip.run([&](const FrameState& frame) {
        for (const PayloadPtr& payload : frame.slots) {
          if (const auto* found = dynamic_cast<const Observations*>(payload.get())) {
            people += found->items.size();
          }
        }
      });
      best_s = std::min(best_s, seconds_of(CLOCK_MONOTONIC) - begin_s);
      least_cpu_s = std::min(least_cpu_s, seconds_of(CLOCK_PROCESS_CPUTIME_ID) - begin_cpu_s);
    }
    const auto frames = static_cast<double>(clip.size());
    state.counters[figure] = frames / best_s;
    state.counters["processor_ms_per_set"] = 1e3 * least_cpu_s / frames;
    state.counters["people_per_set"] = static_cast<double>(people) / frames;
  });
}

/// How many silhouettes the hierarchy leaves out, and what one costs that it compares. The only
/// view sees every cell that is counted, so that a cell is a silhouette.
void cells(benchmark::State& state, const std::vector<std::string>& sets, const char* saved,
           const char* microseconds) {
  with_clip(state, kThesisForm, sets, kPets, [&](const TaughtClip& clip) {
    double evaluated = 0, exhaustive = 0, cpu_s = 0;
    for ([[maybe_unused]] auto _ : state) {
      clip.run([&](const FrameState& frame) {
        const double begin_s = seconds_of(CLOCK_THREAD_CPUTIME_ID);
        SearchResult result;
        tbb::task_arena(1).execute([&] { result = clip.search(frame); });
        cpu_s += seconds_of(CLOCK_THREAD_CPUTIME_ID) - begin_s;
        evaluated += static_cast<double>(result.evaluated);
        exhaustive += static_cast<double>(result.exhaustive);
      });
    }
    const double sets_of_frames =
        static_cast<double>(state.iterations()) * static_cast<double>(clip.size());
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
BENCHMARK_CAPTURE(frame_rate, full, "pets-s2l1.json", kPets, "detector.pets.fps")
    ->Name("detector.pets.fps")
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame_rate, edges, kThesisForm, kPets, "detector.pets_edges.fps")
    ->Name("detector.pets_edges.fps")
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame_rate, lab, "lab.json", kLab, "detector.lab.fps")
    ->Name("detector.lab.fps")
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame_rate, lab_edges, lab_thesis_form(), kLab, "detector.lab_edges.fps")
    ->Name("detector.lab_edges.fps")
    ->Iterations(5)
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
}  // namespace plaza::bench
