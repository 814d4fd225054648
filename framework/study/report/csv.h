#pragma once

#include <string>

#include "framework/study/study_results.h"

namespace plaza {

/// results.csv: one row per variant, repetition and metric (all declared ones that were given),
/// with a column per axis; a job without figures has one row that says why.
std::string results_csv(const StudyResults& results);

/// times.csv: one row per job with what its nodes took. Measured, and so different in every run of
/// a study, which is why it stands in a file of its own.
std::string times_csv(const StudyResults& results);

}  // namespace plaza
