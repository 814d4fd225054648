#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "framework/study/launcher.h"

namespace plaza {

/// A word as a POSIX shell takes it literally.
std::string shell_quoted(const std::string& word);

/// What launchers that hand jobs to another program have in common: a script that runs one job and
/// leaves how its process ended in the job's folder, and an eye on these folders. Results and ends
/// are files, so nothing is asked of the engine's own accounting.
class ExternalJobs {
 public:
  /// Writes OUT/launch/job.sh. What earlier attempts left in the jobs' folders is removed.
  ExternalJobs(const std::vector<LaunchJob>& jobs, const LaunchOptions& options);

  const std::filesystem::path& folder() const { return folder_; }  ///< OUT/launch
  const std::filesystem::path& script() const { return script_; }
  /// A file with the folders of jobs [begin, end), one a line.
  std::filesystem::path write_list(std::size_t begin, std::size_t end) const;

  /// Tells of the jobs that have ended since.
  void collect();
  std::size_t open() const { return open_.size(); }
  bool is_open(std::size_t job) const { return open_.contains(job); }
  /// Jobs [begin, end) that the engine has nothing more to do with have ended, one way or the
  /// other; waits a little for their files, which a network may show late.
  void give_up(const std::set<std::size_t>& jobs);

 private:
  bool end_one(std::size_t job, bool last_word);

  const std::vector<LaunchJob>& jobs_;
  const LaunchOptions& options_;
  std::filesystem::path folder_, script_;
  std::set<std::size_t> open_;  ///< indices into jobs_
};

/// Runs a program to its end; what it prints on stdout. A program that is missing is a UserError
/// naming the package that has it; one that fails a UserError with what it said, unless `may_fail`.
std::string run_tool(const std::vector<std::string>& words, const std::string& package,
                     bool may_fail = false);

}  // namespace plaza
