#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace plaza {

/// Says how far a study is: on a terminal one line that renews itself, on stderr; elsewhere a plain
/// line per job that ended.
class StudyProgress {
 public:
  /// `total` jobs, `done` of them before this start; `at_once`: how many work side by side.
  StudyProgress(std::size_t total, std::size_t done, bool quiet);
  ~StudyProgress();
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;

  void started();
  /// One job ended; `trouble` empty: well.
  void ended(const std::string& title, const std::string& trouble);

 private:
  using Clock = std::chrono::steady_clock;
  void show(const std::string& event);

  std::size_t total_;
  std::size_t before_;
  std::size_t ended_ = 0, failed_ = 0, running_ = 0;
  bool quiet_;
  bool terminal_;
  bool line_open_ = false;
  Clock::time_point start_ = Clock::now();
};

}  // namespace plaza
