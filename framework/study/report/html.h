#pragma once

#include <string>

#include "framework/study/study_results.h"

namespace plaza {

/// report.html: one page that needs nothing else, neither files nor a network: tables, a plot of
/// each chosen metric along each axis, differences from the baseline, figures against time.
std::string report_html(const StudyResults& results);

}  // namespace plaza
