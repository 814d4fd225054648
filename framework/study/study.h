#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/frame_range.h"
#include "framework/config/set_option.h"
#include "plaza/component/declaration.h"

namespace plaza {

/// What one value of an axis, or the study as a whole, does to a run. Later changes win.
struct Change {
  std::optional<std::filesystem::path> pipeline;
  std::optional<FrameRange> frames;
  std::vector<Setting> settings;  ///< in their order; "/nodes" stands for fragments of nodes
};

struct AxisValue {
  std::string label;             ///< unique on its axis
  std::optional<double> number;  ///< where the value is one: axes of numbers have a scale
  Change change;
};

/// One thing that is varied.
struct Axis {
  std::string name;  ///< unique in the study
  std::vector<AxisValue> values;

  bool numeric() const;  ///< all values are numbers
};

/// Which metrics tables and plots show: "tracking.MOTA", "tracking" or "MOTA".
struct MetricChoice {
  std::string text;
  Origin origin;
};

/// True when `choice` is the metric's "section.name", section, or name.
bool is_chosen(const MetricSpec& metric, const std::string& choice);

/// What others are compared with: a value on some of the axes.
struct Baseline {
  std::map<std::string, std::string> values;  ///< axis -> label; empty: there is no baseline
};

/// A study as its file says it: every combination of the axes' values, each with every seed.
struct Study {
  std::filesystem::path file;
  std::string name;
  std::string description;
  Change base;
  Origin pipeline_origin;
  std::vector<Axis> axes;
  Origin axes_origin;
  std::vector<std::uint64_t> seeds;          ///< repetitions; empty: one, with the pipeline's own
  std::vector<std::string> seed_parameters;  ///< where they are set
  Origin seeds_origin;
  std::vector<MetricChoice> metrics;  ///< empty: all that evaluators declare
  Baseline baseline;
  bool draw = false;  ///< sinks and renderers work, too
};

/// Reads a study; every fault of the file in one UserError.
Study read_study(const std::filesystem::path& file);
/// The same from text; `file` names it and is where relative paths start.
Study read_study_text(std::string_view text, const std::filesystem::path& file);

}  // namespace plaza
