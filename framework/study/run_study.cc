#include "framework/study/run_study.h"

#include <algorithm>
#include <memory>
#include <system_error>
#include <thread>

#include "framework/cache/file_lock.h"
#include "framework/execution/stop.h"
#include "framework/study/report/report_files.h"
#include "framework/study/study_job.h"
#include "framework/study/study_progress.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

/// Keeps a second study out of the folder for as long as it lives, also when its process is killed.
FileLock lock_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw UserError("cannot create the output folder " + folder.string() + ": " + error.message() +
                    "; choose another one with --out");
  }
  auto lock = FileLock::try_lock(folder / ".lock");
  if (!lock) throw UserError("a study is at work in " + folder.string() + "; choose another --out");
  return std::move(*lock);
}

class StudyRun {
 public:
  StudyRun(StudyEnd& end, const StudyOptions& options) : end_(end), options_(options) {}

  void run() {
    const FileLock lock = lock_folder(options_.out);
    outcomes_.resize(end_.prepared.jobs.size());
    find_pending();
    launch();
    end_.complete = std::all_of(outcomes_.begin(), outcomes_.end(),
                                [](const JobOutcome& o) { return o.result.has_value(); });
    end_.results = collect_results(end_.prepared, std::move(outcomes_));
    write_reports(options_.out, end_.results);
  }

 private:
  fs::path folder_of(std::size_t job) const {
    return fs::absolute(options_.out) / "jobs" / end_.prepared.jobs[job].id;
  }

  std::string title_of(std::size_t j) const {
    const Job& job = end_.prepared.expansion.jobs[j];
    std::string title =
        variant_text(end_.prepared.study, end_.prepared.expansion.variants[job.variant]);
    if (job.seed) title += ", seed " + std::to_string(*job.seed);
    return title;
  }

  void find_pending() {
    for (std::size_t j = 0; j < outcomes_.size(); ++j) {
      const PreparedJob& job = end_.prepared.jobs[j];
      outcomes_[j].result = read_job_result(folder_of(j), job.key);
      const auto& before = outcomes_[j].result;
      if (before && (before->again || (options_.retry && before->failed()))) {
        outcomes_[j].result.reset();
        std::error_code ignored;  // what stays is overwritten
        fs::remove(folder_of(j) / "result.json", ignored);
      }
      if (outcomes_[j].result) continue;
      write_job_order(folder_of(j), job,
                      {.key = job.key,
                       .frames = end_.prepared.expansion.jobs[j].frames,
                       .draw = end_.prepared.study.draw});
      pending_.push_back({j, folder_of(j), title_of(j), job.node_keys});
    }
  }

  void launch() {
    if (pending_.empty()) return;
    const auto cores = std::max(1U, std::thread::hardware_concurrency());
    const int threads = std::max(1, static_cast<int>(cores) / options_.jobs);
    StudyProgress progress(outcomes_.size(), outcomes_.size() - pending_.size(), options_.quiet);
    LaunchOptions launch;
    launch.out = fs::absolute(options_.out);
    launch.program = options_.program;
    launch.job_options = {"--cache-dir", fs::absolute(options_.cache_folder).string(), "--threads",
                          std::to_string(threads)};
    if (options_.cache_limit_gb) {
      launch.job_options.insert(launch.job_options.end(),
                                {"--cache-limit", std::to_string(*options_.cache_limit_gb)});
    }
    launch.jobs = options_.jobs;
    launch.threads = threads;
    launch.hosts = options_.hosts;
    launch.on_start = [&progress](const LaunchJob&) { progress.started(); };
    launch.on_end = [&](const LaunchEnd& end) {
      take(end);
      const JobOutcome& outcome = outcomes_[end.index];
      progress.ended(title_of(end.index), outcome.error());
    };
    options_.launcher(pending_, launch);
  }

  void take(const LaunchEnd& end) {
    const PreparedJob& job = end_.prepared.jobs[end.index];
    JobOutcome& outcome = outcomes_[end.index];
    outcome.result = read_job_result(folder_of(end.index), job.key);
    if (outcome.result && outcome.result->again) {
      outcome.trouble = outcome.result->error + "; start the study again";
      outcome.result.reset();
      return;
    }
    if (outcome.result) return;
    const std::string log = "see " + (folder_of(end.index) / "log.txt").string();
    if (!end.crash.empty() && !end.again) {
      outcome.result = JobResult{};  // it would crash again
      outcome.result->error = end.crash;
      write_job_result(folder_of(end.index), job.key, *outcome.result);
    } else if (stop_requested()) {
      outcome.trouble.clear();
    } else {
      outcome.trouble = (end.crash.empty() ? "ended without a result; " + log
                                           : end.crash + ", from outside; start the study again");
    }
  }

  StudyEnd& end_;
  const StudyOptions& options_;
  std::vector<JobOutcome> outcomes_;
  std::vector<LaunchJob> pending_;
};

}  // namespace

std::unique_ptr<StudyEnd> run_study(const fs::path& file, const StudyOptions& options,
                                    const Registry& registry) {
  auto end = std::make_unique<StudyEnd>();
  end->prepared = prepare_study(read_study(file), registry);
  StudyRun(*end, options).run();
  return end;
}

}  // namespace plaza
