#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <set>
#include <thread>

#include "framework/execution/stop.h"
#include "framework/study/child_process.h"
#include "framework/study/external_launcher.h"
#include "framework/study/launcher.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr std::chrono::milliseconds kParallelPoll{50};
constexpr std::chrono::seconds kParallelPatience{10};

/// The whole of what was started: GNU parallel and all below it.
void end_group(pid_t child) {
  // the first makes it start nothing more, the second ends what is at work
  ::kill(child, SIGTERM);
  std::this_thread::sleep_for(kParallelPoll);
  ::kill(-child, SIGTERM);
  const auto until = std::chrono::steady_clock::now() + kParallelPatience;
  while (::waitpid(child, nullptr, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > until) {
      ::kill(-child, SIGKILL);
      ::waitpid(child, nullptr, 0);
      return;
    }
    std::this_thread::sleep_for(kParallelPoll);
  }
}

}  // namespace

void launch_parallel(const std::vector<LaunchJob>& jobs, const LaunchOptions& options) {
  run_tool({"parallel", "--version"}, "parallel");
  ExternalJobs external(jobs, options);
  const auto list = external.write_list(0, jobs.size());
  // which jobs are left is decided by their results: positions in a list, which --resume goes by,
  // mean other jobs as soon as the study has changed. The log is resumed, so that it is of all
  // starts.
  const auto log = external.folder() / "parallel.joblog";
  std::vector<std::string> words = {"parallel",   "--will-cite",
                                    "--halt",     "never",
                                    "--jobs",     std::to_string(options.jobs),
                                    "--joblog",   std::string("+").append(log.string()),
                                    "--arg-file", list.string()};
  if (!options.hosts.empty()) words.insert(words.end(), {"--sshlogin", options.hosts});
  words.push_back(shell_quoted(external.script().string()).append(" {}"));
  const pid_t child = start_child(words, external.folder() / "parallel.txt");
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (stop_requested()) {
      end_group(child);
      external.collect();
      return;
    }
    external.collect();
    std::this_thread::sleep_for(kParallelPoll);
  }
  std::set<std::size_t> all;
  for (std::size_t j = 0; j < jobs.size(); ++j) all.insert(j);
  external.give_up(all);
}

}  // namespace plaza
