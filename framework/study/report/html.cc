#include "framework/study/report/html.h"

#include <algorithm>
#include <sstream>

#include "framework/results/number_text.h"
#include "framework/study/report/plots.h"
#include "framework/study/report/svg.h"
#include "framework/study/report/tables.h"

namespace plaza {
namespace {

// so many metrics are unfolded from the start
constexpr std::size_t kUnfolded = 4;
constexpr std::size_t kManyVariants = 16;

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; color: #1d2329; background: #fff;
       max-width: 1120px; margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.6rem; margin: 0 0 .2rem; } h2 { font-size: 1.2rem; margin: 2.2rem 0 .4rem; }
h3 { font-size: 1rem; margin: 1.4rem 0 .4rem; } p { margin: .4rem 0; } .quiet { color: #5a6672; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .7rem; text-align: right; white-space: nowrap; }
th { border-bottom: 1.5px solid #9aa5b1; font-weight: 600; } td { border-bottom: 1px solid #e4e8ec; }
th.word, td.word { text-align: left; } tr:hover td { background: #f4f7fa; }
.better { color: #00734f; } .worse { color: #b04500; }
details { border-top: 1px solid #d5dbe1; padding: .5rem 0; } summary { cursor: pointer; font-weight: 600; }
.plots { display: flex; flex-wrap: wrap; gap: 1rem; } figure { margin: .4rem 0; }
figcaption { font-size: .85rem; } .key { margin-right: 1rem; white-space: nowrap; }
.key i { display: inline-block; width: .8em; height: .8em; border-radius: 50%; margin-right: .35em; }
svg { max-width: 100%; height: auto; } svg text { font-size: 12px; fill: #3b4650; }
svg text.small { font-size: 10px; fill: #5a6672; }
svg .grid { stroke: #e8ecf0; } svg .axis { stroke: #9aa5b1; } svg .zero { stroke: #3b4650; stroke-dasharray: 4 3; }
.failed { background: #fff4ec; border-left: 4px solid #d55e00; padding: .4rem .8rem; }
)";

std::string cell(const std::string& text, bool word, const char* element) {
  std::string mark = word ? "word" : "";
  if (text.ends_with(" better")) mark = "better";
  if (text.ends_with(" worse")) mark = "worse";
  std::ostringstream out;
  out << '<' << element;
  if (!mark.empty()) out << " class=\"" << mark << '"';
  out << '>' << escaped(text) << "</" << element << '>';
  return out.str();
}

std::string table_html(const WordTable& table) {
  std::ostringstream out;
  out << "<h3>" << escaped(table.title) << "</h3><div class=\"wide\"><table><thead><tr>";
  for (std::size_t c = 0; c < table.head.size(); ++c) {
    out << cell(table.head[c], c < table.left, "th");
  }
  out << "</tr></thead><tbody>";
  for (const auto& row : table.rows) {
    out << "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) out << cell(row[c], c < table.left, "td");
    out << "</tr>";
  }
  out << "</tbody></table></div>\n";
  return out.str();
}

std::string results_html(const StudyResults& results) {
  std::string html = "<h2>Results</h2>\n";
  for (const WordTable& table : result_tables(results)) html += table_html(table);
  return html;
}

std::string better_note(Better better) {
  if (better == Better::kNeither) return "";
  return better == Better::kHigher ? ", more is better" : ", less is better";
}

/// All plots of one metric, folded together.
std::string metric_html(const StudyResults& results, const std::vector<Comparison>& comparisons,
                        std::size_t column, bool unfolded) {
  const MetricColumn& c = results.columns[column];
  const Study& study = results.prepared->study;
  std::ostringstream out;
  out << "<details" << (unfolded ? " open" : "") << "><summary>" << escaped(c.title())
      << "</summary><p class=\"quiet\">" << escaped(c.metric.meaning)
      << (c.metric.unit.empty() ? "" : " [" + escaped(c.metric.unit) + "]")
      << better_note(c.metric.better) << "</p><div class=\"plots\">";
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    if (study.axes[a].values.size() > 1) out << axis_plot(results, a, column);
  }
  out << time_plot(results, column) << difference_plot(results, comparisons, column)
      << "</div></details>\n";
  return out.str();
}

WordTable variants_table(const StudyResults& results) {
  constexpr int kDecimals = 2;
  const Study& study = results.prepared->study;
  const auto& variants = results.prepared->expansion.variants;
  WordTable table;
  table.title = "Variants";
  table.head = {"#"};
  for (const Axis& axis : study.axes) table.head.push_back(axis.name);
  table.left = table.head.size();
  table.head.insert(table.head.end(), {"runs done", "ms per frame"});
  for (std::size_t v = 0; v < variants.size(); ++v) {
    std::vector<std::string> row = {std::to_string(v + 1)};
    row.insert(row.end(), variants[v].labels.begin(), variants[v].labels.end());
    std::size_t done = 0;
    std::size_t all = 0;
    for (std::size_t j = 0; j < results.jobs.size(); ++j) {
      if (results.prepared->expansion.jobs[j].variant != v) continue;
      ++all;
      done += results.jobs[j].done() ? 1 : 0;
    }
    row.push_back(std::to_string(done) + " of " + std::to_string(all));
    const auto ms = milliseconds_per_frame(results, v);
    row.push_back(ms ? fixed_text(*ms, kDecimals) : "-");
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::string report_html(const StudyResults& results) {
  const Study& study = results.prepared->study;
  const auto comparisons = compare_with_baseline(results);
  const auto failures = failure_lines(results);
  std::ostringstream out;
  out << "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width\"><title>"
      << escaped(study.name) << "</title><style>" << kStyle << "</style></head><body>\n<h1>"
      << escaped(study.name) << "</h1>\n<p>" << escaped(study.description)
      << "</p>\n<p class=\"quiet\">" << results.prepared->expansion.variants.size() << " variants, "
      << results.jobs.size() << " runs";
  if (!failures.empty()) out << ", " << failures.size() << " without result";
  out << ". " << escaped(cell_legend(results)) << "</p>\n";
  if (!failures.empty()) {
    out << "<div class=\"failed\"><p>Without result:</p><ul>";
    for (const std::string& line : failures) out << "<li>" << escaped(line) << "</li>";
    out << "</ul></div>\n";
  }
  // long tables come behind the plots
  const bool many = results.prepared->expansion.variants.size() > kManyVariants;
  if (!many) out << results_html(results);
  const auto differences = difference_tables(results);
  if (!differences.empty()) {
    out << "<h2>Differences from " << escaped(baseline_text(study)) << "</h2>\n<p class=\"quiet\">"
        << escaped(difference_legend()) << "</p>\n";
  }
  for (const WordTable& table : differences) out << table_html(table);
  const std::vector<std::size_t> chosen = results.chosen();
  if (!chosen.empty()) {
    out << "<h2>Plots</h2>\n<p class=\"quiet\">Large dots: medians over all runs with that value "
           "and colour, whatever the other axes; bars: their quartiles; small dots: the runs. "
           "Against "
           "time, dots carry the numbers of the variants below.</p>\n";
  }
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    out << metric_html(results, comparisons, chosen[i], i < kUnfolded);
  }
  if (many) out << results_html(results);
  out << "<h2>Times</h2>\n<p class=\"quiet\">What all nodes of a run took together, per frame, "
         "measured once where several variants share a node's results. Runs that work side by side "
         "slow each other down.</p>\n"
      << table_html(variants_table(results)) << "</body></html>\n";
  return out.str();
}

}  // namespace plaza
