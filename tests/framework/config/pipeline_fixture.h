#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "framework/config/pipeline.h"
#include "plaza/core/error.h"
#include "tests/support/test_components.h"

namespace plaza::test {

/// A working folder of its own with a scene file, so that messages name files without their folder.
class PipelineFixture : public testing::Test {
 protected:
  void SetUp() override {
    before_ = std::filesystem::current_path();
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::canonical(testing::TempDir()) /
        (std::string(info->test_suite_name()) + "." + info->name() + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    std::filesystem::current_path(folder_);
    write("scene.json", "{}");
  }
  void TearDown() override {
    std::filesystem::current_path(before_);
    std::filesystem::remove_all(folder_);
  }

  static void write(const std::filesystem::path& file, const std::string& text) {
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

  ResolvedPipeline read(const std::string& text, const std::vector<std::string>& sets = {},
                        const std::string& file = "p.json") const {
    return read_pipeline_text(text, {file, sets}, registry_);
  }
  /// A pipeline of these nodes.
  static std::string with_nodes(const std::string& nodes) {
    return "{ \"plaza\": 1, \"scene\": \"scene.json\", \"nodes\": [\n" + nodes + "\n] }";
  }
  ResolvedPipeline read_nodes(const std::string& nodes,
                              const std::vector<std::string>& sets = {}) const {
    return read(with_nodes(nodes), sets);
  }

  /// The lines of the UserError, or "no error".
  std::string errors(const std::string& text, const std::vector<std::string>& sets = {},
                     const std::string& file = "p.json") const {
    try {
      read(text, sets, file);
    } catch (const UserError& error) {
      return error.what();
    }
    return "no error";
  }
  /// The first node stands in line 2.
  std::string node_errors(const std::string& nodes,
                          const std::vector<std::string>& sets = {}) const {
    return errors(with_nodes(nodes), sets);
  }

  Registry registry_ = make_registry();
  std::filesystem::path folder_;

 private:
  std::filesystem::path before_;
};

/// A complete branch: source, detection, tracks, truth, scores.
inline constexpr const char* kWholeNodes =
    R"({ "use": "synthetic", "name": "cameras", "frames": 20 },
{ "use": "edges", "sigma_px": 2 },
{ "use": "color" },
{ "use": "grid", "name": "detector", "modalities": [ { "from": "edges", "weight": 2 }, { "from": "color" } ] },
{ "use": "histogram" },
{ "use": "gnn", "name": "tracklets" },
{ "use": "flow", "name": "tracks", "affinities": [ { "use": "location", "sigma_m": 0.5 }, { "use": "appearance" } ] },
{ "use": "scores" },
{ "use": "report" })";

}  // namespace plaza::test
