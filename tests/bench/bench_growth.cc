// How the processor time of preparation and detection grows with cells, cameras and pixels, in the
// thesis's form (baselines/chen2012.json) and with everything on (lab.json); and that memory
// doesn't grow with time. tests/bench/draw_growth.py draws it.
//
// Processor time, since it hardly depends on what else the machine does; of several turns over the
// frames the cheapest counts. The exponent is the slope of a line through the logarithms of cost
// and size: 1 is linear, less where a part of the cost is always there. `steepest` is the largest
// slope from one size to the next, which the fixed part can't hide as easily.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "plaza/core/error.h"
#include "tests/bench/scaled_laboratory.h"
#include "tests/bench/taught_clip.h"

namespace plaza::bench {
namespace {

constexpr int kTurns = 3;

/// One place of a curve: how large something is, and the pipelines that have it so, whose mean
/// counts.
struct Size {
  double size = 0;
  std::vector<LaboratoryPart> parts;
  std::vector<std::string> sets;
};

ScaledLaboratory& laboratory() {
  static ScaledLaboratory lab;
  return lab;
}

double processor_s() {
  std::timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Calls `work` as an executor of two threads would be called; faults skip the benchmark.
template <class Work>
void on_threads(benchmark::State& state, const Work& work) {
  cv::setNumThreads(1);
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism, kThreads);
  tbb::task_arena arena(kThreads);
  try {
    arena.execute(work);
  } catch (const UserError& error) {
    state.SkipWithError(error.what());
  }
}

double ms_per_set(const TaughtClip& clip) {
  double least_s = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < kTurns; ++turn) {
    const double begin_s = processor_s();
    clip.run([](const FrameState&) {});
    least_s = std::min(least_s, processor_s() - begin_s);
  }
  return 1e3 * least_s / static_cast<double>(clip.size());
}

void grow(benchmark::State& state, const std::string& pipeline, const std::vector<Size>& sizes,
          const std::string& figure) {
  on_threads(state, [&] {
    for ([[maybe_unused]] auto _ : state) {
      std::vector<double> x, y;
      for (const Size& size : sizes) {
        double ms = 0;
        for (const LaboratoryPart& part : size.parts) {
          const TaughtClip clip(laboratory().pipeline(pipeline, part).string(), size.sets,
                                kScaledFrames);
          ms += ms_per_set(clip) / static_cast<double>(size.parts.size());
        }
        state.counters["ms at " + std::to_string(std::llround(size.size))] = ms;
        x.push_back(std::log(size.size));
        y.push_back(std::log(ms));
      }
      const auto n = static_cast<double>(x.size());
      double sx = 0, sy = 0, sxx = 0, sxy = 0, steepest = -std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < x.size(); ++i) {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        sxy += x[i] * y[i];
        if (i > 0) steepest = std::max(steepest, (y[i] - y[i - 1]) / (x[i] - x[i - 1]));
      }
      state.counters[figure] = (n * sxy - sx * sy) / (n * sxx - sx * sx);
      state.counters["steepest"] = steepest;
    }
  });
}

std::vector<Size> over_cells() {
  std::vector<Size> out;
  for (const int side : {20, 28, 40, 56, 80, 120}) {
    out.push_back({.size = static_cast<double>(side * side),
                   .parts = {{}},
                   .sets = {"/nodes/detector/cells=" + std::to_string(side)}});
  }
  return out;
}

/// Each camera has its part in each number of them: what one sees costs more than what another
/// does.
std::vector<Size> over_cameras() {
  constexpr std::size_t kAll = 4;
  std::vector<Size> out;
  for (std::size_t cameras = 1; cameras <= kAll; ++cameras) {
    Size& size = out.emplace_back();
    size.size = static_cast<double>(cameras);
    for (std::size_t first = 0; first < (cameras < kAll ? kAll : 1); ++first) {
      size.parts.push_back({.cameras = cameras, .first = first});
    }
  }
  return out;
}

/// A quarter of the side to all of it, so that pixels grow by two from one to the next.
std::vector<Size> over_pixels() {
  std::vector<Size> out;
  for (const int width : {188, 266, 376, 532, 752}) {
    const auto height = static_cast<double>(std::lround(width * 480 / 752.0));
    out.push_back({.size = width * height, .parts = {{.width_px = width}}, .sets = {}});
  }
  return out;
}

double resident_mb() {
  std::ifstream in("/proc/self/statm");
  double all = 0, resident = 0;
  in >> all >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// The same frames again and again, with everything on, in small images: what the process holds at
/// most until its 100th frame set, and until its 1000th.
void memory(benchmark::State& state) {
  on_threads(state, [&] {
    const TaughtClip clip(laboratory().pipeline("lab.json", {.width_px = 188}).string(), {},
                          kScaledFrames);
    for ([[maybe_unused]] auto _ : state) {
      double most_mb = 0, after_100_mb = 0;
      for (std::size_t frames = 0; frames < 1000;) {
        clip.run([&](const FrameState&) {
          most_mb = std::max(most_mb, resident_mb());
          if (++frames == 100) after_100_mb = most_mb;
        });
      }
      state.counters["mb_after_100"] = after_100_mb;
      state.counters["mb_after_1000"] = most_mb;
      state.counters["detector.growth.memory"] = most_mb / after_100_mb;
    }
  });
}

// first, before anything else has left free memory behind
BENCHMARK(memory)->Name("detector.growth.memory")->Iterations(1)->Unit(benchmark::kMillisecond);

#define PLAZA_GROWTH(form, pipeline, what)                        \
  BENCHMARK_CAPTURE(grow, form##_##what, pipeline, over_##what(), \
                    "detector.growth." #form "." #what)           \
      ->Name("detector.growth." #form "." #what)                  \
      ->Iterations(1)                                             \
      ->Unit(benchmark::kMillisecond)

PLAZA_GROWTH(thesis, "baselines/chen2012.json", cells);
PLAZA_GROWTH(thesis, "baselines/chen2012.json", cameras);
PLAZA_GROWTH(thesis, "baselines/chen2012.json", pixels);
PLAZA_GROWTH(lab, "lab.json", cells);
PLAZA_GROWTH(lab, "lab.json", cameras);
PLAZA_GROWTH(lab, "lab.json", pixels);

}  // namespace
}  // namespace plaza::bench
