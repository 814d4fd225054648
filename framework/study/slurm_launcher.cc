#include <algorithm>
#include <charconv>
#include <chrono>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "framework/execution/stop.h"
#include "framework/study/external_launcher.h"
#include "framework/study/launcher.h"
#include "plaza/core/error.h"
#include "plaza/io/output_file.h"

namespace plaza {
namespace {

constexpr const char* kPackage = "slurm-wlm";
constexpr std::size_t kMostTasks = 1000;  // of an array; Slurm's MaxArraySize is 1001 by default
constexpr std::chrono::milliseconds kSlurmPoll{200};
// squeue asks the controller of the whole cluster, so not too often
constexpr int kPollsPerQuestion = 10;

/// Arrays of jobs on a Slurm cluster that shares the study's folder and this program.
class SlurmLauncher {
 public:
  SlurmLauncher(const std::vector<LaunchJob>& jobs, const LaunchOptions& options)
      : jobs_(jobs), options_(options), external_(jobs, options) {}

  void run() {
    cancel_earlier();
    for (std::size_t begin = 0; begin < jobs_.size(); begin += kMostTasks) {
      submit(begin, std::min(begin + kMostTasks, jobs_.size()));
    }
    for (int poll = 1; external_.open() > 0; ++poll) {
      if (stop_requested()) return cancel();
      external_.collect();
      if (poll % kPollsPerQuestion == 0) ask();
      std::this_thread::sleep_for(kSlurmPoll);
    }
    write_file(ids_file(), "");
  }

 private:
  struct Array {
    std::string id;
    std::size_t begin = 0, end = 0;
  };

  std::filesystem::path ids_file() const { return external_.folder() / "slurm-arrays"; }

  void submit(std::size_t begin, std::size_t end) {
    const auto list = external_.write_list(begin, end);
    const auto batch = external_.folder() / ("slurm-" + std::to_string(begin) + ".sh");
    write_file(batch, "#!/bin/sh\nfolder=$(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" " +
                          shell_quoted(list.string()) + ")\nexec " +
                          shell_quoted(external_.script().string()) + " \"$folder\"\n");
    const std::string text = run_tool(
        {"sbatch", "--parsable", "--job-name=plaza-study", "--output=/dev/null",
         "--error=/dev/null", "--chdir=" + external_.folder().string(),
         "--array=0-" + std::to_string(end - begin - 1) + "%" + std::to_string(options_.jobs),
         "--cpus-per-task=" + std::to_string(options_.threads), batch.string()},
        kPackage);
    // "123" or "123;cluster", behind warnings where there are some
    std::istringstream lines(text);
    std::string id;
    for (std::string line; std::getline(lines, line);) id = line.substr(0, line.find(';'));
    if (id.empty() ||
        !std::all_of(id.begin(), id.end(), [](char c) { return c >= '0' && c <= '9'; })) {
      throw UserError("sbatch gave no job number: " + text);
    }
    arrays_.push_back({id, begin, end});
    std::string ids;
    for (const Array& array : arrays_) ids += array.id + "\n";
    write_file(ids_file(), ids);
  }

  /// Tasks of an array that wait or work. One that Slurm has forgotten has none.
  static std::set<std::size_t> active_tasks(const std::string& id) {
    const std::string text = run_tool(
        {"squeue", "--noheader", "--array", "--jobs", id, "--states", "all", "--format", "%K %T"},
        kPackage, true);
    std::set<std::size_t> active;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::size_t task = 0;
      std::string state;
      if (!(words >> task >> state)) continue;  // what squeue says of a number it does not know
      const bool ended = state == "COMPLETED" || state == "FAILED" || state == "CANCELLED" ||
                         state == "TIMEOUT" || state == "NODE_FAIL" || state == "OUT_OF_MEMORY" ||
                         state == "DEADLINE" || state == "BOOT_FAIL" || state == "REVOKED";
      if (!ended) active.insert(task);
    }
    return active;
  }

  void ask() {
    for (const Array& array : arrays_) {
      std::set<std::size_t> ended;
      for (std::size_t j = array.begin; j < array.end; ++j) {
        if (external_.is_open(j)) ended.insert(j);
      }
      if (ended.empty()) continue;
      for (const std::size_t task : active_tasks(array.id)) ended.erase(array.begin + task);
      external_.give_up(ended);
    }
  }

  void cancel() {
    for (const Array& array : arrays_) cancel_array(array.id);
    external_.collect();
  }

  static void cancel_array(const std::string& id) {
    run_tool({"scancel", id}, kPackage, true);
    constexpr int kSeconds = 60;
    for (int i = 0; i < kSeconds * 5 && !active_tasks(id).empty(); ++i) {
      std::this_thread::sleep_for(kSlurmPoll);
    }
  }

  /// What a start that was killed has left in the queue would compute the same a second time.
  void cancel_earlier() const {
    std::ifstream in(ids_file());
    for (std::string id; std::getline(in, id);) {
      if (!id.empty()) cancel_array(id);
    }
  }

  const std::vector<LaunchJob>& jobs_;
  const LaunchOptions& options_;
  ExternalJobs external_;
  std::vector<Array> arrays_;
};

}  // namespace

void launch_slurm(const std::vector<LaunchJob>& jobs, const LaunchOptions& options) {
  SlurmLauncher(jobs, options).run();
}

}  // namespace plaza
