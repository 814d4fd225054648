#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "framework/execution/run.h"
#include "tests/support/execution_doubles.h"

namespace plaza::test {

/// Runs pipelines of doubles in folders of its own.
class RunFixture : public ::testing::Test {
 protected:
  using json = nlohmann::json;

  /// A pipeline of these nodes; the scene is the doubles'.
  ResolvedPipeline read(const json& nodes) {
    write_text(folder_ / "scene.json", "{}\n");
    const json pipeline = {
        {"plaza", 1}, {"name", "Test"}, {"scene", "scene.json"}, {"nodes", nodes}};
    return read_pipeline_text(pipeline.dump(2), {.file = folder_ / "pipeline.json", .sets = {}},
                              registry_);
  }

  RunReport run(const json& nodes, const std::string& out = "out") {
    RunOptions options = options_;
    options.output_folder = folder_ / out;
    return run_pipeline(read(nodes), double_scene(), options);
  }

  /// The error that the run ends with; fails when there is none.
  template <class Expected>
  Expected fault_of(const json& nodes, const std::string& out = "out") {
    try {
      run(nodes, out);
    } catch (const Expected& error) {
      return error;
    }
    ADD_FAILURE() << "the run did not fail";
    return Expected("none");
  }

  json summary(const std::string& out = "out") const {
    return json::parse(read_text(folder_ / (out + "/summary.json")));
  }

  /// Everything in a folder that must be the same in every run: all but measured times.
  std::map<std::string, std::string> comparable(const std::string& out) const {
    auto contents = contents_of(folder_ / out);
    json summary = json::parse(contents.at("summary.json"));
    for (const char* key : {"seconds", "frames_per_second"}) summary.erase(key);
    for (json& node : summary.at("nodes")) node.erase("seconds");
    contents["summary.json"] = summary.dump(2);
    return contents;
  }

  TemporaryFolder folder_;
  Registry registry_ = double_registry();
  RunOptions options_ = [this] {
    RunOptions options;
    options.cache_folder = folder_ / "cache";
    options.threads = 1;
    options.progress = ProgressStyle::kQuiet;
    return options;
  }();
};

/// Source, detector, describer, associator, scores, sink: everything but learning and drawing.
inline nlohmann::json plain_nodes() {
  return {{{"use", "test-source"}, {"name", "cameras"}},
          {{"use", "test-detector"}, {"name", "detector"}},
          {{"use", "test-describer"}, {"name", "describer"}},
          {{"use", "test-associator"}, {"name", "tracks"}},
          {{"use", "test-scores"}, {"name", "scores"}},
          {{"use", "test-sink"}, {"name", "sink"}}};
}

}  // namespace plaza::test
