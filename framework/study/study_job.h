#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "framework/config/frame_range.h"
#include "framework/plugin/registry.h"
#include "framework/study/prepare.h"

namespace plaza {

/// What stands in a job's folder for the process that runs it: job.json, and the pipeline with all
/// of its values in pipeline.json.
struct JobOrder {
  std::string key;
  FrameRange frames;
  bool draw = false;
};

/// Makes a job's folder, DIR/jobs/ID, unless it is there already.
void write_job_order(const std::filesystem::path& folder, const PreparedJob& job,
                     const JobOrder& order);

struct JobOptions {
  std::filesystem::path folder;        ///< the job's
  std::filesystem::path cache_folder;  ///< of learned models and nodes
  std::optional<std::uintmax_t> cache_limit_bytes;
  int threads = 0;
};

/// Runs the job whose order stands in a folder, unless its result is there already, and writes the
/// result: also that of a run which failed, since it would fail again. Returns false when it was
/// interrupted: there is no result then.
bool run_study_job(const JobOptions& options, const Registry& registry);

}  // namespace plaza
