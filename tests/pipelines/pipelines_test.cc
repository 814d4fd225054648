// Every pipeline that Plaza comes with can be read with the plugins it comes with, and follows the
// schema that editors are given. Data need not be there: files are what `plaza check` looks at.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "framework/config/pipeline.h"
#include "framework/config/schema.h"
#include "framework/plugin/loader.h"
#include "framework/plugin/registry.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(PLAZA_SOURCE_DIR) / "pipelines";

/// Scenes and studies stand in folders of their own and are no pipelines.
std::vector<fs::path> pipelines() {
  std::vector<fs::path> files;
  if (!fs::is_directory(kFolder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
    const std::string folder = fs::relative(entry.path(), kFolder).begin()->string();
    if (entry.path().extension() != ".json" || folder == "scenes" || folder == "studies") continue;
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

const Registry& registry() {
  static const Registry kRegistry = [] {
    Registry out;
    load_plugins({fs::path(PLAZA_BINARY_DIR) / "lib" / "plaza" / "plugins"}, out);
    return out;
  }();
  return kRegistry;
}

/// Those that need no plugin which this build left out; whoever configured it has been told.
std::vector<fs::path> usable_pipelines() {
  std::vector<fs::path> files = pipelines();
  std::erase_if(files, [](const fs::path& file) {
    try {
      read_pipeline({file, {}}, registry());
    } catch (const UserError& error) {
      const std::string what = error.what();
      if (what.find("left out of this build") == std::string::npos) return false;
      std::cout << "not looked at: " << what << '\n';
      return true;
    }
    return false;
  });
  return files;
}

TEST(Pipelines, AreReadWithoutAFault) {
  if (pipelines().empty()) GTEST_SKIP() << "there are no pipelines in " << kFolder;
  for (const fs::path& file : usable_pipelines()) {
    try {
      EXPECT_FALSE(read_pipeline({file, {}}, registry()).nodes.empty()) << file;
    } catch (const UserError& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(Pipelines, FollowTheSchema) {
  if (pipelines().empty()) GTEST_SKIP() << "there are no pipelines in " << kFolder;
  if (std::system("python3 -c 'import jsonschema' > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "python3-jsonschema is not installed";
  }
  const fs::path work = fs::path(testing::TempDir()) / ("pipelines" + std::to_string(getpid()));
  fs::create_directories(work);
  std::ofstream(work / "schema.json") << pipeline_schema(registry()).dump();
  std::ofstream(work / "validate.py")
      << "import json, sys, jsonschema\n"
         "validator = jsonschema.Draft7Validator(json.load(open(sys.argv[1])))\n"
         "faults = [f'{file}: {e.json_path}: {e.message}' for file in sys.argv[2:]\n"
         "          for e in validator.iter_errors(json.load(open(file)))]\n"
         "print('\\n'.join(faults))\n"
         "sys.exit(bool(faults))\n";
  std::string command = "python3 -W ignore " + (work / "validate.py").string() + " " +
                        (work / "schema.json").string();
  for (const fs::path& file : usable_pipelines()) command += " '" + file.string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << "see above for what does not follow the schema";
  fs::remove_all(work);
}

}  // namespace
}  // namespace plaza
