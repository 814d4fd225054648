// Every broken pipeline in this folder gets exactly the diagnostics that NAME.expected holds: from
// the reader, and from `plaza check`, which exits with 2 and leaves nothing behind.
//
// A new case is a NAME.json (and NAME.sets, one --set per line) with its NAME.expected. With
// PLAZA_UPDATE_EXPECTED set, the test writes the latter; read what it wrote.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "framework/config/pipeline.h"
#include "plaza/core/error.h"
#include "tests/support/test_components.h"

namespace plaza::test {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(PLAZA_SOURCE_DIR) / "tests" / "error" / "pipelines";

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

std::vector<std::string> sets_of(const std::string& name) {
  std::vector<std::string> sets;
  std::ifstream in(kFolder / (name + ".sets"));
  for (std::string line; std::getline(in, line);) sets.push_back(line);
  return sets;
}

std::set<fs::path> listing() {
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kFolder)) files.insert(entry.path());
  return files;
}

std::string quoted_for_shell(const std::string& text) { return "'" + text + "'"; }

class ErrorPipelines : public testing::TestWithParam<std::string> {
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

TEST_P(ErrorPipelines, AreExplained) {
  const Registry registry = make_registry();
  std::string errors;
  try {
    const ResolvedPipeline pipeline =
        read_pipeline({GetParam() + ".json", sets_of(GetParam())}, registry);
    assemble(pipeline, make_scene(), "out");
  } catch (const UserError& error) {
    errors = error.what();
    errors += "\n";
  }
  ASSERT_FALSE(errors.empty()) << "nothing is wrong with this pipeline";
  const fs::path expected = kFolder / (GetParam() + ".expected");
  if (std::getenv("PLAZA_UPDATE_EXPECTED") != nullptr) std::ofstream(expected) << errors;
  EXPECT_EQ(errors, contents(expected));
}

TEST_P(ErrorPipelines, AreRefusedByTheProgram) {
  const std::set<fs::path> files_before = listing();
  const fs::path out =
      fs::path(testing::TempDir()) / ("check-" + GetParam() + std::to_string(getpid()));
  std::string command = std::string(PLAZA_CHECK_PROGRAM) + " check " + GetParam() +
                        ".json --plugin-path " + PLAZA_TEST_PLUGINS;
  for (const std::string& set : sets_of(GetParam())) command += " --set " + quoted_for_shell(set);
  const int status =
      std::system((command + " > " + out.string() + ".out 2> " + out.string() + ".err").c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);

  std::string expected;
  std::istringstream lines(contents(kFolder / (GetParam() + ".expected")));
  for (std::string line; std::getline(lines, line);) expected += "plaza: " + line + "\n";
  EXPECT_EQ(contents(out.string() + ".err"), expected);
  EXPECT_EQ(contents(out.string() + ".out"), "");
  EXPECT_EQ(listing(), files_before) << "check must leave nothing behind";
  fs::remove(out.string() + ".out");
  fs::remove(out.string() + ".err");
}

INSTANTIATE_TEST_SUITE_P(All, ErrorPipelines, testing::ValuesIn(cases()), [](const auto& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(ErrorPipelinesFolder, HoldsNoExpectationWithoutItsPipeline) {
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() != ".expected" && entry.path().extension() != ".sets") continue;
    EXPECT_TRUE(fs::exists(fs::path(entry.path()).replace_extension(".json"))) << entry.path();
  }
  EXPECT_GE(cases().size(), 30U);
}

}  // namespace
}  // namespace plaza::test
