// Studies as their users meet them: run, interrupted, killed, with variants that fail or crash.
#include <gmock/gmock.h>

#include <random>

#include "tests/framework/study/study_program.h"

namespace plaza::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class StudyRun : public StudyProgram {
 protected:
  /// Two associators on two lengths, with two seeds: eight runs that take `delay_us` a frame.
  void write_small_study(std::int64_t delay_us) {
    write_pipeline(40, delay_us);
    write_study({{"name", "Small"},
                 {"axes",
                  {{{"set", "/nodes/tracks/delay"}, {"values", {1, 5}}},
                   {{"set", "/nodes/cameras/frames"}, {"values", {20, 30}}}}},
                 {"seeds", {1, 2}},
                 {"baseline", {{"delay", 1}}}});
  }
};

TEST_F(StudyRun, GivesOneRowPerVariantRepetitionAndMetric) {
  write_small_study(0);
  ASSERT_EQ(run("out", {"--jobs", "2"}), 0) << errors("out");
  const auto rows = lines_of(folder_ / "out/results.csv");
  ASSERT_EQ(rows.size(), 1U + 8 * 2);
  EXPECT_EQ(rows[0],
            "delay,frames,repetition,seed,status,branch,section,metric,unit,better,value,error");
  EXPECT_EQ(rows[1], "1,20,1,1,done,,tracking,points,,higher,40,");
  EXPECT_EQ(rows[2], "1,20,1,1,done,,tracking,truth,,neither,20,");
  EXPECT_EQ(rows[16], "5,30,2,2,done,,tracking,truth,,neither,30,");
  EXPECT_THAT(printed("out"), AllOf(HasSubstr("4 variants, 8 runs, 8 done"), HasSubstr("delay=5")));
  EXPECT_THAT(errors("out"), HasSubstr("study: 8 of 8 runs"));
  EXPECT_EQ(lines_of(folder_ / "out/times.csv").size(), 1U + 8);
}

TEST_F(StudyRun, TheSameTablesWhateverTheNumberOfJobsAndAgain) {
  write_small_study(0);
  ASSERT_EQ(run("one"), 0);
  ASSERT_EQ(run("three", {"--jobs", "3"}), 0);
  EXPECT_EQ(tables("one"), tables("three"));
  const auto before = fs::last_write_time(folder_ / "one/jobs");
  ASSERT_EQ(run("one"), 0);
  EXPECT_EQ(tables("one"), tables("three"));
  EXPECT_EQ(before, fs::last_write_time(folder_ / "one/jobs"));
  EXPECT_THAT(errors("one"), Not(HasSubstr("study: 1 of 8"))) << "nothing was left to do";
}

TEST_F(StudyRun, KilledAtFiveRandomMomentsItEndsWithTheSameTable) {
  write_small_study(2000);
  ASSERT_EQ(run("whole", {"--jobs", "2"}), 0);
  std::mt19937 random(5);
  std::size_t done = 0;
  for (int kill = 0; kill < 5; ++kill) {
    const pid_t child = start("killed", {"--jobs", "2"});
    std::this_thread::sleep_for(
        std::chrono::milliseconds(std::uniform_int_distribution(20, 400)(random)));
    ::kill(kill % 2 == 0 ? -child : child, SIGKILL);  // the whole group, or its leader alone
    end_of(child);
    EXPECT_GE(results_in(folder_ / "killed"), done) << "what is done stays done";
    done = results_in(folder_ / "killed");
  }
  ASSERT_EQ(run("killed", {"--jobs", "2"}), 0) << errors("killed");
  EXPECT_EQ(tables("killed"), tables("whole"));
}

TEST_F(StudyRun, CtrlCEndsItCleanlyAndItGoesOn) {
  write_small_study(5000);
  const pid_t child = start("out");
  await_results(child, folder_ / "out", 2);
  ::kill(child, SIGINT);
  EXPECT_EQ(end_of(child), 130);
  EXPECT_THAT(errors("out"), HasSubstr("interrupted; the same command goes on"));
  EXPECT_THAT(printed("out"), HasSubstr("has not been run"));
  const std::size_t done = results_in(folder_ / "out");
  EXPECT_GE(done, 2U);
  EXPECT_LT(done, 8U);
  ASSERT_EQ(run("out"), 0);
  EXPECT_THAT(errors("out"), HasSubstr(std::to_string(done) + " were done before"));
  EXPECT_THAT(printed("out"), HasSubstr("8 runs, 8 done"));
}

TEST_F(StudyRun, AVariantThatFailsOrCrashesDoesNotStopTheOthers) {
  write_mixed_study({});
  ASSERT_EQ(run("out", {"--jobs", "2"}), 0) << errors("out");
  const std::string csv = read_text(folder_ / "out/results.csv");
  EXPECT_THAT(csv, AllOf(HasSubstr("none,1,,done,,tracking,points"),
                         HasSubstr("late,1,,done,,tracking,points"),
                         HasSubstr("fault,1,,failed,,,,,,,\"node 'tracks', frame 8: "),
                         HasSubstr("crash,1,,failed,,,,,,,ended by signal 6 (Aborted)")));
  EXPECT_THAT(printed("out"), AllOf(HasSubstr("without result"), HasSubstr("4 runs, 2 done"),
                                    HasSubstr("trouble=crash: ended by signal 6")));
  const auto before = tables("out");
  ASSERT_EQ(run("out"), 0);
  EXPECT_THAT(errors("out"), Not(HasSubstr("trouble=fault"))) << "what failed would fail again";
  ASSERT_EQ(run("out", {"--retry"}), 0);
  EXPECT_THAT(errors("out"), HasSubstr("trouble=fault")) << "unless one asks for it";
  EXPECT_EQ(tables("out"), before);
}

TEST_F(StudyRun, WhatFailedBecauseOfAFullDiskIsTriedAgain) {
  write_pipeline(20, 0);
  const json full = {{"/nodes/tracks/fail_in", "process"},
                     {"/nodes/tracks/fail_at", 7},
                     {"/nodes/tracks/error", "full"}};
  write_study({{"axes",
                {{{"name", "disk"},
                  {"choices", {{{"name", "room"}}, {{"name", "full"}, {"set", full}}}}}}}});
  EXPECT_EQ(run("out"), 3);
  EXPECT_THAT(errors("out"), AllOf(HasSubstr("disk=full: node 'tracks', frame 8: cannot write: "
                                             "the disk is full; start the study again"),
                                   HasSubstr("the same command tries them again")));
  EXPECT_THAT(read_text(folder_ / "out/results.csv"), HasSubstr("room,1,,done"));
  EXPECT_EQ(run("out"), 3);
  EXPECT_THAT(errors("out"), AllOf(HasSubstr("1 were done before"), HasSubstr("disk=full: ")))
      << "without --retry";
}

TEST_F(StudyRun, AFullDiskIsFilledUpAndThenHasRoom) {
  if (std::system("unshare --user --map-root-user --mount true 2> /dev/null") != 0) {
    GTEST_SKIP() << "this system lets no process mount a file system of its own";
  }
  write_pipeline(6000, 0);
  write_study({{"axes", {{{"set", "/nodes/tracks/delay"}, {"values", {1}}}}}});
  const fs::path disk = folder_ / "disk";
  fs::create_directory(disk);
  const std::string study = std::string(PLAZA_STUDY_PROGRAM) + " study '" +
                            (folder_ / "study.json").string() + "' --plugin-path '" +
                            PLAZA_STUDY_DOUBLES + "' --cache-dir '" + (folder_ / "c").string() +
                            "' --out '" + (disk / "out").string() + "' --quiet";
  write_text(folder_ / "script.sh",
             "cd '" + folder_.path().string() +
                 "' && mount -t tmpfs -o size=512k disk disk || exit 99\n" + study +
                 " 2> first; echo $? > status\nmount -o remount,size=64m disk\n" + study +
                 " 2> second; status=$?; cp disk/out/results.csv .; exit $status\n");
  const std::string script = (folder_ / "script.sh").string();
  const int status =
      std::system(("unshare --user --map-root-user --mount sh '" + script + "'").c_str());
  EXPECT_THAT(read_text(folder_ / "status"), testing::AnyOf("2\n", "3\n"));
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << read_text(folder_ / "second");
  EXPECT_THAT(read_text(folder_ / "results.csv"), HasSubstr("1,1,,done,,tracking,points"));
}

TEST_F(StudyRun, AChangedStudyKeepsWhatIsStillOfUse) {
  write_small_study(0);
  ASSERT_EQ(run("out"), 0);
  json study = json::parse(read_text(folder_ / "study.json"));
  study["axes"][0]["values"] = {1, 5, 9};
  write_study(study);
  ASSERT_EQ(run("out"), 0);
  EXPECT_THAT(errors("out"), AllOf(HasSubstr("8 were done before"), HasSubstr("12 of 12")));
}

TEST_F(StudyRun, DamagedResultsAreComputedAgain) {
  write_small_study(0);
  ASSERT_EQ(run("out"), 0);
  const auto before = tables("out");
  int damaged = 0;
  for (const auto& job : fs::directory_iterator(folder_ / "out/jobs")) {
    std::string text = read_text(job.path() / "result.json");
    const auto at = text.find("\"points\":");
    ASSERT_NE(at, std::string::npos);
    text[at + 9] = text[at + 9] == '9' ? '8' : '9';  // another figure, still JSON
    write_text(job.path() / "result.json", damaged++ % 2 == 0 ? text : text.substr(0, at));
  }
  ASSERT_EQ(run("out"), 0);
  EXPECT_THAT(errors("out"), HasSubstr("study: 1 of 8"));
  EXPECT_EQ(tables("out"), before);
}

TEST_F(StudyRun, TwoAtATimeInOneFolderAreRefused) {
  write_small_study(5000);
  const pid_t first = start("out");
  await_results(first, folder_ / "out", 1);
  fs::create_directory(folder_ / "elsewhere");
  EXPECT_EQ(run("out"), 2);
  EXPECT_THAT(errors("out"), HasSubstr("a study is at work in"));
  EXPECT_EQ(end_of(first), 0);
}

TEST_F(StudyRun, FaultsEndItBeforeAnythingIsWritten) {
  write_pipeline(20, 0);
  write_study({{"axes", {{{"set", "/nodes/tracks/delay"}, {"values", {1, -1}}}}}});
  EXPECT_EQ(run("out"), 2);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(run("out", {"--check"}), 2);
  write_small_study(0);
  EXPECT_EQ(run("out", {"--check"}), 0);
  EXPECT_THAT(printed("out"), HasSubstr("4 variants, 8 runs, 2 metrics"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace plaza::test
