#include "framework/study/external_launcher.h"

#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>
#include <thread>

#include "framework/study/child_process.h"
#include "plaza/core/error.h"
#include "plaza/io/output_file.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

// how late a network's file system may show what another machine has written
constexpr std::chrono::seconds kLateFiles{5};
constexpr int kSignalBase = 128;  // of exit statuses, as shells give them
constexpr int kNoProgram = 127;

std::optional<int> exit_status_of(const fs::path& folder) {
  std::ifstream in(folder / "exit");
  int status = 0;
  if (!(in >> status)) return std::nullopt;
  return status;
}

}  // namespace

std::string shell_quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  quoted += '\'';
  return quoted;
}

ExternalJobs::ExternalJobs(const std::vector<LaunchJob>& jobs, const LaunchOptions& options)
    : jobs_(jobs), options_(options), folder_(options.out / "launch"), script_(folder_ / "job.sh") {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw UserError("cannot create " + folder_.string() + ": " + error.message());
  std::string command;
  for (const std::string& word : options.program) command += shell_quoted(word) + " ";
  command += "study-job \"$1\"";
  for (const std::string& word : options.job_options)
    command.append(" ").append(shell_quoted(word));
  write_file(script_,
             "#!/bin/sh\n"
             "# Runs one job of a study, and leaves how its process ended beside its log.\n" +
                 command +
                 " >>\"$1/log.txt\" 2>&1\n"
                 "status=$?\n"
                 "echo $status >\"$1/exit.part\" && mv \"$1/exit.part\" \"$1/exit\"\n"
                 "exit $status\n");
  fs::permissions(script_, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add, error);
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    fs::remove(jobs[j].folder / "exit", error);
    open_.insert(j);
    options.on_start(jobs[j]);
  }
}

fs::path ExternalJobs::write_list(std::size_t begin, std::size_t end) const {
  std::string text;
  for (std::size_t j = begin; j < end; ++j) text += jobs_[j].folder.string() + "\n";
  fs::path file = folder_ / ("jobs-" + std::to_string(begin) + ".list");
  write_file(file, text);
  return file;
}

bool ExternalJobs::end_one(std::size_t job, bool last_word) {
  const fs::path& folder = jobs_[job].folder;
  const auto status = exit_status_of(folder);
  if (!status && !last_word) return false;
  LaunchEnd end;
  end.index = jobs_[job].index;
  if (!status) {
    end.crash = "ended without a word";
    end.again = true;
  } else if (*status > kSignalBase) {
    const int signal = *status - kSignalBase;
    end.crash = signal_words(signal);
    end.again = signal == SIGKILL || signal == SIGTERM || signal == SIGINT;
  }
  options_.on_end(end);
  return true;
}

void ExternalJobs::collect() {
  std::erase_if(open_, [this](std::size_t job) { return end_one(job, false); });
}

void ExternalJobs::give_up(const std::set<std::size_t>& jobs) {
  const auto any_open = [&] {
    for (const std::size_t job : jobs) {
      if (open_.contains(job)) return true;
    }
    return false;
  };
  const auto until = std::chrono::steady_clock::now() + kLateFiles;
  while (any_open() && std::chrono::steady_clock::now() < until) {
    collect();
    if (any_open()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  for (const std::size_t job : jobs) {
    if (open_.erase(job) != 0) end_one(job, true);
  }
}

std::string run_tool(const std::vector<std::string>& words, const std::string& package,
                     bool may_fail) {
  std::string command;
  for (const std::string& word : words) command += shell_quoted(word) + " ";
  std::FILE* const pipe = ::popen((command + "2>&1").c_str(), "r");
  if (pipe == nullptr) throw UserError("cannot start " + words[0] + ": " + std::strerror(errno));
  std::string text;
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) {
    text.append(block.data(), count);
  }
  const int status = ::pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoProgram) {
    throw UserError(words[0] + " is not installed (Debian's package " + package + ")");
  }
  if (status != 0 && !may_fail) {
    throw UserError(words[0] + " failed: " + text);
  }
  return text;
}

}  // namespace plaza
