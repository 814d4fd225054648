#include "framework/study/report/tables.h"

#include <algorithm>

#include "framework/results/number_text.h"

namespace plaza {
namespace {

constexpr int kDecimals = 3;
constexpr int kMostDecimals = 6;

/// Chosen columns that share a branch and a section, in their order.
std::vector<std::vector<std::size_t>> sections_of(const StudyResults& results) {
  std::vector<std::vector<std::size_t>> sections;
  for (const std::size_t c : results.chosen()) {
    const MetricColumn& column = results.columns[c];
    const auto same = [&](const std::vector<std::size_t>& section) {
      const MetricColumn& first = results.columns[section.front()];
      return first.branch == column.branch && first.section == column.section;
    };
    const auto section = std::find_if(sections.begin(), sections.end(), same);
    if (section == sections.end()) {
      sections.push_back({c});
    } else {
      section->push_back(c);
    }
  }
  return sections;
}

std::string section_title(const MetricColumn& column) {
  return column.branch.empty() ? column.section : column.branch + "/" + column.section;
}

/// "MOTA", "mean_error_m down": which way is better, where that is not up.
std::string metric_head(const MetricSpec& metric) {
  std::string head = metric.name;
  if (!metric.unit.empty()) head += " [" + metric.unit + "]";
  if (metric.better == Better::kLower) head += " ↓";
  if (metric.better == Better::kHigher) head += " ↑";
  return head;
}

std::string spread_text(const std::vector<double>& figures, std::size_t repetitions,
                        const MetricColumn& column) {
  const auto spread = spread_of(figures);
  if (!spread) return "-";
  if (repetitions < 2) return figure_text(spread->median, column);
  std::string half = fixed_text((spread->high - spread->low) / 2, column.whole ? 1 : kDecimals);
  if (half.ends_with(".0")) half.resize(half.size() - 2);
  std::string text = figure_text(spread->median, column) + " ±" + half;
  if (figures.size() < repetitions) text += " (" + std::to_string(figures.size()) + ")";
  return text;
}

std::string signed_text(double value, int decimals) {
  const std::string text = fixed_text(value, decimals);
  return value > 0 && text.find_first_not_of("0.") != std::string::npos ? "+" + text : text;
}

std::string difference_text(const std::optional<Estimate>& estimate, Better better) {
  if (!estimate) return "-";
  const int sign = verdict(*estimate, better);
  // a bound that leaves zero out shows it
  int decimals = kDecimals;
  while (sign != 0 && decimals < kMostDecimals &&
         (fixed_text(*estimate->low, decimals) == fixed_text(0, decimals) ||
          fixed_text(*estimate->high, decimals) == fixed_text(0, decimals))) {
    ++decimals;
  }
  std::string text = signed_text(estimate->mean, decimals);
  if (!estimate->low) return text;
  text += " [" + signed_text(*estimate->low, decimals) + ", " +
          signed_text(*estimate->high, decimals) + "]";
  if (sign != 0) text += sign > 0 ? " better" : " worse";
  return text;
}

/// Characters as a terminal counts them.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::string padded(const std::string& text, std::size_t width, bool left) {
  const std::string space(width - std::min(width, width_of(text)), ' ');
  return left ? text + space : space + text;
}

/// Columns [begin, end) behind the words.
std::string text_block(const WordTable& table, const std::vector<std::size_t>& widths,
                       std::size_t begin, std::size_t end) {
  std::string text;
  const auto add = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (c >= table.left && (c < begin || c >= end)) continue;
      line.append("  ").append(padded(cells[c], widths[c], c < table.left));
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  add(table.head);
  for (const auto& row : table.rows) add(row);
  return text;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) {
    row += ' ';
    for (const char c : cell) {
      if (c == '|') row += '\\';
      row += c;
    }
    row += " |";
  }
  row += '\n';
  return row;
}

}  // namespace

std::string cell_legend(const StudyResults& results) {
  const std::size_t repetitions = results.prepared->study.seeds.size();
  if (repetitions < 2) return "One run of each variant.";
  return "Median of " + std::to_string(repetitions) +
         " repetitions ± half the distance of the quartiles; in brackets how many there are where "
         "some are missing.";
}

std::string difference_legend() {
  return "Mean of the differences of pairs that are equal in all else, with its 95 % bootstrap "
         "interval (10000 resamplings) from three pairs on; \"better\" and \"worse\" where that "
         "leaves zero out.";
}

std::vector<WordTable> result_tables(const StudyResults& results) {
  const Study& study = results.prepared->study;
  const auto& variants = results.prepared->expansion.variants;
  const std::size_t repetitions = std::max<std::size_t>(study.seeds.size(), 1);
  std::vector<WordTable> tables;
  for (const std::vector<std::size_t>& section : sections_of(results)) {
    WordTable& table = tables.emplace_back();
    table.title = section_title(results.columns[section.front()]);
    for (const Axis& axis : study.axes) table.head.push_back(axis.name);
    if (study.axes.empty()) table.head.emplace_back("study");
    table.left = table.head.size();
    for (const std::size_t c : section)
      table.head.push_back(metric_head(results.columns[c].metric));
    for (std::size_t v = 0; v < variants.size(); ++v) {
      std::vector<std::string> row = variants[v].labels;
      if (study.axes.empty()) row.push_back(study.name);
      for (const std::size_t c : section) {
        row.push_back(spread_text(results.figures(v, c), repetitions, results.columns[c]));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return tables;
}

std::vector<WordTable> difference_tables(const StudyResults& results) {
  const std::vector<Comparison> comparisons = compare_with_baseline(results);
  std::vector<WordTable> tables;
  if (comparisons.empty()) return tables;
  for (const std::vector<std::size_t>& section : sections_of(results)) {
    WordTable& table = tables.emplace_back();
    table.title = section_title(results.columns[section.front()]) + ", difference from " +
                  baseline_text(results.prepared->study);
    table.head = {"compared", "pairs"};
    table.left = 1;
    for (const std::size_t c : section)
      table.head.push_back(metric_head(results.columns[c].metric));
    for (const Comparison& comparison : comparisons) {
      std::vector<std::string> row = {comparison.label};
      std::size_t pairs = 0;
      for (const std::size_t c : section) {
        pairs = std::max(pairs, comparison.differences[c].size());
      }
      row.push_back(std::to_string(pairs));
      for (const std::size_t c : section) {
        row.push_back(difference_text(comparison.estimates[c], results.columns[c].metric.better));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return tables;
}

std::vector<std::string> failure_lines(const StudyResults& results) {
  std::vector<std::string> lines;
  const Expansion& expansion = results.prepared->expansion;
  for (std::size_t j = 0; j < results.jobs.size(); ++j) {
    const JobOutcome& outcome = results.jobs[j];
    if (outcome.done()) continue;
    const Job& job = expansion.jobs[j];
    std::string line = variant_text(results.prepared->study, expansion.variants[job.variant]);
    if (job.seed) line += ", seed " + std::to_string(*job.seed);
    lines.push_back(line + ": " + (outcome.error().empty() ? "has not been run" : outcome.error()));
  }
  return lines;
}

std::string to_text(const WordTable& table) {
  constexpr std::size_t kWidest = 100;
  std::vector<std::size_t> widths(table.head.size(), 0);
  const auto widen = [&widths](const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      widths[c] = std::max(widths[c], width_of(cells[c]));
    }
  };
  widen(table.head);
  for (const auto& row : table.rows) widen(row);
  std::size_t words = 1;
  for (std::size_t c = 0; c < table.left; ++c) words += widths[c] + 2;
  std::string text = table.title + "\n";
  for (std::size_t begin = table.left; begin < table.head.size();) {
    std::size_t end = begin;
    std::size_t width = words;
    while (end < table.head.size() && (end == begin || width + widths[end] + 2 <= kWidest)) {
      width += widths[end++] + 2;
    }
    text += text_block(table, widths, begin, end);
    begin = end;
  }
  return text;
}

std::string to_markdown(const WordTable& table) {
  std::string text = "### " + table.title + "\n\n" + markdown_row(table.head);
  std::vector<std::string> line;
  for (std::size_t c = 0; c < table.head.size(); ++c)
    line.push_back(c < table.left ? ":--" : "--:");
  text += markdown_row(line);
  for (const auto& row : table.rows) text += markdown_row(row);
  return text;
}

}  // namespace plaza
