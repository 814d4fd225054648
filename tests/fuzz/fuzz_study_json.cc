// Whatever a study says, reading and expanding it ends with a study that keeps its promises or with
// a UserError whose every diagnostic has a message and a place, a line that its file has; never
// with another exception, a crash or endless work. The pipelines of its first runs are read as
// well, with their scenes; nothing is run.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "framework/config/json_document.h"
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

// beside the broken pipelines, where there are some to vary
constexpr const char* kFile = PLAZA_SOURCE_DIR "/tests/error/pipelines/fuzzed-study.json";

/// A text that ends with a new line has an empty line behind it, where its end is.
std::ptrdiff_t lines_of(std::string_view text) {
  return 1 + std::count(text.begin(), text.end(), '\n');
}

/// Of the study, or of a file that it leads to; 0 when there is no such file.
std::ptrdiff_t lines_of(const std::string& file, std::string_view study) {
  if (file == kFile) return lines_of(study);
  static std::map<std::string, std::ptrdiff_t> known;
  const auto [entry, fresh] = known.try_emplace(file, 0);
  if (fresh && std::filesystem::is_regular_file(file)) {
    entry->second = lines_of(plaza::read_text_file(file));
  }
  return entry->second;
}

void check(const plaza::UserError& error, std::string_view study) {
  for (const plaza::Diagnostic& diagnostic : error.diagnostics()) {
    require(!diagnostic.message.empty(), "diagnostic without a message");
    const plaza::FilePosition& where = diagnostic.where;
    const bool there = where.line >= 1 && where.line <= lines_of(where.file, study);
    if (!there) require(false, ("a place that is none: " + plaza::to_string(diagnostic)).c_str());
  }
}

/// The number of runs, or one more than a study may have.
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
    runs = std::min(runs * axis.values.size(), plaza::kMaxStudyJobs + 1);
  }
  return runs;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const plaza::Registry registry = plaza::test::make_registry();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const plaza::Study study = plaza::read_study_text(text, kFile);
    const std::size_t runs = check(study);
    if (runs > kExpandedRuns && runs <= plaza::kMaxStudyJobs) return 0;  // takes too long
    const plaza::Expansion expansion = plaza::expand(study, registry);
    require(expansion.jobs.size() == runs, "another number of runs");
    for (std::size_t j = 0; j < std::min(runs, kReadRuns); ++j) {
      try {
        plaza::read_pipeline_in_scene(expansion.jobs[j].request, registry);
      } catch (const plaza::UserError& error) {
        check(error, text);
      }
    }
  } catch (const plaza::UserError& error) {
    check(error, text);
  }
  return 0;
}
