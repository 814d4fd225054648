#include "framework/results/summary.h"

#include <cmath>

#include "plaza/io/output_file.h"

namespace plaza {
namespace {

/// Microseconds; more digits of a measured time mean nothing.
double rounded(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace

nlohmann::ordered_json summary_json(const Summary& summary) {
  nlohmann::ordered_json json = {
      {"plaza", 1}, {"pipeline", summary.pipeline}, {"complete", summary.complete}};
  if (!summary.complete) json["reason"] = summary.reason;
  json["frames"] = summary.frames;
  json["cameras"] = summary.cameras;
  json["seconds"] = rounded(summary.seconds);
  json["frames_per_second"] =
      summary.seconds > 0 ? rounded(static_cast<double>(summary.frames) / summary.seconds) : 0.0;
  json["nodes"] = nlohmann::ordered_json::array();
  for (const NodeTiming& node : summary.nodes) {
    json["nodes"].push_back({{"name", node.name},
                             {"use", node.use},
                             {"calls", node.calls},
                             {"seconds", rounded(node.seconds)}});
  }
  json["evaluation"] = nlohmann::ordered_json::object();
  for (const auto& [section, values] : summary.evaluation) json["evaluation"][section] = values;
  json["branches"] = nlohmann::ordered_json::object();
  for (const auto& [branch, evaluation] : summary.branches) {
    json["branches"][branch] = nlohmann::ordered_json::object();
    for (const auto& [section, values] : evaluation) json["branches"][branch][section] = values;
  }
  return json;
}

void write_summary(const std::filesystem::path& folder, const Summary& summary) {
  // a plugin's message in "reason" may be in any encoding
  write_file(
      folder / "summary.json",
      summary_json(summary).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace plaza
