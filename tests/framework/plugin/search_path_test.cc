#include <gmock/gmock.h>

#include <cstdlib>

#include "framework/plugin/loader.h"
#include "plaza/core/error.h"
#include "tests/framework/plugin/fixture_paths.h"

namespace plaza {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class SearchPathTest : public testing::Test {
 protected:
  SearchPathTest() { unsetenv("PLAZA_PLUGIN_PATH"); }
  ~SearchPathTest() override { unsetenv("PLAZA_PLUGIN_PATH"); }

  TemporaryFolder folder_;
  fs::path a_ = folder_.folder("a"), b_ = folder_.folder("b"), c_ = folder_.folder("c");
};

std::string message_of(const std::vector<std::string>& command_line) {
  try {
    plugin_search_path(command_line);
  } catch (const UserError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST_F(SearchPathTest, CommandLineThenVariableThenExecutableThenInstallation) {
  setenv("PLAZA_PLUGIN_PATH", c_.c_str(), 1);
  const auto path = plugin_search_path({b_.string(), a_.string()});
  ASSERT_GE(path.size(), 5U);
  EXPECT_EQ(path[0], b_);
  EXPECT_EQ(path[1], a_);
  EXPECT_EQ(path[2], c_);
  // this test lies in the build tree's bin/, as `plaza` does
  EXPECT_EQ(path[3], fs::path(PLAZA_BINARY_DIR) / "lib/plaza/plugins");
  EXPECT_TRUE(path.back().is_absolute());
  EXPECT_THAT(path.back().string(), HasSubstr("plaza/plugins"));
}

TEST_F(SearchPathTest, ListsAreSplitAtColonsAndEmptyEntriesMeanNothing) {
  setenv("PLAZA_PLUGIN_PATH", ("::" + c_.string() + ":").c_str(), 1);
  const auto path = plugin_search_path({a_.string() + ":" + b_.string(), ""});
  EXPECT_EQ(path[0], a_);
  EXPECT_EQ(path[1], b_);
  EXPECT_EQ(path[2], c_);
}

TEST_F(SearchPathTest, AFolderIsSearchedOnceHoweverItIsSpelled) {
  fs::create_symlink(a_, folder_.path() / "link");
  const auto path = plugin_search_path(
      {a_.string() + "/", (b_ / ".." / "a").string(), (folder_.path() / "link").string()});
  EXPECT_EQ(path[0], a_);
  EXPECT_EQ(path.size(), plugin_search_path({}).size() + 1);
}

TEST_F(SearchPathTest, AFolderThatTheUserNamesMustExist) {
  EXPECT_EQ(message_of({(a_ / "nowhere").string()}),
            "--plugin-path: " + (a_ / "nowhere").string() +
                " does not exist; name a folder that holds plaza_*.so files");
  const fs::path file = folder_.write("plaza_x.so", "");
  EXPECT_EQ(message_of({file.string()}),
            "--plugin-path: " + file.string() + " is a file; name the folder that holds it");
  setenv("PLAZA_PLUGIN_PATH", "/nowhere/at/all", 1);
  EXPECT_THAT(message_of({}), HasSubstr("PLAZA_PLUGIN_PATH: /nowhere/at/all does not exist"));
}

TEST_F(SearchPathTest, AFolderOfOurOwnMayBeMissing) {
  Registry registry;
  load_plugins({a_ / "nowhere"}, registry);
  EXPECT_EQ(registry.searched().size(), 1U);
  EXPECT_TRUE(registry.refused().empty());
}

}  // namespace
}  // namespace plaza
