#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "framework/config/pipeline.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

/// A repository with pipelines and data beside it, and a working folder inside it.
class ResolvePath : public testing::Test {
 protected:
  void SetUp() override {
    if (const char* set = std::getenv("PLAZA_DATA")) before_ = set;
    unsetenv("PLAZA_DATA");
    cwd_ = fs::current_path();
    root_ = fs::canonical(testing::TempDir()) / ("resolve_path" + std::to_string(getpid()));
    fs::create_directories(root_ / "repo" / "pipelines" / "scenes");
    fs::create_directories(root_ / "elsewhere" / "deep");
  }
  void TearDown() override {
    fs::current_path(cwd_);
    fs::remove_all(root_);
    if (before_.empty()) {
      unsetenv("PLAZA_DATA");
    } else {
      setenv("PLAZA_DATA", before_.c_str(), 1);
    }
  }
  void make_data() const { fs::create_directories(root_ / "shared" / "data"); }
  fs::path root_;
  fs::path cwd_;
  std::string before_;
};

TEST_F(ResolvePath, RelativePathsStartAtTheFileTheyStandIn) {
  EXPECT_EQ(resolve_path("scenes/lab.json", "pipelines/lab.json"), "pipelines/scenes/lab.json");
  EXPECT_EQ(resolve_path("../a/./b.txt", "x/y/p.json"), "x/a/b.txt");
  EXPECT_EQ(resolve_path("b.txt", "p.json"), "b.txt");
}

TEST_F(ResolvePath, AbsolutePathsStay) {
  EXPECT_EQ(resolve_path("/data/../video.avi", "pipelines/p.json"), "/video.avi");
}

TEST_F(ResolvePath, AnEmptyPathStaysEmpty) { EXPECT_EQ(resolve_path("", "pipelines/p.json"), ""); }

TEST_F(ResolvePath, TheEnvironmentDecidesWhereDataIs) {
  setenv("PLAZA_DATA", "/srv/plaza", 1);
  EXPECT_EQ(resolve_path("$PLAZA_DATA/pets/v.avi", "p.json"), "/srv/plaza/pets/v.avi");
  EXPECT_EQ(resolve_path("$PLAZA_DATA", "p.json"), "/srv/plaza");
}

TEST_F(ResolvePath, DataIsFoundBesideTheWorkingFolder) {
  make_data();
  fs::current_path(root_ / "repo");
  EXPECT_EQ(resolve_path("$PLAZA_DATA/gt.txt", "pipelines/p.json"), "../shared/data/gt.txt");
  setenv("PLAZA_DATA", "", 1);  // set to nothing is not set
  EXPECT_EQ(resolve_path("$PLAZA_DATA/gt.txt", "pipelines/p.json"), "../shared/data/gt.txt");
}

TEST_F(ResolvePath, DataIsFoundBesideTheRepositoryOfTheFile) {
  make_data();
  fs::current_path(root_ / "elsewhere" / "deep");
  const fs::path expected = root_ / "shared" / "data" / "gt.txt";
  EXPECT_EQ(resolve_path("$PLAZA_DATA/gt.txt", root_ / "repo" / "pipelines" / "p.json"), expected);
  EXPECT_EQ(resolve_path("$PLAZA_DATA/gt.txt", root_ / "repo" / "pipelines" / "scenes" / "s.json"),
            expected);
  EXPECT_EQ(resolve_path("$PLAZA_DATA/gt.txt", "../../repo/pipelines/p.json"), expected);
}

TEST_F(ResolvePath, WithoutDataTheUsualPlaceIsNamed) {
  fs::current_path(root_ / "elsewhere" / "deep");
  if (fs::exists("../../../shared/data")) GTEST_SKIP() << "data above the temporary folder";
  EXPECT_EQ(resolve_path("$PLAZA_DATA/gt.txt", root_ / "repo" / "p.json"), "../shared/data/gt.txt");
}

TEST_F(ResolvePath, OtherVariablesAreRefused) {
  for (const char* text : {"$HOME/x", "$PLAZA_DATAX/x", "$"}) {
    try {
      resolve_path(text, "p.json");
      ADD_FAILURE() << text;
    } catch (const UserError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("only $PLAZA_DATA is"));
    }
  }
}

}  // namespace
}  // namespace plaza
