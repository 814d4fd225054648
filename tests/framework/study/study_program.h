#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/error/runs/program_run.h"

namespace plaza::test {

/// Studies of the real program over the doubles.
class StudyProgram : public ProgramRun {
 protected:
  /// Writes study.json over pipeline.json.
  void write_study(nlohmann::json study) const {
    study["plaza_study"] = 1;
    study["pipeline"] = "pipeline.json";
    write_text(folder_ / "study.json", study.dump(2));
  }

  /// A study of four variants: one that works, one that fails, one that crashes, one that works.
  void write_mixed_study(const std::vector<int>& seeds, std::int64_t delay_us = 0) {
    const auto failing = [](int frame, const char* error) {
      return nlohmann::json{{"/nodes/tracks/fail_in", "process"},
                            {"/nodes/tracks/fail_at", frame},
                            {"/nodes/tracks/error", error}};
    };
    write_pipeline(30, delay_us);
    nlohmann::json study = {{"name", "Mixed"},
                            {"axes",
                             {{{"name", "trouble"},
                               {"choices",
                                {{{"name", "none"}},
                                 {{"name", "fault"}, {"set", failing(7, "user")}},
                                 {{"name", "crash"}, {"set", failing(3, "crash")}},
                                 {{"name", "late"}, {"set", {{"/nodes/tracks/delay", 9}}}}}}}}},
                            {"baseline", {{"trouble", "none"}}}};
    if (!seeds.empty()) study["seeds"] = seeds;
    write_study(std::move(study));
  }

  /// Starts `plaza study` as leader of a process group of its own.
  pid_t start(const std::string& out, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words = {PLAZA_STUDY_PROGRAM,
                                      "study",
                                      (folder_ / "study.json").string(),
                                      "--plugin-path",
                                      PLAZA_STUDY_DOUBLES,
                                      "--cache-dir",
                                      (folder_ / (out + "-cache")).string(),
                                      "--out",
                                      (folder_ / out).string()};
    words.insert(words.end(), options.begin(), options.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const std::string printed = (folder_ / (out + ".printed")).string();
    const pid_t child = ::fork();
    if (child == 0) {
      ::setpgid(0, 0);
      if (std::freopen(printed.c_str(), "w", stdout) == nullptr ||
          std::freopen((printed + "-errors").c_str(), "w", stderr) == nullptr) {
        ::_exit(126);
      }
      ::execv(arguments[0], arguments.data());
      ::_exit(127);
    }
    return child;
  }

  /// Its exit status, or 128 + the signal that ended it.
  static int end_of(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  int run(const std::string& out, const std::vector<std::string>& options = {}) const {
    return end_of(start(out, options));
  }

  std::string printed(const std::string& out) const {
    return read_text(folder_ / (out + ".printed"));
  }
  std::string errors(const std::string& out) const {
    return read_text(folder_ / (out + ".printed-errors"));
  }

  /// What must be equal in every run of a study.
  std::vector<std::string> tables(const std::string& out) const {
    return {read_text(folder_ / (out + "/results.csv")), read_text(folder_ / (out + "/report.md"))};
  }

  static std::size_t results_in(const std::filesystem::path& out) {
    std::size_t count = 0;
    if (!std::filesystem::exists(out / "jobs")) return 0;
    for (const auto& job : std::filesystem::directory_iterator(out / "jobs")) {
      count += std::filesystem::exists(job.path() / "result.json") ? 1 : 0;
    }
    return count;
  }

  /// Until that many runs are done, or the study has ended without; however slow the machine is.
  static void await_results(pid_t study, const std::filesystem::path& out, std::size_t count) {
    siginfo_t ended = {};
    while (results_in(out) < count && ended.si_pid != study) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ::waitid(P_PID, static_cast<id_t>(study), &ended, WEXITED | WNOHANG | WNOWAIT);
    }
  }
};

}  // namespace plaza::test
