// What a frame set of the laboratory costs: four views of 752 x 480 with the truth about them, as
// the source "synthetic" gives them frame by frame, shadows, reflections and antialiasing on.
// Frames are those of a whole clip, evenly chosen.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <limits>
#include <opencv2/core/utility.hpp>
#include <string>

#include "framework/scene/scene_file.h"
#include "plugins/sources/synthetic/laboratory.h"

namespace plaza::synthetic {
namespace {

constexpr int kThreads = 2;
constexpr std::int64_t kFrames = 500;
constexpr std::int64_t kEvery = 25;

double seconds_of(clockid_t clock) {
  std::timespec now = {};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// `figures`: "laboratory" or "laboratory.NAME", what the counters' names begin with.
void render(benchmark::State& state, const std::string& scenario, const std::string& figures) {
  cv::setNumThreads(1);
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism, kThreads);
  tbb::task_arena arena(kThreads);
  arena.execute([&] {
    const auto scene =
        read_scene(std::filesystem::path(PLAZA_SOURCE_DIR) / "pipelines" / "scenes" / "lab.json");
    LaboratoryOptions options;
    options.scenario = scenario;
    options.duration_s = static_cast<double>(kFrames) / scene->frame_rate_hz;
    const double setup_s = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    const Laboratory laboratory(options, scene);
    state.counters[figures + ".setup_cpu_seconds"] = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - setup_s;
    double best_s = std::numeric_limits<double>::infinity();
    double least_cpu_s = best_s;
    double people = 0;
    for ([[maybe_unused]] auto _ : state) {
      people = 0;
      const double begin_s = seconds_of(CLOCK_MONOTONIC);
      const double begin_cpu_s = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
      for (std::int64_t frame = 0; frame < kFrames; frame += kEvery) {
        people += static_cast<double>(laboratory.people(frame).size());
        benchmark::DoNotOptimize(laboratory.images(frame));
      }
      best_s = std::min(best_s, seconds_of(CLOCK_MONOTONIC) - begin_s);
      least_cpu_s = std::min(least_cpu_s, seconds_of(CLOCK_PROCESS_CPUTIME_ID) - begin_cpu_s);
    }
    constexpr double kSets = static_cast<double>(kFrames) / static_cast<double>(kEvery);
    state.counters[figures + ".frame_sets_per_second"] = kSets / best_s;
    state.counters[figures + ".cpu_ms_per_frame_set"] = 1e3 * least_cpu_s / kSets;
    state.counters["people_per_set"] = people / kSets;
  });
}

void four(benchmark::State& s) { render(s, "four-crossing", "laboratory"); }
void six(benchmark::State& s) { render(s, "six-targets", "laboratory.six_targets"); }

// named after their figures, so that a filter finds them
BENCHMARK(four)
    ->Name("laboratory.frame_sets_per_second,laboratory.cpu_ms_per_frame_set")
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(six)
    ->Name(
        "laboratory.six_targets.frame_sets_per_second,"
        "laboratory.six_targets.cpu_ms_per_frame_set")
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plaza::synthetic
