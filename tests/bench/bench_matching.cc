// What it costs to compare silhouettes with what a modality saw, and to take some away: a person in
// every cell of a ground grid of 40 x 40 in the laboratory, in four views of 752 x 480, on one
// core. Processor time, since other work on the machine is not ours.
#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "modalities/edges/evidence.h"
#include "modalities/edges/templates.h"
#include "models/cylinder/cylinder.h"
#include "tests/bench/taught_clip.h"

namespace plaza::bench {
namespace {

double processor_seconds() {
  std::timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<Pose> everywhere(const Scene& scene) {
  std::vector<Pose> poses;
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 40; ++column) {
      const Eigen::Vector2d share((column + 0.5) / 40, (row + 0.5) / 40);
      const Eigen::Vector2d extent = scene.area.max_m - scene.area.min_m;
      poses.push_back({scene.area.min_m + share.cwiseProduct(extent), 0, 1});
    }
  }
  return poses;
}

constexpr double kGatePx = 15;  // three times the pipeline's sigma_px

/// One frame of the laboratory, as a modality sees it and a person everywhere in it.
struct Room {
  explicit Room(const std::string& name)
      : clip("../tests/bench/matching.json", {}, {.every = 1000}) {
    BuildContext context;
    context.scene = std::make_shared<const Scene>(clip.scene());
    Cylinder::Options slim;
    slim.torso_radius_m = 0.22;
    slim.legs_radius_m = 0.16;
    const Cylinder shape(slim, context);
    const std::vector<Pose> poses = everywhere(clip.scene());
    modality = &clip.modality(name);
    for (std::size_t c = 0; c < clip.scene().cameras.size(); ++c) {
      evidence.push_back(modality->prepare(clip.image(0, c), c).evidence);
      templates.push_back(modality->sample(shape, poses, c));
    }
  }
  TaughtClip clip;
  const Modality* modality = nullptr;
  std::vector<EvidencePtr> evidence;                      ///< [camera]
  std::vector<std::unique_ptr<TemplateBatch>> templates;  ///< [camera]
};

const Room& room_of(const std::string& modality) {
  static std::map<std::string, Room> rooms;
  return rooms.try_emplace(modality, modality).first->second;
}

void match(benchmark::State& state, const char* name, const char* figure) {
  tbb::task_arena arena(1);
  arena.execute([&] {
    const Room& room = room_of(name);
    double least_s = std::numeric_limits<double>::infinity();
    std::vector<double> values(room.templates.front()->size());
    for ([[maybe_unused]] auto _ : state) {
      std::vector<EvidencePtr> fresh;  // since evidence remembers what it was asked
      for (std::size_t c = 0; c < room.evidence.size(); ++c) {
        fresh.push_back(room.modality->prepare(room.clip.image(0, c), c).evidence);
      }
      const double begin_s = processor_seconds();
      for (std::size_t c = 0; c < room.evidence.size(); ++c) {
        room.modality->match(*fresh[c], *room.templates[c], values);
        benchmark::DoNotOptimize(values.data());
      }
      least_s = std::min(least_s, processor_seconds() - begin_s);
    }
    std::size_t told = 0;
    for (std::size_t c = 0; c < room.evidence.size(); ++c) {
      room.modality->match(*room.evidence[c], *room.templates[c], values);
      told += static_cast<std::size_t>(
          std::count_if(values.begin(), values.end(), [](double v) { return v == v; }));
    }
    state.counters[figure] = 1e6 * least_s / static_cast<double>(told);
    state.counters["told"] = static_cast<double>(told);
  });
}

/// How much of the contours would have to be read if matching might stop as soon as what has been
/// read rules out a value of `over_median` above the view's median, which is what a detector needs
/// of a person: direction by direction, whose sums are whole then.
void abandon(benchmark::State& state, double over_median, const char* figure) {
  const Room& room = room_of("edges");
  double read = 0, all = 0;
  for ([[maybe_unused]] auto _ : state) {
    read = all = 0;
    for (std::size_t c = 0; c < room.evidence.size(); ++c) {
      const auto& templates = dynamic_cast<const edges::EdgeTemplates&>(*room.templates[c]);
      const auto& evidence = dynamic_cast<const edges::EdgeEvidence&>(*room.evidence[c]);
      std::vector<double> values(templates.size());
      room.modality->match(evidence, templates, values);
      std::vector<double> known;
      for (const double v : values) {
        if (v == v) known.push_back(v);
      }
      std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2),
                       known.end());
      const double bound = known[known.size() / 2] + over_median;
      const auto& directions = templates.layout()->directions();
      std::vector<edges::ContourSum> sums(directions.size());
      for (std::size_t i = 0; i < templates.size(); ++i) {
        if (!templates.tells(i)) continue;
        const edges::ContourRuns runs = templates.runs(i);
        edges::sum_contour_versions().back().run(evidence.block().planes.data(), runs, sums.data());
        const double total = values[i];
        double cost = 0, whole = 0;
        for (std::size_t d = 0; d < directions.size(); ++d) {
          whole +=
              static_cast<double>(sums[d].squares) * directions[d].step_px * directions[d].step_px +
              static_cast<double>(sums[d].outliers) * kGatePx * kGatePx;
        }
        for (std::size_t d = 0; d < directions.size(); ++d) {
          all += runs.counts[d];
          // the share of the template's value that has been read is a bound of it from above
          if (whole > 0 && total * cost / whole < bound) continue;
          read += runs.counts[d];
          cost +=
              static_cast<double>(sums[d].squares) * directions[d].step_px * directions[d].step_px +
              static_cast<double>(sums[d].outliers) * kGatePx * kGatePx;
        }
      }
    }
  }
  state.counters[figure] = read / all;
}

void explain(benchmark::State& state, const char* name, const char* figure) {
  tbb::task_arena arena(1);
  arena.execute([&] {
    const Room& room = room_of(name);
    const std::vector<std::uint32_t> person = {40 * 20 + 20};
    double least_s = std::numeric_limits<double>::infinity();
    for ([[maybe_unused]] auto _ : state) {
      const double begin_s = processor_seconds();
      for (std::size_t c = 0; c < room.evidence.size(); ++c) {
        benchmark::DoNotOptimize(
            room.modality->explain(room.evidence[c], *room.templates[c], person));
      }
      least_s = std::min(least_s, processor_seconds() - begin_s);
    }
    state.counters[figure] = 1e6 * least_s / static_cast<double>(room.evidence.size());
  });
}

BENCHMARK_CAPTURE(match, edges, "edges", "edges.us_per_template")
    ->Name("edges.us_per_template")
    ->Iterations(30)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(match, color, "color", "color.us_per_template")
    ->Name("color.us_per_template")
    ->Iterations(30)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(abandon, thesis, 1.6, "edges.read_share_at_bound")
    ->Name("edges.read_share_at_bound")
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(explain, edges, "edges", "edges.explain_us_per_view")
    ->Name("edges.explain_us_per_view")
    ->Iterations(30)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(explain, color, "color", "color.explain_us_per_view")
    ->Name("color.explain_us_per_view")
    ->Iterations(30)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plaza::bench
