#include "plugins/sinks/occluder-map/occluder_map.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "models/cylinder/cylinder.h"
#include "plaza/data/evidence.h"
#include "plaza/data/frames.h"
#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::occluder_map {
namespace {

const cv::Rect kBoard(300, 200, 40, 60);

/// Somebody walks through a place with two cameras, behind a board in the first.
struct Walk {
  std::shared_ptr<Scene> scene = test::ring_scene(2);
  std::shared_ptr<Cylinder> shape = std::make_shared<Cylinder>(Cylinder::Options(), BuildContext());
  OccluderMap::Options options;
  test::TemporaryFolder folder;
  std::vector<Artifact> artifacts;
  double probability = 0.9;
  bool second_view = true;

  nlohmann::json run() {
    BuildContext context = test::context_of(scene, folder.path());
    context.part_lists["shape"] = {{"shape", shape}};
    OccluderMap sink(options, context);
    for (int f = 0; f < 120; ++f) {
      auto people = std::make_shared<Observations>();
      people->items.emplace_back().position_m = {0.5, -3 + 0.05 * f};
      people->items.back().probability = probability;
      auto masks = std::make_shared<ForegroundMask>();
      auto frames = std::make_shared<FrameSet>();
      for (std::size_t c = 0; c < 2; ++c) {
        masks->views.push_back(mask(people->items.back().position_m, c));
        frames->views.emplace_back(480, 640, CV_8UC3, cv::Scalar::all(90));
      }
      if (!second_view) masks->views[1] = frames->views[1] = cv::Mat();
      std::vector<PayloadPtr> slots = {masks, people, frames};
      const std::vector<int> inputs = {0, 1, 2};
      NodeIo io(f, 0, slots.data(), inputs, {});
      sink.process(io);
    }
    artifacts = sink.finish(true);
    std::ifstream in(folder.path() / "sink.json");
    return nlohmann::json::parse(in);
  }
  cv::Mat mask(const Eigen::Vector2d& position, std::size_t camera) const {
    cv::Mat out(480, 640, CV_8UC1, cv::Scalar(0));
    for (const RowSpan& s : shape->silhouette({position, 0, 1}, scene->cameras[camera]).spans) {
      out(cv::Rect(s.begin, s.row, s.end - s.begin, 1)).setTo(cv::Scalar(255));
    }
    if (camera == 0) out(kBoard).setTo(cv::Scalar(0));
    return out;
  }
};

TEST(OccluderMap, WritesOccludersAsScenesHaveThem) {
  Walk walk;
  const nlohmann::json occluders = walk.run().at("occluders");
  ASSERT_EQ(occluders.size(), 1U);
  EXPECT_EQ(occluders[0].at("camera"), "cam1");
  int left = 640, right = 0;
  for (const auto& p : occluders[0].at("polygon_px")) {
    left = std::min(left, p[0].get<int>());
    right = std::max(right, p[0].get<int>());
  }
  EXPECT_NEAR(left, kBoard.x, 3);
  EXPECT_NEAR(right, kBoard.x + kBoard.width, 4);
}

TEST(OccluderMap, DrawsEveryView) {
  Walk walk;
  walk.run();
  ASSERT_EQ(walk.artifacts.size(), 3U);
  const cv::Mat picture = cv::imread((walk.folder.path() / "sink.cam1.png").string());
  ASSERT_EQ(picture.size(), cv::Size(640, 480));
  const auto& hidden = picture.at<cv::Vec3b>(240, 320);
  EXPECT_GT(hidden[2], hidden[1]) << "red";
  const auto& elsewhere = picture.at<cv::Vec3b>(240, 230);
  EXPECT_GT(elsewhere[1], elsewhere[2]) << "green";
}

TEST(OccluderMap, LeavesUnsurePeopleAndMissingViewsOut) {
  Walk unsure;
  unsure.probability = 0.2;
  EXPECT_TRUE(unsure.run().at("occluders").empty());
  Walk one;
  one.second_view = false;
  EXPECT_EQ(one.run().at("occluders").size(), 1U);
}

}  // namespace
}  // namespace plaza::occluder_map
