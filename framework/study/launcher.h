#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace plaza {

/// A job as a launcher sees it.
struct LaunchJob {
  std::size_t index = 0;               ///< into the study's jobs
  std::filesystem::path folder;        ///< DIR/jobs/ID
  std::string title;                   ///< for people
  std::vector<std::string> node_keys;  ///< what it computes; jobs that share some are kept apart
};

/// How the process of a job ended, as far as the launcher can tell.
struct LaunchEnd {
  std::size_t index = 0;
  std::string crash;   ///< "ended by signal 11 (Segmentation fault)"; empty: it ended by itself
  bool again = false;  ///< it was killed from outside: no fault of its own
};

struct LaunchOptions {
  std::filesystem::path out;             ///< of the study
  std::vector<std::string> program;      ///< how this program is called, its own options included
  std::vector<std::string> job_options;  ///< that every job's command gets
  int jobs = 1;                          ///< how many at a time
  int threads = 1;                       ///< that each job uses
  std::string hosts;                     ///< of GNU parallel: "4/host1,host2"; empty: this machine
  std::function<void(const LaunchJob&)> on_start;
  std::function<void(const LaunchEnd&)> on_end;
};

/// Runs `plaza study-job FOLDER` for each job and tells of each end. Returns early, having ended
/// what it started, when a stop is requested.
using Launcher = void (*)(const std::vector<LaunchJob>& jobs, const LaunchOptions& options);

/// Child processes of this one.
void launch_local(const std::vector<LaunchJob>& jobs, const LaunchOptions& options);

/// Job arrays of a Slurm cluster, by sbatch; `jobs` limits how many tasks work at a time. The
/// cluster shares the study's folder, the cache and this program with this machine. Failures of
/// sbatch are UserErrors.
void launch_slurm(const std::vector<LaunchJob>& jobs, const LaunchOptions& options);

/// GNU parallel, here or on ssh hosts, which share the same; `jobs` is per host.
void launch_parallel(const std::vector<LaunchJob>& jobs, const LaunchOptions& options);

}  // namespace plaza
