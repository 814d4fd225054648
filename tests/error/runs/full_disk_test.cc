// A disk that fills up while a run goes on: a small file system of memory, mounted where only the
// run sees it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "tests/error/runs/program_run.h"

namespace plaza::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class FullDisk : public ProgramRun {
 protected:
  void SetUp() override {
    ProgramRun::SetUp();
    if (std::system("unshare --user --map-root-user --mount true 2> /dev/null") != 0) {
      GTEST_SKIP() << "this system lets no process mount a file system of its own";
    }
    fs::create_directory(disk_);
  }

  /// Runs the pipeline onto a disk of `size`, beside it `neighbour` (a shell command), and copies
  /// what was left there to `out_`. Returns the run's exit status.
  int run(const std::string& size, const std::string& neighbour = "true") {
    std::string words;
    for (const std::string& word : command(disk_ / "out", 2)) words += "'" + word + "' ";
    const std::string script =
        "mount -t tmpfs -o size=" + size + " disk '" + disk_.string() + "' || exit 99; cd '" +
        disk_.string() + "'; (" + neighbour + ") & " + words + "2> '" + errors_.string() +
        "'; status=$?; wait; cp -r out '" + out_.string() + "'; exit $status";
    write_text(folder_ / "script.sh", script);
    const int status = std::system(
        ("unshare --user --map-root-user --mount sh '" + (folder_ / "script.sh").string() + "'")
            .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  const fs::path disk_ = folder_ / "disk";
  const fs::path out_ = folder_ / "out";
  const fs::path errors_ = folder_ / "errors.txt";
};

TEST_F(FullDisk, ANeighbourThatFillsItTakesNothingAwayThatWasComputed) {
  write_pipeline(1000000, 500);
  // waits until the run has held back its reserve, then takes all that is left
  const int status = run("8m",
                         "while [ ! -e out/observations.ground.csv.part ]; do sleep 0.05; done; "
                         "dd if=/dev/zero of=filler bs=4k 2> /dev/null");
  EXPECT_EQ(status, 2);
  EXPECT_THAT(read_text(errors_), AllOf(HasSubstr("No space left on device"),
                                        HasSubstr("free some space or write to another folder")));
  expect_valid(out_);
  const nlohmann::json s = summary(out_);
  EXPECT_EQ(s["complete"], false);
  EXPECT_THAT(s["reason"].get<std::string>(), HasSubstr("No space left on device"));
  const auto frames = s["frames"].get<std::size_t>();
  ASSERT_GT(frames, 100U);
  // two people in every frame
  EXPECT_EQ(lines_of(out_ / "tracks.ground.csv").size(), 1 + 2 * frames);
  EXPECT_EQ(lines_of(out_ / "observations.ground.csv").size(), 1 + 2 * frames);
}

TEST_F(FullDisk, OneTooSmallForTheResultsHoldsWhatFits) {
  write_pipeline(20000, 20);
  EXPECT_EQ(run("512k"), 2);
  EXPECT_THAT(read_text(errors_), HasSubstr("No space left on device"));
  expect_valid(out_);
  EXPECT_EQ(summary(out_)["complete"], false);
  EXPECT_GT(lines_of(out_ / "observations.ground.csv").size(), 100U);
  EXPECT_GT(lines_of(out_ / "tracks.ground.csv").size(), 100U);
}

TEST_F(FullDisk, OneThatIsFullFromTheStartIsRefused) {
  write_pipeline(10, 0);
  EXPECT_EQ(run("8k"), 2);  // a page for the folder, none for a file
  EXPECT_THAT(read_text(errors_), HasSubstr("free some space or write to another folder"));
}

}  // namespace
}  // namespace plaza::test
