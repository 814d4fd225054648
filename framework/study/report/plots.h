#pragma once

#include <string>

#include "framework/study/report/comparison.h"
#include "framework/study/study_results.h"

namespace plaza {

/// A metric along one axis: the median of all runs at each value, the quartiles as a bar, every run
/// as a dot. Where another axis has few values, it has a line for each. Inline SVG.
std::string axis_plot(const StudyResults& results, std::size_t axis, std::size_t column);

/// Mean differences from the baseline with their intervals. Inline SVG; empty when there are none.
std::string difference_plot(const StudyResults& results, const std::vector<Comparison>& comparisons,
                            std::size_t column);

/// Every variant's median figure against what its nodes took per frame, numbered as in the list of
/// variants. Inline SVG; empty where nothing was measured.
std::string time_plot(const StudyResults& results, std::size_t column);

/// Median milliseconds per frame that the nodes of a variant's runs took; nothing without any.
std::optional<double> milliseconds_per_frame(const StudyResults& results, std::size_t variant);

}  // namespace plaza
