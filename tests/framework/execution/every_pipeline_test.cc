// Every pipeline that comes with Plaza: the check passes, and any number of threads gives the same
// bytes, computed or read from the cache.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "framework/scene/scene_file.h"
#include "framework/study/prepare.h"
#include "plaza/core/error.h"
#include "tests/support/execution_fixture.h"
#include "tests/support/real_registry.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;
using test::real_registry;

std::vector<std::string> all_pipelines() {
  std::vector<std::string> names;
  const fs::path root = fs::path(PLAZA_SOURCE_DIR) / "pipelines";
  if (!fs::is_directory(root)) return names;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const fs::path name = entry.path().lexically_relative(root);
    const std::string folder = name.begin()->string();
    if (entry.path().extension() == ".json" && folder != "scenes" && folder != "studies") {
      names.push_back(name.string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Those of the laboratory differ from lab.json in their scenario alone; rendering each would take
/// minutes and show nothing more.
std::vector<std::string> differing_pipelines() {
  std::vector<std::string> names = all_pipelines();
  std::erase_if(names, [](const std::string& name) { return name.starts_with("lab-"); });
  return names;
}

class PipelinesTest : public test::RunFixture, public ::testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    file_ = fs::path(PLAZA_SOURCE_DIR) / "pipelines" / GetParam();
    const fs::path data = resolve_path("$PLAZA_DATA", file_);
    if (!fs::is_directory(data)) GTEST_SKIP() << "no data in " << data << " (set PLAZA_DATA)";
    try {
      read_pipeline({.file = file_, .sets = {}}, real_registry());
    } catch (const UserError& error) {
      const std::string what = error.what();
      if (what.find("left out of this build") != std::string::npos) GTEST_SKIP() << what;
      throw;
    }
  }

  /// The pipeline, and for how many frames to run it: rendered ones take seconds per frame.
  ResolvedPipeline short_run(std::int64_t frames) {
    ResolvedPipeline pipeline = read_pipeline({.file = file_, .sets = {}}, real_registry());
    const bool rendered = pipeline.nodes.front().entry->declaration.name == "synthetic";
    options_.end_frame = rendered ? 4 : frames;
    if (!rendered) return pipeline;
    return read_pipeline({.file = file_, .sets = {"/nodes/cameras/backgrounds=3"}},
                         real_registry());
  }
  fs::path file_;
};
class RunningPipelinesTest : public PipelinesTest {};

TEST_P(PipelinesTest, PassesTheCheck) {
  const ResolvedPipeline pipeline = read_pipeline({.file = file_, .sets = {}}, real_registry());
  const auto scene = read_scene(pipeline.scene_file);
  EXPECT_EQ(assemble(pipeline, scene, folder_ / "out").nodes.size(), pipeline.nodes.size());
}

TEST_P(RunningPipelinesTest, ParallelGivesTheSameBytes) {
  const ResolvedPipeline pipeline = short_run(40);
  const auto scene = read_scene(pipeline.scene_file);
  for (const int threads : {1, 4}) {
    options_.threads = threads;
    options_.output_folder = folder_ / std::to_string(threads);
    options_.cache_folder = folder_ / ("cache" + std::to_string(threads));
    EXPECT_TRUE(run_pipeline(pipeline, scene, options_).complete);
  }
  auto reference = comparable("1");
  auto parallel = comparable("4");
  // pages show how long things took
  std::erase_if(reference, [](const auto& file) { return file.first.ends_with(".html"); });
  std::erase_if(parallel, [](const auto& file) { return file.first.ends_with(".html"); });
  EXPECT_EQ(parallel, reference);
}

TEST_P(RunningPipelinesTest, TheCacheGivesTheSameBytes) {
  const ResolvedPipeline pipeline = short_run(20);
  const auto scene = read_scene(pipeline.scene_file);
  options_.cache_folder = folder_ / "cache";
  options_.cache_limit_bytes = 1000000000;
  options_.draw = false;
  options_.least_gain = 0;
  for (const char* name : {"computed", "kept", "read"}) {
    options_.reuse = std::string(name) != "computed";
    options_.output_folder = folder_ / name;
    EXPECT_TRUE(run_pipeline(pipeline, scene, options_).complete);
  }
  const auto results = [this](const std::string& out) {
    auto contents = comparable(out);
    auto summary = json::parse(contents.at("summary.json"));
    for (json& node : summary.at("nodes")) node.erase("calls");  // who worked is the difference
    contents["summary.json"] = summary.dump(2);
    return contents;
  };
  EXPECT_EQ(results("kept"), results("computed"));
  EXPECT_EQ(results("read"), results("computed"));
}

TEST(StudiesTest, AllThatComeWithPlazaPassTheCheck) {
  std::size_t seen = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(PLAZA_SOURCE_DIR) / "pipelines" / "studies")) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".json") || name.ends_with(".schema.json")) continue;
    ++seen;
    try {
      const PreparedStudy study = prepare_study(read_study(entry.path()), real_registry());
      EXPECT_GT(study.expansion.variants.size(), 1U) << name;
      EXPECT_FALSE(study.metrics.empty()) << name;
    } catch (const UserError& error) {
      const std::string what = error.what();
      if (what.find("left out of this build") == std::string::npos) throw;
      std::cout << "not looked at: " << what << '\n';
    }
  }
  EXPECT_GE(seen, 2U);
}

std::string test_name(const ::testing::TestParamInfo<std::string>& param) {
  std::string name = param.param;
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, PipelinesTest, ::testing::ValuesIn(all_pipelines()), test_name);
INSTANTIATE_TEST_SUITE_P(All, RunningPipelinesTest, ::testing::ValuesIn(differing_pipelines()),
                         test_name);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(PipelinesTest);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RunningPipelinesTest);

}  // namespace
}  // namespace plaza
