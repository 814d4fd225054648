#include "framework/study/study_job.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "framework/cache/file_lock.h"
#include "framework/config/json_document.h"
#include "framework/config/pipeline.h"
#include "framework/execution/run.h"
#include "framework/execution/stop.h"
#include "framework/study/job_result.h"
#include "plaza/core/error.h"
#include "plaza/io/output_file.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

JobOrder read_job_order(const fs::path& folder) {
  const JsonDocument document = read_json(folder / "job.json");
  try {
    const auto frames = parse_frame_range(document.root.at("frames").get<std::string>());
    if (!frames) throw UserError(document.file + ": its frames are no range");
    return {.key = document.root.at("key").get<std::string>(),
            .frames = *frames,
            .draw = document.root.at("draw").get<bool>()};
  } catch (const json::exception&) {
    throw UserError(document.file + ": is no job of a study; start the study again");
  }
}

std::string message_of(const Error& error) {
  const std::string place = to_string(error.context());
  return place.empty() ? error.what() : place + ": " + error.what();
}

}  // namespace

void write_job_order(const fs::path& folder, const PreparedJob& job, const JobOrder& order) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw UserError("cannot create the folder " + folder.string() + ": " + error.message() +
                    "; choose another one with --out");
  }
  write_file(folder / "pipeline.json", job.pipeline.dump(2) + "\n");
  write_file(
      folder / "job.json",
      json({{"key", order.key}, {"frames", to_string(order.frames)}, {"draw", order.draw}}).dump() +
          "\n");
}

bool run_study_job(const JobOptions& options, const Registry& registry) {
  const JobOrder order = read_job_order(options.folder);
  // one that an earlier start has left at work elsewhere: its result is as good
  std::optional<FileLock> lock;
  while (!(lock = FileLock::try_lock(options.folder / ".lock"))) {
    if (stop_requested()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const auto before = read_job_result(options.folder, order.key);
  if (before && !before->again) return true;
  RunOptions run;
  run.first_frame = order.frames.first;
  run.end_frame = order.frames.end;
  run.output_folder = options.folder / "run";
  run.cache_folder = options.cache_folder;
  run.threads = options.threads;
  run.progress = ProgressStyle::kQuiet;
  run.draw = order.draw;
  run.reuse = true;
  run.cache_limit_bytes = options.cache_limit_bytes;
  JobResult result;
  try {
    const auto [pipeline, scene] =
        read_pipeline_in_scene({.file = options.folder / "pipeline.json", .sets = {}}, registry);
    const RunReport report = run_pipeline(pipeline, scene, run);
    if (!report.complete) return false;
    result.frames = report.frames;
    result.evaluation = report.evaluation;
    result.branches = report.branches;
    result.node_seconds = report.node_seconds;
  } catch (const DiskFullError& error) {
    result.error = message_of(error);
    result.again = true;
  } catch (const Error& error) {
    result.error = message_of(error);
  }
  write_job_result(options.folder, order.key, result);
  return true;
}

}  // namespace plaza
