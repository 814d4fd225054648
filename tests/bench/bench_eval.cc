// A whole evaluation, from the files to the last figure.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "plaza/io/mot_rows.h"
#include "plaza/scoring/mot_challenge.h"
#include "plaza/scoring/sections.h"

namespace plaza {
namespace {

std::filesystem::path data_folder() {
  const char* data = std::getenv("PLAZA_DATA");
  return data != nullptr ? std::filesystem::path(data)
                         : std::filesystem::path(PLAZA_SOURCE_DIR) / ".." / "shared" / "data";
}

void evaluate_mot17_09(benchmark::State& state) {
  const std::filesystem::path folder = data_folder() / "eval-cases" / "mot17-09-lift-sdp";
  if (!std::filesystem::exists(folder)) {
    state.SkipWithError(("no such case: " + folder.string()).c_str());
    return;
  }
  const auto rows_of = [&folder](const char* name) {
    const std::string file = (folder / name).string();
    return MotFile{file, read_mot_rows(file, {.last_frame = 525})};
  };
  double seconds = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const PairedSequence similarity =
        pair_mot_rows(rows_of("gt.txt"), rows_of("result.txt"), MotRules::kMot17);
    benchmark::DoNotOptimize(image_detection_section(similarity, 0.5));
    benchmark::DoNotOptimize(image_tracking_section(similarity, 0.5));
    benchmark::DoNotOptimize(thesis_section(&similarity, &similarity, 0.3));
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  state.counters["eval.mot17_09.seconds"] = seconds / static_cast<double>(state.iterations());
}
BENCHMARK(evaluate_mot17_09)->Name("eval.mot17_09.seconds")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plaza
