#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "plaza/component/evaluator.h"

namespace plaza {

/// How a job ended.
struct JobResult {
  std::string error;   ///< why it failed; empty: it is done
  bool again = false;  ///< it failed by no fault of its own: the next start tries it again
  std::int64_t frames = 0;
  Evaluation evaluation;                       ///< of the main branch
  std::map<std::string, Evaluation> branches;  ///< of the others, by node
  /// Measured, and so never part of what must be equal in every run of a study: what all nodes took
  /// together, those counted whose results came from the cache.
  double node_seconds = 0;

  bool failed() const { return !error.empty(); }
};

/// The result that stands in a job's folder; nothing when there is none, when it is damaged, or
/// when it is of another key: the study, its data or a plugin has changed since.
std::optional<JobResult> read_job_result(const std::filesystem::path& folder, std::string_view key);

/// Writes result.json, whole or not at all.
void write_job_result(const std::filesystem::path& folder, std::string_view key,
                      const JobResult& result);

}  // namespace plaza
