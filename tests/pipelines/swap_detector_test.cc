// One line of a pipeline decides how people are found: each of the detectors takes the place of
// each other, whatever parameters stood there, and the rest of the pipeline stays as it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "framework/scene/scene_file.h"
#include "tests/plugins/detectors/drawn_people.h"
#include "tests/plugins/detectors/simulated_scene.h"
#include "tests/support/blob_network.h"
#include "tests/support/execution_fixture.h"
#include "tests/support/real_registry.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::real_registry;

constexpr int kFrames = 3;

/// Where the two people are in a frame, m.
std::vector<Eigen::Vector2d> people_at(int frame) {
  return {{-1.6 + 0.3 * frame, 0}, {1.6 - 0.3 * frame, 1}};
}

/// The lines that can stand in place of the detector's.
const std::map<std::string, json>& detectors() {
  static const std::map<std::string, json> kLines = {
      {"hierarchical-grid", {{"modalities", {{{"from", "edges"}}}}, {"min_score", 0.8}}},
      {"hog", {{"min_score", 0.2}}},
      {"boxes", json::object()},
      {"onnx", {{"model", "model.onnx"}}}};
  return kLines;
}

json line_of(const std::string& use) {
  json line = detectors().at(use);
  line["use"] = use;
  line["name"] = "detector";
  return line;
}

class DetectorsTest : public test::RunFixture {
 protected:
  void SetUp() override {
    for (const auto& [use, line] : detectors()) {
      if (real_registry().find(use) == nullptr) GTEST_SKIP() << use << " is left out of this build";
    }
    folder_.write("scene.json", json{{"plaza_scene", 1},
                                     {"name", "Street"},
                                     {"frame_rate_hz", 5},
                                     {"area", {{"x_m", {-4, 4}}, {"y_m", {-3, 4}}}},
                                     {"cameras",
                                      {{{"name", "street"},
                                        {"image_size", {640, 480}},
                                        {"calibration",
                                         {{"format", "pinhole"},
                                          {"fx_px", 600},
                                          {"fy_px", 600},
                                          {"cx_px", 319.5},
                                          {"cy_px", 239.5},
                                          {"centre_m", {0, -9, 3.2}},
                                          {"look_at_m", {0, 0, 0.9}}}}}}}}
                                    .dump(2));
    scene_ = read_scene(folder_ / "scene.json");
    draw();
  }

  /// Images of the street with people and without, files of their boxes, and a network that takes
  /// what is dark for a person.
  void draw() {
    std::ofstream boxes(folder_ / "boxes.txt");
    test::BlobNetwork network;
    network.width = 640;
    network.height = 480;
    network.cell = 16;
    network.classes = {{-1 / 3.F, -1 / 3.F, -1 / 3.F}};
    network.gain = 20;
    network.bias = 8;
    for (int frame = 0; frame < kFrames; ++frame) {
      cv::Mat image = testing::empty_street();
      cv::imwrite((folder_ / ("empty" + std::to_string(frame) + ".png")).string(), image);
      for (const Eigen::Vector2d& p : people_at(frame)) {
        const Box box = testing::person_box(scene_->cameras[0], p, scene_->body.height_m);
        testing::draw_person(image, box);
        boxes << frame + 1 << ",-1," << box.left << ',' << box.top << ',' << box.width << ','
              << box.height << ",1\n";
        const int trunk = network.cell_at(box.left + box.width / 2, box.top + 0.33 * box.height);
        network.boxes[trunk] = {box.left, box.top, box.right(), box.bottom()};
      }
      cv::imwrite((folder_ / ("street" + std::to_string(frame) + ".png")).string(), image);
    }
    folder_.write("model.onnx", network.bytes());
  }

  void write_base(const std::string& use) {
    const json nodes = {
        {{"use", "images"},
         {"name", "cameras"},
         {"pattern", {{"street", "street{frame}.png"}}},
         {"people_free", {{"street", "empty{frame}.png"}}}},
        {{"use", "detections"}, {"name", "given"}, {"files", {{"street", "boxes.txt"}}}},
        {{"use", "edges"}},
        line_of(use),
        {{"use", "gnn"}, {"name", "tracks"}, {"confirm", 1}}};
    folder_.write("base.json",
                  json{{"plaza", 1}, {"scene", "scene.json"}, {"nodes", nodes}}.dump(2));
  }

  ResolvedPipeline swapped(const std::string& use) {
    folder_.write("swapped.json",
                  json{{"plaza", 1}, {"extends", "base.json"}, {"nodes", {line_of(use)}}}.dump());
    return read_pipeline({.file = folder_ / "swapped.json", .sets = {}}, real_registry());
  }

  /// Runs; gives resolved.json. Every person has to be found in every frame.
  json run_and_see(const ResolvedPipeline& pipeline, const std::string& out) {
    RunOptions options = options_;
    options.output_folder = folder_ / out;
    EXPECT_TRUE(run_pipeline(pipeline, scene_, options).complete);
    std::vector<std::vector<Eigen::Vector2d>> seen(kFrames);
    const auto lines = test::lines_of(folder_ / (out + "/observations.ground.csv"));
    for (std::size_t i = 1; i < lines.size(); ++i) {
      std::istringstream line(lines[i]);
      std::size_t frame = 0;
      double x = 0, y = 0;
      char comma = 0;
      line >> frame >> comma >> x >> comma >> y;
      seen.at(frame - 1).emplace_back(x, y);
    }
    for (int frame = 0; frame < kFrames; ++frame) {
      for (const Eigen::Vector2d& p : people_at(frame)) {
        const auto& here = seen[static_cast<std::size_t>(frame)];
        EXPECT_TRUE(std::any_of(here.begin(), here.end(),
                                [&](const auto& o) { return (o - p).norm() < 0.5; }))
            << out << ", frame " << frame << ": nobody at " << p.transpose();
      }
    }
    return json::parse(test::read_text(folder_ / (out + "/resolved.json")));
  }

  std::shared_ptr<const Scene> scene_;
};

class SwapDetectorTest : public DetectorsTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(SwapDetectorTest, TakesOneLineOfAPipelineThatExtends) {
  const std::string base = GetParam() == "boxes" ? "hierarchical-grid" : "boxes";
  write_base(base);
  const json before = run_and_see(
      read_pipeline({.file = folder_ / "base.json", .sets = {}}, real_registry()), "before");
  const json after = run_and_see(swapped(GetParam()), "after");
  ASSERT_EQ(after["nodes"].size(), before["nodes"].size());
  for (std::size_t i = 0; i < before["nodes"].size(); ++i) {
    const json& old_node = before["nodes"][i];
    const json& node = after["nodes"][i];
    if (node["name"] != "detector") {
      EXPECT_EQ(node, old_node);
    } else {
      EXPECT_EQ(old_node["use"], base);
      EXPECT_EQ(node["use"], GetParam());
      EXPECT_EQ(node.contains("cells"), GetParam() == "hierarchical-grid");
      EXPECT_EQ(node.contains("stride_px"), GetParam() == "hog");
      EXPECT_EQ(node.contains("model"), GetParam() == "onnx");
    }
  }
}

TEST_P(SwapDetectorTest, TakesItsWordsOnTheCommandLine) {
  write_base(GetParam() == "hog" ? "onnx" : "hog");
  std::vector<std::string> sets = {"/nodes/detector/use=" + GetParam()};
  for (const auto& [key, value] : detectors().at(GetParam()).items()) {
    const std::string text = key == "model" ? (folder_ / "model.onnx").string() : value.dump();
    sets.push_back("/nodes/detector/" + key + "=" + text);
  }
  const json resolved = run_and_see(
      read_pipeline({.file = folder_ / "base.json", .sets = sets}, real_registry()), "set");
  EXPECT_EQ(resolved["nodes"][3]["use"], GetParam());
}

TEST_P(SwapDetectorTest, WorksFromEachToEach) {
  for (const auto& [base, line] : detectors()) {
    write_base(base);
    const ResolvedPipeline pipeline = swapped(GetParam());
    ASSERT_EQ(pipeline.nodes.size(), 5U) << base;
    EXPECT_EQ(pipeline.nodes[3].entry->declaration.name, GetParam()) << base;
    EXPECT_EQ(assemble(pipeline, scene_, folder_ / "out").nodes.size(), 5U) << base;
  }
}

TEST_F(DetectorsTest, ANetworkGivesTheSameBytesOnAnyNumberOfThreads) {
  write_base("onnx");
  const ResolvedPipeline pipeline =
      read_pipeline({.file = folder_ / "base.json", .sets = {}}, real_registry());
  for (const int threads : {1, 4}) {
    RunOptions options = options_;
    options.threads = threads;
    options.output_folder = folder_ / std::to_string(threads);
    EXPECT_TRUE(run_pipeline(pipeline, scene_, options).complete);
  }
  EXPECT_GT(test::lines_of(folder_ / "1/observations.ground.csv").size(), 2U * kFrames);
  EXPECT_EQ(comparable("4"), comparable("1"));
}

std::string test_name(const ::testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Detectors, SwapDetectorTest,
                         ::testing::Values("hierarchical-grid", "hog", "boxes", "onnx"), test_name);

}  // namespace
}  // namespace plaza
