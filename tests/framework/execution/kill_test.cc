// Death without warning, at any moment: whatever bears its final name is valid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/support/execution_fixture.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::lines_of;
using test::plain_nodes;

constexpr const char* kFolder = "PLAZA_KILL_TEST_FOLDER";
constexpr const char* kFrames = "PLAZA_KILL_TEST_FRAMES";
constexpr const char* kThreads = "PLAZA_KILL_TEST_THREADS";

class KillTest : public test::RunFixture {
 protected:
  /// Starts this program again, to run a pipeline in `folder_`, and kills it after `delay` unless
  /// it ends before. True when it ended by itself, well.
  bool run_and_kill(std::int64_t frames, int threads, std::chrono::microseconds delay) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::setenv(kFolder, folder_.path().c_str(), 1);
      ::setenv(kFrames, std::to_string(frames).c_str(), 1);
      ::setenv(kThreads, std::to_string(threads).c_str(), 1);
      ::execl("/proc/self/exe", "kill_test", "--gtest_also_run_disabled_tests",
              "--gtest_filter=KillTest.DISABLED_TheProcessToBeKilled", "--gtest_brief=1", nullptr);
      ::_exit(127);
    }
    const auto end = std::chrono::steady_clock::now() + delay;
    int status = 0;
    bool alive = true;
    while (alive && std::chrono::steady_clock::now() < end) {
      alive = ::waitpid(child, &status, WNOHANG) == 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (alive) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

  void expect_valid() {
    if (!fs::exists(folder_ / "out")) return;  // killed before the check was over
    std::int64_t frames = 0;
    bool complete = false;
    if (fs::exists(folder_ / "out/summary.json")) {
      const json s = summary();
      frames = s.at("frames");
      complete = s.at("complete");
    }
    for (const auto& [name, content] : test::contents_of(folder_ / "out")) {
      EXPECT_TRUE(!name.ends_with(".json") || json::accept(content)) << name;
      const bool rows = name.find(".csv") != std::string::npos || name.starts_with("tracks.");
      if (!rows) continue;
      EXPECT_TRUE(content.empty() || content.back() == '\n') << name << " ends within a row";
      const auto lines = lines_of(folder_ / ("out/" + name));
      for (const std::string& line : lines) {
        EXPECT_EQ(std::count(line.begin(), line.end(), ','),
                  std::count(lines[0].begin(), lines[0].end(), ','))
            << name;
      }
      EXPECT_TRUE(!complete || !name.ends_with(".part")) << name;
      if (complete && name == "tracks.ground.csv") {
        EXPECT_EQ(static_cast<std::int64_t>(lines.size()), 1 + 2 * frames);
      }
    }
  }
};

TEST_F(KillTest, DISABLED_TheProcessToBeKilled) {
  const char* const folder = std::getenv(kFolder);
  if (folder == nullptr) GTEST_SKIP() << "is started by the other test";
  json nodes = plain_nodes();
  nodes[0]["frames"] = std::atoi(std::getenv(kFrames));
  nodes[0]["delay_us"] = 20;
  const json learner = {{"use", "test-learner"}, {"name", "background"}, {"first", 20}};
  nodes.insert(nodes.begin() + 1, learner);
  nodes.push_back({{"use", "test-renderer"}, {"name", "overlay"}});
  options_.threads = std::atoi(std::getenv(kThreads));
  options_.output_folder = fs::path(folder) / "out";
  options_.cache_folder = fs::path(folder) / "cache";
  EXPECT_TRUE(run_pipeline(read(nodes), test::double_scene(), options_).complete);
}

TEST_F(KillTest, AnyMomentLeavesValidFilesAndAUsableCache) {
  std::mt19937 random(11);
  for (int i = 0; i < 20; ++i) {
    const auto delay =
        std::chrono::microseconds(std::uniform_int_distribution(5000, 400000)(random));
    run_and_kill(500, 1 + i % 3, delay);  // into the same folder: over what the last one left
    expect_valid();
  }
  ASSERT_TRUE(run_and_kill(30, 2, std::chrono::seconds(20))) << "what is left over harms nobody";
  expect_valid();
  EXPECT_EQ(summary()["complete"], true);
}

}  // namespace
}  // namespace plaza
