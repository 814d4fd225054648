#include "framework/study/study_results.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "framework/results/number_text.h"

namespace plaza {
namespace {

using Sections = std::map<std::string, std::set<std::string>>;  // branch -> sections there are

/// "tracking" of "tracking@other-scores".
std::string declared_section(const std::string& section) {
  return section.substr(0, section.find('@'));
}

const Evaluation* evaluation_of(const JobOutcome& job, const std::string& branch) {
  if (!job.done()) return nullptr;
  if (branch.empty()) return &job.result->evaluation;
  const auto it = job.result->branches.find(branch);
  return it == job.result->branches.end() ? nullptr : &it->second;
}

/// The number in summary.json's form; null where there is none.
nlohmann::json figure_of(const JobOutcome& job, const MetricColumn& column) {
  const Evaluation* evaluation = evaluation_of(job, column.branch);
  if (evaluation == nullptr) return nullptr;
  const auto section = evaluation->find(column.section);
  if (section == evaluation->end()) return nullptr;
  const auto value = section->second.find(column.metric.name);
  if (value == section->second.end() || !value->is_number()) return nullptr;
  return *value;
}

Sections sections_of(const std::vector<JobOutcome>& jobs) {
  Sections sections;
  const auto add = [&sections](const std::string& branch, const Evaluation& evaluation) {
    for (const auto& [section, values] : evaluation) sections[branch].insert(section);
  };
  for (const JobOutcome& job : jobs) {
    if (!job.done()) continue;
    add("", job.result->evaluation);
    for (const auto& [branch, evaluation] : job.result->branches) add(branch, evaluation);
  }
  return sections;
}

bool is_shown(const Study& study, const MetricSpec& metric) {
  if (study.metrics.empty()) return !metric.detail;
  return std::any_of(study.metrics.begin(), study.metrics.end(), [&](const MetricChoice& c) {
    return is_chosen(metric, c.text) && (!metric.detail || c.text != metric.section);
  });
}

}  // namespace

std::string MetricColumn::title() const {
  const std::string name = section + "." + metric.name;
  return branch.empty() ? name : branch + "/" + name;
}

std::vector<double> StudyResults::figures(std::size_t variant, std::size_t column) const {
  std::vector<double> figures;
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    if (prepared->expansion.jobs[j].variant != variant) continue;
    if (const auto& figure = jobs[j].figures[column]) figures.push_back(*figure);
  }
  return figures;
}

std::vector<std::size_t> StudyResults::chosen() const {
  std::vector<std::size_t> chosen;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].chosen) chosen.push_back(c);
  }
  return chosen;
}

StudyResults collect_results(const PreparedStudy& prepared, std::vector<JobOutcome> jobs) {
  StudyResults results;
  results.prepared = &prepared;
  for (const auto& [branch, sections] : sections_of(jobs)) {
    for (const MetricSpec& metric : prepared.metrics) {
      for (const std::string& section : sections) {
        if (declared_section(section) != metric.section) continue;
        MetricColumn column;
        column.branch = branch;
        column.section = section;
        column.metric = metric;
        column.chosen = is_shown(prepared.study, metric);
        bool any = false;
        for (const JobOutcome& job : jobs) {
          const nlohmann::json figure = figure_of(job, column);
          any = any || !figure.is_null();
          column.whole = column.whole && (figure.is_null() || figure.is_number_integer());
        }
        if (any) results.columns.push_back(std::move(column));
      }
    }
  }
  for (JobOutcome& job : jobs) {
    job.figures.clear();
    for (const MetricColumn& column : results.columns) {
      const nlohmann::json figure = figure_of(job, column);
      job.figures.push_back(figure.is_null() ? std::nullopt
                                             : std::optional<double>(figure.get<double>()));
    }
  }
  results.jobs = std::move(jobs);
  return results;
}

std::string figure_text(const std::optional<double>& value, const MetricColumn& column) {
  if (!value) return "-";
  constexpr int kDecimals = 3;
  if (!column.whole) return fixed_text(*value, kDecimals);
  return fixed_text(*value, *value == std::floor(*value) ? 0 : 1);  // a median lies between two
}

}  // namespace plaza
