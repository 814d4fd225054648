#include "framework/study/report/csv.h"

#include <array>
#include <charconv>

#include "framework/results/number_text.h"

namespace plaza {
namespace {

/// RFC 4180: quoted where it has to be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// The shortest text that reads back as the same number, whatever the locale.
std::string exact_text(double value) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string better_word(Better better) {
  if (better == Better::kNeither) return "neither";
  return better == Better::kHigher ? "higher" : "lower";
}

/// Axes, repetition, seed: what tells a job from the others. Ends with a comma.
std::string job_fields(const StudyResults& results, std::size_t j) {
  const Expansion& expansion = results.prepared->expansion;
  const Job& job = expansion.jobs[j];
  std::string row;
  for (const std::string& label : expansion.variants[job.variant].labels) row += field(label) + ",";
  return row + std::to_string(job.repetition + 1) + "," +
         (job.seed ? std::to_string(*job.seed) : "") + ",";
}

std::string head(const StudyResults& results, const std::string& more) {
  std::string row;
  for (const Axis& axis : results.prepared->study.axes) row += field(axis.name) + ",";
  return row + "repetition,seed," + more + "\n";
}

std::string status_of(const JobOutcome& outcome) {
  if (outcome.done()) return "done";
  return outcome.error().empty() ? "missing" : "failed";
}

}  // namespace

std::string results_csv(const StudyResults& results) {
  std::string csv = head(results, "status,branch,section,metric,unit,better,value,error");
  for (std::size_t j = 0; j < results.jobs.size(); ++j) {
    const JobOutcome& outcome = results.jobs[j];
    const std::string start = job_fields(results, j) + status_of(outcome) + ",";
    if (!outcome.done()) {
      csv += start + ",,,,,," + field(outcome.error()) + "\n";
      continue;
    }
    for (std::size_t c = 0; c < results.columns.size(); ++c) {
      if (!outcome.figures[c]) continue;
      const MetricColumn& column = results.columns[c];
      csv += start + field(column.branch) + "," + field(column.section) + "," +
             field(column.metric.name) + "," + field(column.metric.unit) + "," +
             better_word(column.metric.better) + "," + exact_text(*outcome.figures[c]) + ",\n";
    }
  }
  return csv;
}

std::string times_csv(const StudyResults& results) {
  constexpr int kDecimals = 6;
  std::string csv = head(results, "frames,node_seconds,node_seconds_per_frame");
  for (std::size_t j = 0; j < results.jobs.size(); ++j) {
    const JobOutcome& outcome = results.jobs[j];
    if (!outcome.done()) continue;
    const auto frames = static_cast<double>(outcome.result->frames);
    csv += job_fields(results, j) + std::to_string(outcome.result->frames) + "," +
           fixed_text(outcome.result->node_seconds, kDecimals) + "," +
           (frames > 0 ? fixed_text(outcome.result->node_seconds / frames, kDecimals) : "") + "\n";
  }
  return csv;
}

}  // namespace plaza
