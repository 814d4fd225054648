#pragma once

#include <filesystem>
#include <string>

#include "framework/study/study_results.h"

namespace plaza {

/// report.md: the tables with what they mean, without anything measured in time, so that the same
/// study gives the same bytes.
std::string report_markdown(const StudyResults& results);

/// What a terminal shows at the end.
std::string report_text(const StudyResults& results);

/// Writes results.csv, times.csv, report.md and report.html into `folder`.
void write_reports(const std::filesystem::path& folder, const StudyResults& results);

}  // namespace plaza
