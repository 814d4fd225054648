#include "tests/support/golden_cases.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

namespace plaza::test {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::set<fs::path> listing(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) files.insert(entry.path());
  return files;
}

}  // namespace

GoldenFolder::GoldenFolder(const std::string& name)
    : path_(fs::path(PLAZA_SOURCE_DIR) / "tests" / "error" / name) {}

std::vector<std::string> GoldenFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

std::string GoldenFolder::expected(const std::string& name) const {
  return contents(path_ / (name + ".expected"));
}

void GoldenFolder::expect_whole(const std::set<std::string>& extensions, std::size_t least) const {
  for (const auto& entry : fs::directory_iterator(path_)) {
    if (!extensions.contains(entry.path().extension().string())) continue;
    EXPECT_TRUE(fs::exists(fs::path(entry.path()).replace_extension(".json"))) << entry.path();
  }
  EXPECT_GE(names().size(), least);
}

std::string golden_test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace(name, '-', '_');
  return name;
}

void GoldenCase::SetUp() {
  before_ = fs::current_path();
  fs::current_path(folder_.path());
  setenv("PLAZA_DATA", "/nonexistent/data", 1);
}

void GoldenCase::TearDown() { fs::current_path(before_); }

void GoldenCase::expect_text(const std::string& errors) const {
  if (std::getenv("PLAZA_UPDATE_EXPECTED") != nullptr) {
    std::ofstream(folder_.path() / (GetParam() + ".expected")) << errors << '\n';
  }
  EXPECT_EQ(errors + "\n", folder_.expected(GetParam()));
}

void GoldenCase::expect_refused(const std::string& command) const {
  const std::set<fs::path> files_before = listing(folder_.path());
  const std::string output =
      (fs::path(testing::TempDir()) / ("golden-" + GetParam() + std::to_string(getpid()))).string();
  const int status = std::system((command + " > " + output + ".out 2> " + output + ".err").c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);

  std::string expected;
  std::istringstream lines(folder_.expected(GetParam()));
  for (std::string line; std::getline(lines, line);) expected += "plaza: " + line + "\n";
  EXPECT_EQ(contents(output + ".err"), expected);
  EXPECT_EQ(contents(output + ".out"), "");
  EXPECT_EQ(listing(folder_.path()), files_before) << "nothing may be left behind";
  fs::remove(output + ".out");
  fs::remove(output + ".err");
}

}  // namespace plaza::test
