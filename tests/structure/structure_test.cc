// The shape of the tree, kept true: which room may include from which.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = PLAZA_SOURCE_DIR;

struct Include {
  fs::path file;  // relative to the root
  std::string target;
};

std::vector<Include> quoted_includes(const fs::path& file, const std::string& text) {
  static const std::regex kInclude(R"re(^\s*#\s*include\s*"([^"]+)")re", std::regex::multiline);
  std::vector<Include> found;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), kInclude);
       it != std::sregex_iterator(); ++it) {
    found.push_back({file, (*it)[1].str()});
  }
  return found;
}

std::vector<fs::path> sources_below(const std::string& room) {
  std::vector<fs::path> files;
  if (!fs::exists(kRoot / room)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / room)) {
    const auto extension = entry.path().extension();
    if (entry.is_regular_file() && (extension == ".h" || extension == ".cc"))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

/// Room of plugin code: plugins/<kind>/..., modalities/<name>/..., models/<name>/...
std::string home_of(const fs::path& relative) {
  auto part = relative.begin();
  std::string home = part->string();
  ++part;
  return home + "/" + part->string();
}

/// Why `include` breaks the one arrow of dependency; empty when it doesn't.
std::string broken_rule(const Include& include) {
  const std::string room = include.file.begin()->string();
  const std::string& target = include.target;
  const bool sdk = starts_with(target, "plaza/");
  if (room == "sdk") {
    const bool beside = fs::exists((kRoot / include.file).parent_path() / target);
    return sdk || beside ? "" : "sdk may include only plaza/... and its own folder";
  }
  if (room == "framework") {
    const bool generated = target == "plaza_commands.inc";  // the table of commands, by CMake
    return sdk || generated || starts_with(target, "framework/")
               ? ""
               : "framework may include only plaza/... and framework/...";
  }
  // plugins, modalities, models: the SDK and files of their own room
  if (sdk) return "";
  const fs::path beside = (kRoot / include.file).parent_path() / target;
  for (const fs::path& candidate : {beside, kRoot / target}) {
    if (!fs::exists(candidate)) continue;
    const fs::path inside = fs::relative(candidate, kRoot);
    const bool shared = home_of(inside) == room + "/common";  // no plugin, but what plugins share
    return shared || home_of(inside) == home_of(include.file)
               ? ""
               : "a plugin knows no other room: " + inside.string();
  }
  return "included file is neither of the SDK nor of the plugin's own room";
}

TEST(Structure, DependenciesPointTowardsTheSdk) {
  std::vector<std::string> broken;
  std::size_t seen = 0;
  for (const char* room : {"sdk", "framework", "plugins", "modalities", "models"}) {
    for (const fs::path& file : sources_below(room)) {
      for (const Include& include : quoted_includes(fs::relative(file, kRoot), read(file))) {
        ++seen;
        if (const std::string why = broken_rule(include); !why.empty()) {
          broken.push_back(include.file.string() + " includes \"" + include.target + "\": " + why);
        }
      }
    }
  }
  EXPECT_THAT(broken, testing::IsEmpty());
  EXPECT_GT(seen, 100U) << "the scan found hardly any include: is the source folder right?";
}

TEST(Structure, TheRulesCatchWhatTheyForbid) {
  EXPECT_NE(broken_rule({"sdk/src/a.cc", "framework/plugin/registry.h"}), "");
  EXPECT_NE(broken_rule({"framework/execution/run.cc", "plugins/associators/gnn/gnn.h"}), "");
  EXPECT_NE(broken_rule({"plugins/associators/gnn/gnn.cc", "framework/plugin/registry.h"}), "");
  EXPECT_NE(broken_rule({"modalities/edges/edges.cc", "modalities/color/color.h"}), "");
  EXPECT_NE(broken_rule({"models/cylinder/cylinder.cc", "modalities/common/opencl.h"}), "");
  EXPECT_EQ(broken_rule({"modalities/edges/edges.cc", "modalities/common/opencl.h"}), "");
  EXPECT_EQ(broken_rule({"framework/execution/run.cc", "plaza/core/error.h"}), "");
}

TEST(Structure, FrameworkNamesNoComponent) {
  // component names, from the declarations of everything that is a plugin
  static const std::regex kName(
      R"re(Declaration<[A-Za-z:]*Options>\s*\w*\s*[({]\s*"([a-z0-9-]+)")re");
  std::set<std::string> names;
  for (const char* room : {"plugins", "modalities", "models"}) {
    for (const fs::path& file : sources_below(room)) {
      const std::string text = read(file);
      for (auto it = std::sregex_iterator(text.begin(), text.end(), kName);
           it != std::sregex_iterator(); ++it) {
        names.insert((*it)[1].str());
      }
    }
  }
  ASSERT_GE(names.size(), 10U);
  std::vector<std::string> named;
  for (const fs::path& file : sources_below("framework")) {
    const std::string text = read(file);
    for (const std::string& name : names) {
      if (name.find('-') != std::string::npos && text.find('"' + name + '"') != std::string::npos) {
        named.push_back(fs::relative(file, kRoot).string() + " names component \"" + name + '"');
      }
    }
  }
  EXPECT_THAT(named, testing::IsEmpty());
}

TEST(Structure, TopLevelHoldsNothingElse) {
  const std::set<std::string> rooms = {"framework", "modalities", "models", "pipelines",
                                       "plugins",   "sdk",        "tests",  "docs"};
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || name[0] == '.' || name == "build" || name == "out") continue;
    EXPECT_TRUE(rooms.contains(name)) << name << " is no room of this house";
  }
}

}  // namespace
