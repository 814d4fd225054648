// Whatever a study says, reading and expanding it ends with a study that keeps its promises or with
// a UserError whose every diagnostic has a message and a place; never with another exception, a
// crash or endless work. The pipelines of its first runs are read as well; nothing is run.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

#include "framework/config/pipeline.h"
#include "framework/study/expand.h"
#include "framework/study/study.h"
#include "plaza/core/error.h"
#include "tests/fuzz/require.h"
#include "tests/support/test_components.h"

namespace {

using plaza::fuzz::require;

constexpr std::size_t kReadRuns = 4;
constexpr std::size_t kExpandedRuns = 2000;

void check(const plaza::UserError& error) {
  for (const plaza::Diagnostic& diagnostic : error.diagnostics()) {
    require(!diagnostic.message.empty(), "diagnostic without a message");
  }
}

/// The number of runs.
std::size_t check(const plaza::Study& study) {
  require(!study.name.empty(), "a study without a name");
  std::set<std::string> names;
  std::size_t runs = std::max<std::size_t>(study.seeds.size(), 1);
  for (const plaza::Axis& axis : study.axes) {
    require(!axis.name.empty() && names.insert(axis.name).second,
            "an axis without a name of its own");
    require(!axis.values.empty(), "an axis without values");
    std::set<std::string> labels;
    for (const plaza::AxisValue& value : axis.values) {
      require(!value.label.empty() && labels.insert(value.label).second,
              "a value without a label of its own");
    }
    const auto compared = study.baseline.values.find(axis.name);
    require(compared == study.baseline.values.end() || labels.contains(compared->second),
            "a baseline that is no value");
    runs = std::min(runs * axis.values.size(), kExpandedRuns + 1);
  }
  return runs;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const plaza::Registry registry = plaza::test::make_registry();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  // beside the broken pipelines, where there are some to vary
  const char* const file = PLAZA_SOURCE_DIR "/tests/error/pipelines/fuzzed-study.json";
  try {
    const plaza::Study study = plaza::read_study_text(text, file);
    const std::size_t runs = check(study);
    if (runs > kExpandedRuns) return 0;
    const plaza::Expansion expansion = plaza::expand(study, registry);
    require(expansion.jobs.size() == runs, "another number of runs");
    for (std::size_t j = 0; j < std::min(runs, kReadRuns); ++j) {
      try {
        plaza::read_pipeline_in_scene(expansion.jobs[j].request, registry);
      } catch (const plaza::UserError& error) {
        check(error);
      }
    }
  } catch (const plaza::UserError& error) {
    check(error);
  }
  return 0;
}
