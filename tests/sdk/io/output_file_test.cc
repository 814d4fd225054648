#include "plaza/io/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "plaza/core/error.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class OutputFileTest : public ::testing::Test {
 protected:
  OutputFileTest() {
    folder_ = fs::temp_directory_path() / ("plaza-output-file-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  ~OutputFileTest() override { fs::remove_all(folder_); }
  fs::path folder_;
};

/// Runs `body` while this process may write no file beyond `bytes`; gives the error it ended with.
template <class Body>
std::string with_file_limit(rlim_t bytes, const Body& body) {
  const rlimit limit{bytes, RLIM_INFINITY};
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::string message;
  try {
    body();
  } catch (const UserError& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  return message;
}

TEST_F(OutputFileTest, HasItsNameOnlyWhenCommitted) {
  const fs::path file = folder_ / "rows.csv";
  OutputFile out(file);
  out.write("1,2\n");
  EXPECT_FALSE(fs::exists(file));
  out.flush();
  EXPECT_FALSE(fs::exists(file));
  EXPECT_EQ(content(out.part()), "1,2\n");
  out.write("3,4\n");
  out.commit();
  EXPECT_EQ(content(file), "1,2\n3,4\n");
  EXPECT_FALSE(fs::exists(out.part()));
}

TEST_F(OutputFileTest, KeepsTheEarlierFileUntilTheNewOneIsComplete) {
  const fs::path file = folder_ / "rows.csv";
  write_file(file, "earlier\n");
  {
    OutputFile out(file);
    out.write("later\n");
    out.flush();
    EXPECT_EQ(content(file), "earlier\n");
  }
  EXPECT_EQ(content(file), "earlier\n");
  EXPECT_FALSE(fs::exists(folder_ / "rows.csv.part"));
}

TEST_F(OutputFileTest, ReplacesAPartThatADeadProcessLeft) {
  const fs::path file = folder_ / "rows.csv";
  std::ofstream(folder_ / "rows.csv.part") << "something much longer than what follows\n";
  write_file(file, "short\n");
  EXPECT_EQ(content(file), "short\n");
}

TEST_F(OutputFileTest, AMissingFolderIsTheUsersError) {
  try {
    OutputFile out(folder_ / "nowhere" / "rows.csv");
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("cannot create " + (folder_ / "nowhere/rows.csv").string()));
    EXPECT_THAT(error.what(), HasSubstr("the folder does not exist"));
  }
}

TEST_F(OutputFileTest, AFullDiskIsNamedWithItsRemedy) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  fs::create_symlink("/dev/full", folder_ / "rows.csv.part");
  OutputFile out(folder_ / "rows.csv");
  out.write("1,2\n");
  try {
    out.commit();
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot write " + (folder_ / "rows.csv").string()));
    EXPECT_THAT(error.what(), HasSubstr("No space left on device; free some space"));
  }
}

TEST_F(OutputFileTest, KeepsWholeRecordsWhenTheDiskFillsUpWithinOne) {
  OutputFile out(folder_ / "rows.csv");
  const std::string message = with_file_limit(10, [&out] {
    out.write("1,2\n");
    out.write("3,4\n");
    out.flush();
    out.write("5,6\n");  // crosses the limit after two of its bytes
    out.flush();
  });
  EXPECT_THAT(message, HasSubstr("cannot write"));
  EXPECT_EQ(content(out.part()), "1,2\n3,4\n");
  out.drop_unwritten();
  out.commit();
  EXPECT_EQ(content(folder_ / "rows.csv"), "1,2\n3,4\n");
}

TEST_F(OutputFileTest, TriesAgainWhatDidNotFit) {
  OutputFile out(folder_ / "rows.csv");
  with_file_limit(10, [&out] {
    for (const char* row : {"1,2\n", "3,4\n", "5,6\n", "7,8\n"}) out.write(row);
    out.flush();  // crosses the limit within the third of them
  });
  EXPECT_EQ(content(out.part()), "1,2\n3,4\n") << "as much as fits, not only earlier flushes";
  out.write("9,0\n");
  out.commit();
  EXPECT_EQ(content(folder_ / "rows.csv"), "1,2\n3,4\n5,6\n7,8\n9,0\n");
}

TEST_F(OutputFileTest, CommitsOnce) {
  OutputFile out(folder_ / "rows.csv");
  out.commit();
  EXPECT_THROW(out.commit(), InternalError);
  EXPECT_THROW(out.write("late\n"), InternalError);
  EXPECT_EQ(content(folder_ / "rows.csv"), "");
}

TEST_F(OutputFileTest, LargeContentComesThroughWhole) {
  std::string expected;
  OutputFile out(folder_ / "rows.csv");
  for (int i = 0; i < 50000; ++i) {
    const std::string row = std::to_string(i) + ",x\n";
    expected += row;
    out.write(row);
  }
  out.commit();
  EXPECT_EQ(content(folder_ / "rows.csv"), expected);
}

}  // namespace
}  // namespace plaza
