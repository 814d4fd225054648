// What the kernel costs per node and frame: long pipelines of nodes that do nothing but take a
// payload and hand one on, against the same frames without them, in one run.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "framework/config/pipeline.h"
#include "framework/execution/run.h"
#include "plaza/component/declaration.h"
#include "tests/support/into_registry.h"

namespace plaza {
namespace {

constexpr std::int64_t kFrames = 20000;

class NoImages : public Source {
 public:
  struct Options {};
  static Declaration<Options> declare() {
    return Declaration<Options>("bench-source", "Gives frame sets without images.")
        .output<FrameSet>("empty")
        .output<Observations>("nobody");
  }
  NoImages(const Options&, const BuildContext&) {}

 private:
  SourceInfo do_open() override { return {.frame_count = kFrames, .rereadable = true}; }
  void do_seek(std::int64_t) override {}
  bool do_read(NodeIo& io) override {
    if (io.frame() == kFrames) return false;
    auto frames = std::make_shared<FrameSet>();
    frames->frame = io.frame();
    io.out(0, std::move(frames));
    io.out(1, std::make_shared<Observations>());
    return true;
  }
};

/// Takes observations and hands on a new payload of them.
template <bool kMemory>
class NoOperation : public Describer {
 public:
  struct Options {};
  static Declaration<Options> declare() {
    Declaration<Options> declaration(kMemory ? "bench-memory" : "bench-describer", "Does nothing.");
    declaration.template input<Observations>("people").template output<Observations>("the same");
    if (kMemory) declaration.memory();
    return declaration;
  }
  NoOperation(const Options&, const BuildContext&) {}

 private:
  void do_describe(const NodeIo&, Observations&) override {}
};

struct Folder {
  Folder()
      : path(std::filesystem::temp_directory_path() /
             ("plaza-bench-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path);
    write("scene.json", "{}");
  }
  ~Folder() { std::filesystem::remove_all(path); }
  void write(const std::string& name, const std::string& text) const {
    if (std::FILE* file = std::fopen((path / name).c_str(), "w")) {
      std::fputs(text.c_str(), file);
      std::fclose(file);
    }
  }
  std::filesystem::path path;
};

/// Seconds that a run of `nodes` no-ops takes; with memory every second one has some.
double seconds_of(int nodes, bool memory, int threads) {
  static const Folder folder;
  Registry registry;
  test::IntoRegistry registrar(registry);
  registrar.add<NoImages>();
  registrar.add<NoOperation<false>>();
  registrar.add<NoOperation<true>>();
  nlohmann::json pipeline = {{"plaza", 1}, {"name", "bench"}, {"scene", "scene.json"}};
  pipeline["nodes"].push_back({{"use", "bench-source"}, {"name", "cameras"}});
  for (int i = 0; i < nodes; ++i) {
    pipeline["nodes"].push_back({{"use", memory && i % 2 == 1 ? "bench-memory" : "bench-describer"},
                                 {"name", "node" + std::to_string(i)}});
  }
  const ResolvedPipeline resolved = read_pipeline_text(
      pipeline.dump(), {.file = folder.path / "pipeline.json", .sets = {}}, registry);
  auto scene = std::make_shared<Scene>();
  scene->frame_rate_hz = 25;
  RunOptions options;
  options.output_folder = folder.path / "out";
  options.cache_folder = folder.path / "cache";
  options.threads = threads;
  options.progress = ProgressStyle::kQuiet;
  return run_pipeline(resolved, scene, options).seconds;
}

/// The cost per node and frame, in microseconds: two lengths of pipeline, one after the other.
void overhead(benchmark::State& state, const char* figure, bool memory, int threads) {
  constexpr int kNodes = 32;
  double with_nodes = 0;
  double without = 0;
  for ([[maybe_unused]] auto _ : state) {
    with_nodes += seconds_of(kNodes, memory, threads);
    without += seconds_of(0, memory, threads);
  }
  const double runs = static_cast<double>(state.iterations());
  state.counters[figure] =
      (with_nodes - without) / runs / kNodes / static_cast<double>(kFrames) * 1e6;
}

// named after their figures, so that a filter finds them
void sequential(benchmark::State& s) { overhead(s, "kernel.node_us_sequential", false, 1); }
void parallel(benchmark::State& s) { overhead(s, "kernel.node_us_parallel", true, 2); }

BENCHMARK(sequential)
    ->Name("kernel.node_us_sequential")
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(parallel)
    ->Name("kernel.node_us_parallel")
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace plaza
