#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <set>
#include <thread>

#include "framework/execution/stop.h"
#include "framework/study/child_process.h"
#include "framework/study/launcher.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr std::chrono::milliseconds kPoll{5};
// what a job that was asked to end may still write
constexpr std::chrono::seconds kPatience{10};

class LocalLauncher {
 public:
  LocalLauncher(const std::vector<LaunchJob>& jobs, const LaunchOptions& options)
      : options_(options) {
    for (const LaunchJob& job : jobs) pending_.push_back(&job);
  }
  ~LocalLauncher() {
    for (const Running& running : running_) {
      ::kill(running.child, SIGKILL);
      ::waitpid(running.child, nullptr, 0);
    }
  }
  LocalLauncher(const LocalLauncher&) = delete;
  LocalLauncher& operator=(const LocalLauncher&) = delete;

  void run() {
    while (!pending_.empty() || !running_.empty()) {
      if (stop_requested()) return end_all();
      while (running_.size() < static_cast<std::size_t>(options_.jobs) && start_one()) {
      }
      if (!reap()) std::this_thread::sleep_for(kPoll);
    }
  }

 private:
  struct Running {
    const LaunchJob* job = nullptr;
    pid_t child = 0;
  };

  /// What a running job computes for the first time in this study, another one would wait for, to
  /// find it in the cache then. What was computed once is there, or was not worth keeping.
  bool would_repeat(const LaunchJob& job) const {
    return std::any_of(running_.begin(), running_.end(), [&](const Running& running) {
      const auto shared = [&](const std::string& key) {
        const auto& keys = running.job->node_keys;
        return !computed_.contains(key) && std::find(keys.begin(), keys.end(), key) != keys.end();
      };
      return std::any_of(job.node_keys.begin(), job.node_keys.end(), shared);
    });
  }

  bool start_one() {
    if (pending_.empty()) return false;
    auto next = std::find_if(pending_.begin(), pending_.end(),
                             [this](const LaunchJob* job) { return !would_repeat(*job); });
    // rather than leave a place empty: it waits by itself, and goes on as soon as what it waits for
    // is kept, or turns out not worth keeping
    if (next == pending_.end()) next = pending_.begin();
    const LaunchJob* job = *next;
    pending_.erase(next);
    std::vector<std::string> words = options_.program;
    words.insert(words.end(), {"study-job", job->folder.string()});
    words.insert(words.end(), options_.job_options.begin(), options_.job_options.end());
    running_.push_back({job, start_child(words, job->folder / "log.txt")});
    options_.on_start(*job);
    return true;
  }

  bool reap() {
    bool any = false;
    for (std::size_t i = 0; i < running_.size();) {
      int status = 0;
      const pid_t ended = ::waitpid(running_[i].child, &status, WNOHANG);
      if (ended == 0 || (ended < 0 && errno == EINTR)) {
        ++i;
        continue;
      }
      const LaunchJob* job = running_[i].job;
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      computed_.insert(job->node_keys.begin(), job->node_keys.end());
      any = true;
      const bool killed =
          WIFSIGNALED(status) && (WTERMSIG(status) == SIGKILL || WTERMSIG(status) == SIGTERM ||
                                  WTERMSIG(status) == SIGINT);
      options_.on_end({.index = job->index, .crash = signal_text(status), .again = killed});
    }
    return any;
  }

  /// As Ctrl-C ends a run: what is complete is written; then for good.
  void end_all() {
    for (const Running& running : running_) ::kill(running.child, SIGINT);
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!running_.empty() && std::chrono::steady_clock::now() < end) {
      if (!reap()) std::this_thread::sleep_for(kPoll);
    }
  }

  const LaunchOptions& options_;
  std::vector<const LaunchJob*> pending_;
  std::vector<Running> running_;
  std::set<std::string> computed_;  ///< keys of jobs that ended
};

}  // namespace

void launch_local(const std::vector<LaunchJob>& jobs, const LaunchOptions& options) {
  LocalLauncher(jobs, options).run();
}

}  // namespace plaza
