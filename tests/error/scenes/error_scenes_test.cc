// Every broken scene in this folder gets exactly the diagnostics that NAME.expected holds, from the
// reader and from `plaza check`, which exits with 2.
//
// A new case is a NAME.json with its NAME.expected. With PLAZA_UPDATE_EXPECTED set, the test writes
// the latter; read what it wrote.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "framework/scene/scene_file.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(PLAZA_SOURCE_DIR) / "tests" / "error" / "scenes";

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::string> cases() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class ErrorScenes : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    before_ = fs::current_path();
    fs::current_path(kFolder);  // so that diagnostics name the files without a folder
    setenv("PLAZA_DATA", "/nonexistent/data", 1);
  }
  void TearDown() override { fs::current_path(before_); }

 private:
  fs::path before_;
};

TEST_P(ErrorScenes, AreExplained) {
  std::string errors;
  try {
    read_scene(GetParam() + ".json");
  } catch (const UserError& error) {
    errors = error.what();
    errors += "\n";
    for (const Diagnostic& d : error.diagnostics()) {
      EXPECT_FALSE(d.where.file.empty()) << d.message;
      EXPECT_GT(d.where.line, 0) << d.message;
    }
  }
  ASSERT_FALSE(errors.empty()) << "nothing is wrong with this scene";
  const fs::path expected = kFolder / (GetParam() + ".expected");
  if (std::getenv("PLAZA_UPDATE_EXPECTED") != nullptr) std::ofstream(expected) << errors;
  EXPECT_EQ(errors, contents(expected));
}

TEST_P(ErrorScenes, AreRefusedByTheProgram) {
  const std::string out =
      (fs::path(testing::TempDir()) / ("scene-" + GetParam() + std::to_string(getpid()))).string();
  const std::string command = std::string(PLAZA_PROGRAM) + " check " + GetParam() + ".json > " +
                              out + ".out 2> " + out + ".err";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  std::string expected;
  std::istringstream lines(contents(kFolder / (GetParam() + ".expected")));
  for (std::string line; std::getline(lines, line);) expected += "plaza: " + line + "\n";
  EXPECT_EQ(contents(out + ".err"), expected);
  EXPECT_EQ(contents(out + ".out"), "");
  fs::remove(out + ".out");
  fs::remove(out + ".err");
}

INSTANTIATE_TEST_SUITE_P(All, ErrorScenes, testing::ValuesIn(cases()), [](const auto& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(ErrorScenesFolder, HoldsNoExpectationWithoutItsScene) {
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() != ".expected") continue;
    EXPECT_TRUE(fs::exists(fs::path(entry.path()).replace_extension(".json"))) << entry.path();
  }
  EXPECT_GE(cases().size(), 10U);
}

}  // namespace
}  // namespace plaza
