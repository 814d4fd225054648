#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/study/job_result.h"
#include "framework/study/prepare.h"

namespace plaza {

/// A figure of a study: one of an evaluator's metrics in one branch of the pipeline.
struct MetricColumn {
  std::string branch;   ///< empty: the main one
  std::string section;  ///< as in summary.json: the declared one, or "tracking@other-scores"
  MetricSpec metric;
  bool chosen = false;  ///< tables and plots show it
  bool whole = true;    ///< all figures are counts

  /// "tracking.MOTA"; of another branch "branch/tracking.MOTA".
  std::string title() const;
};

/// A job with what came of it.
struct JobOutcome {
  std::optional<JobResult> result;             ///< nothing: it has not ended
  std::string trouble;                         ///< why there is no result, where that is known
  std::vector<std::optional<double>> figures;  ///< by column; nothing: not evaluated

  bool done() const { return result && !result->failed(); }
  /// Why there are no figures; empty when it is done or has not ended.
  const std::string& error() const { return result ? result->error : trouble; }
};

/// Everything that reports are made of.
struct StudyResults {
  const PreparedStudy* prepared = nullptr;
  std::vector<MetricColumn> columns;  ///< that any job has a figure for, as evaluators declare them
  std::vector<JobOutcome> jobs;       ///< as prepared->jobs

  /// Figures of one variant in one column, by repetition; those that are missing left out.
  std::vector<double> figures(std::size_t variant, std::size_t column) const;
  /// Columns that tables and plots show.
  std::vector<std::size_t> chosen() const;
};

/// Puts the results of jobs into columns. `prepared` must outlive what is returned.
StudyResults collect_results(const PreparedStudy& prepared, std::vector<JobOutcome> jobs);

/// A figure of a column as tables show it: counts as they are, all else with three decimals; "-"
/// for none.
std::string figure_text(const std::optional<double>& value, const MetricColumn& column);

}  // namespace plaza
