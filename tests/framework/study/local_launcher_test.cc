// Which jobs child processes are started for, and when.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/study/launcher.h"
#include "tests/support/execution_doubles.h"

namespace plaza::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

class LocalLauncherTest : public ::testing::Test {
 protected:
  /// Jobs that last until two of them have been started (then they leave "met"), or 20 seconds.
  LocalLauncherTest() {
    write_text(folder_ / "job.sh",
               "touch \"$2/started\"\nfor i in $(seq 1000); do\n"
               "  [ $(ls \"$2\"/../*/started | wc -l) -ge 2 ] && exec touch \"$2/met\"\n"
               "  sleep 0.02\ndone\n");
    options_.program = {"sh", (folder_ / "job.sh").string()};
    options_.jobs = 2;
    options_.on_start = [this](const LaunchJob& job) { started_.push_back(job.title); };
    options_.on_end = [this](const LaunchEnd& end) { crashes_ += end.crash; };
  }
  void add(const std::string& title, const std::vector<std::string>& node_keys) {
    jobs_.push_back({jobs_.size(), folder_.folder("jobs/" + title), title, node_keys});
  }
  bool met(const std::string& title) const { return fs::exists(folder_ / "jobs" / title / "met"); }

  TemporaryFolder folder_;
  LaunchOptions options_;
  std::vector<LaunchJob> jobs_;
  std::vector<std::string> started_;
  std::string crashes_;
};

TEST_F(LocalLauncherTest, PrefersWhatHasNothingToWaitFor) {
  add("a", {"shared", "1"});
  add("b", {"shared", "2"});
  add("c", {"3"});
  launch_local(jobs_, options_);
  EXPECT_THAT(started_, ElementsAre("a", "c", "b"));
  EXPECT_TRUE(met("a") && met("b") && met("c"));
  EXPECT_EQ(crashes_, "");
}

TEST_F(LocalLauncherTest, LeavesNoPlaceEmptyForWhatMayTurnOutNotWorthKeeping) {
  add("a", {"shared", "1"});
  add("b", {"shared", "2"});
  launch_local(jobs_, options_);
  EXPECT_TRUE(met("a") && met("b")) << "side by side";
}

TEST_F(LocalLauncherTest, StartsNoMoreThanThereArePlaces) {
  options_.jobs = 1;
  write_text(folder_ / "job.sh",
             "[ $(ls \"$2\"/../*/busy 2>/dev/null | wc -l) -eq 0 ] && touch \"$2/met\"\n"
             "touch \"$2/busy\"; sleep 0.1; rm \"$2/busy\"\n");
  for (const char* title : {"a", "b", "c"}) add(title, {"shared"});
  launch_local(jobs_, options_);
  EXPECT_TRUE(met("a") && met("b") && met("c"));
}

}  // namespace
}  // namespace plaza::test
