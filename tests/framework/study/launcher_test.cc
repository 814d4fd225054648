// Studies on other engines: the same tables as child processes give, whatever happens to single
// runs.
#include <gmock/gmock.h>

#include <cstdlib>
#include <memory>

#include "tests/framework/study/study_program.h"

namespace plaza::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class LauncherTest : public StudyProgram {
 protected:
  void expect_same_tables(const std::vector<std::string>& options) {
    write_mixed_study({1, 2});
    ASSERT_EQ(run("local", {"--jobs", "2"}), 0) << errors("local");
    ASSERT_EQ(run("engine", options), 0) << errors("engine");
    EXPECT_EQ(tables("engine"), tables("local"));
    EXPECT_THAT(tables("engine")[0], AllOf(HasSubstr("crash,2,2,failed,,,,,,,ended by signal 6"),
                                           HasSubstr("late,2,2,done")));
  }

  void expect_goes_on_after_ctrl_c(const std::vector<std::string>& options) {
    write_mixed_study({1, 2}, 15000);
    const pid_t child = start("engine", options);
    await_results(child, folder_ / "engine", 2);
    ::kill(child, SIGINT);
    EXPECT_EQ(end_of(child), 130) << errors("engine");
    EXPECT_LT(results_in(folder_ / "engine"), 8U);
    ASSERT_EQ(run("engine", options), 0) << errors("engine");
    EXPECT_THAT(errors("engine"), HasSubstr("were done before"));
    ASSERT_EQ(run("local", {"--jobs", "2"}), 0);
    EXPECT_EQ(tables("engine"), tables("local"));
  }
};

TEST_F(LauncherTest, HostsAreForParallelAlone) {
  write_mixed_study({1, 2});
  EXPECT_EQ(run("out", {"--hosts", "one"}), 2);
  EXPECT_THAT(errors("out"), HasSubstr("--hosts is for --launcher parallel"));
}

TEST_F(LauncherTest, AClusterThatRefusesIsTheUsersError) {
  write_mixed_study({1, 2});
  const auto sbatch = folder_.folder("bin") / "sbatch";
  write_text(sbatch, "#!/bin/sh\necho the queue is closed >&2\nexit 1\n");
  fs::permissions(sbatch, fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (sbatch.parent_path().string() + ":" + path).c_str(), 1);
  EXPECT_EQ(run("engine", {"--launcher", "slurm"}), 2);
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(errors("engine"), HasSubstr("sbatch failed: the queue is closed"));
}

class ParallelTest : public LauncherTest {
 protected:
  void SetUp() override {
    if (std::system("parallel --version >/dev/null 2>&1") != 0) {
      GTEST_SKIP() << "GNU parallel is not installed (Debian's package parallel)";
    }
    LauncherTest::SetUp();
  }
};

TEST_F(ParallelTest, GivesTheSameTables) {
  expect_same_tables({"--launcher", "parallel", "--jobs", "2"});
  EXPECT_EQ(lines_of(folder_ / "engine/launch/parallel.joblog").size(), 8U);
}

TEST_F(ParallelTest, TakesAListOfHosts) {
  expect_same_tables({"--launcher", "parallel", "--hosts", "2/:"});
}

TEST_F(ParallelTest, GoesOnAfterCtrlC) {
  expect_goes_on_after_ctrl_c({"--launcher", "parallel", "--jobs", "2"});
}

/// A cluster of this machine alone, for all tests below.
class SlurmTest : public LauncherTest {
 protected:
  static void SetUpTestSuite() {
    cluster_ = std::make_unique<TemporaryFolder>();
    const int status =
        std::system((script("start") + " >" + (*cluster_ / "said").string()).c_str());
    if (WEXITSTATUS(status) == 77) {
      skip_ = read_text(*cluster_ / "said");
    } else if (status != 0) {
      skip_ = "";
      broken_ = true;
    }
    ::setenv("SLURM_CONF", (*cluster_ / "slurm.conf").c_str(), 1);
  }
  static void TearDownTestSuite() {
    EXPECT_EQ(std::system(script("stop").c_str()), 0);
    ::unsetenv("SLURM_CONF");
    cluster_.reset();
  }
  static std::string script(const std::string& what) {
    return std::string(PLAZA_SOURCE_DIR) + "/tests/framework/study/slurm_cluster " + what + " " +
           cluster_->path().string();
  }
  void SetUp() override {
    if (!skip_.empty()) GTEST_SKIP() << skip_;
    ASSERT_FALSE(broken_) << "the cluster did not start";
    LauncherTest::SetUp();
  }

  static inline std::unique_ptr<TemporaryFolder> cluster_;
  static inline std::string skip_;
  static inline bool broken_ = false;
};

TEST_F(SlurmTest, GivesTheSameTables) {
  expect_same_tables({"--launcher", "slurm", "--jobs", "2"});
}

TEST_F(SlurmTest, GoesOnAfterCtrlCAndLeavesNothingInTheQueue) {
  expect_goes_on_after_ctrl_c({"--launcher", "slurm", "--jobs", "2"});
  EXPECT_EQ(std::system("test -z \"$(squeue --noheader)\""), 0);
}

TEST_F(SlurmTest, ATaskThatIsCancelledIsTriedAgainByTheNextStart) {
  write_mixed_study({1, 2}, 15000);
  const std::vector<std::string> options = {"--launcher", "slurm", "--jobs", "2"};
  const pid_t child = start("engine", options);
  await_results(child, folder_ / "engine", 1);
  EXPECT_EQ(std::system("scancel --name=plaza-study"), 0);
  EXPECT_EQ(end_of(child), 3) << errors("engine");
  EXPECT_THAT(printed("engine"), HasSubstr("from outside; start the study again"));
  ASSERT_EQ(run("engine", options), 0) << errors("engine");
  ASSERT_EQ(run("local", {"--jobs", "2"}), 0);
  EXPECT_EQ(tables("engine"), tables("local"));
}

}  // namespace
}  // namespace plaza::test
