#include "framework/cli/run_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "framework/results/number_text.h"

namespace plaza {
namespace {

/// Counts as they are, ratios with three decimals; nothing for what is neither number nor word.
std::string figure_text(const nlohmann::json& value) {
  if (value.is_number_integer()) return std::to_string(value.get<std::int64_t>());
  if (value.is_number()) return fixed_text(value.get<double>(), 3);
  if (value.is_string()) return value.get<std::string>();
  return "";
}

using Details = std::set<std::pair<std::string, std::string>>;  // (section, name)

Details details_of(const ResolvedPipeline& pipeline) {
  Details details;
  for (const ResolvedNode& node : pipeline.nodes) {
    for (const MetricSpec& metric : node.entry->declaration.metrics) {
      if (metric.detail) details.emplace(metric.section, metric.name);
    }
  }
  return details;
}

void print_evaluation(std::ostream& out, const std::string& title, const Evaluation& evaluation,
                      const Details& details) {
  std::size_t width = 0;
  for (const auto& [section, values] : evaluation) width = std::max(width, section.size());
  if (!evaluation.empty() && !title.empty()) out << title << '\n';
  for (const auto& [section, values] : evaluation) {
    std::string line = "  " + section + std::string(width - section.size(), ' ');
    const std::string indent(width + 2, ' ');
    for (const auto& [key, value] : values.items()) {
      const std::string text = figure_text(value);
      if (text.empty() || details.contains({section, key})) continue;
      const std::string item = "  " + key + " " + text;
      if (line.size() + item.size() > 100) {
        out << line << '\n';
        line = indent;
      }
      line += item;
    }
    out << line << '\n';
  }
}

}  // namespace

void print_report(std::ostream& out, const RunReport& report, const ResolvedPipeline& pipeline,
                  const std::filesystem::path& folder) {
  const double rate = report.seconds > 0 ? static_cast<double>(report.frames) / report.seconds : 0;
  out << report.frames << " frames in " << fixed_text(report.seconds, 1) << " s ("
      << fixed_text(rate, 1) << " frames/s)" << (report.complete ? "" : ", not complete") << '\n';
  const Details details = details_of(pipeline);
  print_evaluation(out, "", report.evaluation, details);
  for (const auto& [branch, evaluation] : report.branches) {
    print_evaluation(out, "branch " + branch, evaluation, details);
  }
  std::size_t width = 0;
  for (const Artifact& a : report.artifacts) width = std::max(width, a.file.string().size());
  out << "See " << folder.string() << ":\n";
  for (const Artifact& a : report.artifacts) {
    const std::string file = a.file.string();
    out << "  " << file << std::string(width - file.size() + 2, ' ') << a.what << '\n';
  }
}

void print_report_json(std::ostream& out, const RunReport& report,
                       const std::filesystem::path& folder) {
  nlohmann::ordered_json line = {
      {"event", "end"},          {"complete", report.complete},
      {"frames", report.frames}, {"seconds", report.seconds},
      {"out", folder.string()},  {"artifacts", nlohmann::ordered_json::array()}};
  if (!report.complete) line["reason"] = report.stop_reason;
  for (const Artifact& a : report.artifacts) {
    line["artifacts"].push_back({{"file", a.file.string()}, {"what", a.what}});
  }
  out << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
}

}  // namespace plaza
