#include "framework/study/report/report_files.h"

#include <algorithm>
#include <sstream>

#include "framework/study/report/csv.h"
#include "framework/study/report/html.h"
#include "framework/study/report/tables.h"
#include "plaza/io/output_file.h"

namespace plaza {
namespace {

std::string counts_text(const StudyResults& results) {
  const auto done = std::count_if(results.jobs.begin(), results.jobs.end(),
                                  [](const JobOutcome& job) { return job.done(); });
  return std::to_string(results.prepared->expansion.variants.size()) + " variants, " +
         std::to_string(results.jobs.size()) + " runs, " + std::to_string(done) + " done";
}

}  // namespace

std::string report_markdown(const StudyResults& results) {
  const Study& study = results.prepared->study;
  std::ostringstream text;  // appended strings make GCC 12 see overflows that aren't there
  text << "# " << study.name << "\n\n";
  if (!study.description.empty()) text << study.description << "\n\n";
  text << counts_text(results) << ".\n";
  const auto tables = result_tables(results);
  if (!tables.empty()) text << "\n## Results\n\n" << cell_legend(results) << '\n';
  for (const WordTable& table : tables) text << '\n' << to_markdown(table);
  const auto differences = difference_tables(results);
  if (!differences.empty()) {
    text << "\n## Differences from " << baseline_text(study) << "\n\n"
         << difference_legend() << '\n';
  }
  for (const WordTable& table : differences) text << '\n' << to_markdown(table);
  const auto failures = failure_lines(results);
  if (!failures.empty()) text << "\n## Without result\n\n";
  for (const std::string& line : failures) text << "- " << line << '\n';
  text << "\nEvery figure of every run: `results.csv`; times, which no two runs share: "
          "`times.csv`; plots: `report.html`.\n";
  return text.str();
}

std::string report_text(const StudyResults& results) {
  std::string text;
  for (const WordTable& table : result_tables(results)) text += to_text(table) + "\n";
  for (const WordTable& table : difference_tables(results)) text += to_text(table) + "\n";
  const auto failures = failure_lines(results);
  if (!failures.empty()) text += "without result\n";
  for (const std::string& line : failures) text += "  " + line + "\n";
  return text + (failures.empty() ? "" : "\n") + counts_text(results) + "; " +
         cell_legend(results) + "\n";
}

void write_reports(const std::filesystem::path& folder, const StudyResults& results) {
  write_file(folder / "results.csv", results_csv(results));
  write_file(folder / "times.csv", times_csv(results));
  write_file(folder / "report.md", report_markdown(results));
  write_file(folder / "report.html", report_html(results));
}

}  // namespace plaza
