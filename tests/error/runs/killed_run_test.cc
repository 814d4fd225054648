// Death without warning, at any moment: whatever bears its final name is valid, and what was
// computed some seconds before is there in parts.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "tests/error/runs/program_run.h"

namespace plaza::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class KilledRun : public ProgramRun {
 protected:
  pid_t start(int threads) {
    std::vector<std::string> words = command(out_, threads);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const std::string cache = (folder_ / "cache").string();
    const pid_t child = ::fork();
    if (child == 0) {
      ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
      ::execv(arguments[0], arguments.data());
      ::_exit(127);
    }
    return child;
  }

  /// Starts a run and kills it when `enough` says so, unless it ends before. True when it ended by
  /// itself, well.
  template <class Enough>
  bool run_and_kill(int threads, const Enough& enough) {
    const pid_t child = start(threads);
    int status = 0;
    bool alive = true;
    while (alive && !enough()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      alive = ::waitpid(child, &status, WNOHANG) == 0;
    }
    if (alive) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  static auto after(Clock::duration delay) {
    return [end = Clock::now() + delay] { return Clock::now() >= end; };
  }

  const fs::path out_ = folder_ / "out";
};

TEST_F(KilledRun, AnyMomentLeavesValidFilesAndAUsableCache) {
  const nlohmann::json more = {{{"use", "test-learner"}, {"name", "background"}, {"first", 20}},
                               {{"use", "test-renderer"}, {"name", "overlay"}}};
  write_pipeline(500, 20, more);
  std::mt19937 random(11);
  for (int i = 0; i < 20; ++i) {
    const auto delay =
        std::chrono::microseconds(std::uniform_int_distribution(5000, 600000)(random));
    run_and_kill(1 + i % 3, after(delay));  // into the same folder: over what the last one left
    expect_valid(out_);
  }
  write_pipeline(30, 20, more);
  ASSERT_TRUE(run_and_kill(2, after(std::chrono::seconds(60)))) << "what is left over harms nobody";
  expect_valid(out_);
  EXPECT_EQ(summary(out_)["complete"], true);
  EXPECT_EQ(lines_of(out_ / "tracks.ground.csv").size(), 1U + 2 * 30);
}

TEST_F(KilledRun, KeepsWhatWasComputedSecondsBefore) {
  write_pipeline(100000, 1000);
  const auto given_up = after(std::chrono::seconds(60));
  EXPECT_FALSE(
      run_and_kill(2, [&] { return given_up() || fs::exists(out_ / "tracks.right.txt.part"); }));

  expect_valid(out_);
  EXPECT_EQ(summary(out_)["complete"], false);
  EXPECT_GT(lines_of(out_ / "observations.ground.csv.part").size(), 100U);
  EXPECT_GT(lines_of(out_ / "tracks.ground.csv.part").size(), 100U);
  EXPECT_GT(lines_of(out_ / "tracks.left.txt.part").size(), 100U);
  EXPECT_FALSE(fs::exists(out_ / "tracks.ground.csv"));
}

}  // namespace
}  // namespace plaza::test
