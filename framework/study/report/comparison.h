#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/study/report/statistics.h"
#include "framework/study/study_results.h"

namespace plaza {

/// What is compared with the baseline: values on the axes that the baseline names. Everything else
/// (other axes, seeds) is equal within a pair, so what it does to the figures cancels out.
struct Comparison {
  std::string label;                               ///< "detector=hog"
  std::vector<std::vector<double>> differences;    ///< by column, by pair: this minus baseline
  std::vector<std::optional<Estimate>> estimates;  ///< by column, of their mean
};

/// Every combination of values on the baseline's axes but the baseline's own; none without one.
std::vector<Comparison> compare_with_baseline(const StudyResults& results);

/// "detector=edges", what the differences are from; empty without a baseline.
std::string baseline_text(const Study& study);

/// +1: the difference is for the better, -1: for the worse, 0: neither, or not distinct from zero.
int verdict(const Estimate& estimate, Better better);

}  // namespace plaza
