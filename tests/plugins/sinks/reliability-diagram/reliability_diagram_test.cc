#include "plugins/sinks/reliability-diagram/reliability_diagram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "plugins/sinks/reliability-diagram/chart.h"
#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::reliability_diagram {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Chart, PutsNumbersWhereItsAxesSay) {
  cv::Mat picture(480, 480, CV_8UC3, cv::Scalar::all(255));
  Chart chart(picture, {0, 0, 480, 480}, {2, 6}, {0, 1}, {"title", "x", "y", {"remark"}});
  const drawing::Point low = chart.pixel(2, 0), high = chart.pixel(6, 1);
  EXPECT_LT(low.x, high.x);
  EXPECT_GT(low.y, high.y) << "upwards";
  const drawing::Point middle = chart.pixel(4, 0.5);
  EXPECT_DOUBLE_EQ(middle.x, (low.x + high.x) / 2);
  chart.dot(4, 0.5, 4, drawing::Color(1, 2, 200));
  EXPECT_EQ(picture.at<cv::Vec3b>(cvRound(middle.y), cvRound(middle.x)), cv::Vec3b(1, 2, 200));
  chart.bar(2, 4, 0.2, drawing::Color(7, 200, 7));
  const drawing::Point in_bar = chart.pixel(3, 0.1);
  EXPECT_EQ(picture.at<cv::Vec3b>(cvRound(in_bar.y), cvRound(in_bar.x)), cv::Vec3b(7, 200, 7));
}

struct SinkRun {
  std::shared_ptr<Scene> scene = test::ring_scene(1);
  test::TemporaryFolder folder;
  std::vector<Artifact> artifacts;

  /// In every frame one who is found at score 3, and an alarm at score 1.
  void run(int frames) {
    ReliabilityDiagram sink({}, test::context_of(scene, folder.path()));
    for (int f = 0; f < frames; ++f) {
      std::vector<PayloadPtr> slots = {observations(), truth()};
      const std::vector<int> inputs = {0, 1};
      NodeIo io(f, 0, slots.data(), inputs, {});
      sink.process(io);
    }
    artifacts = sink.finish(true);
  }
  static std::shared_ptr<Observations> observations() {
    auto o = std::make_shared<Observations>();
    for (const double x : {1.0, -3.0}) {
      Observation& item = o->items.emplace_back();
      item.position_m = {x, x};
      item.probability = x > 0 ? 0.8 : 0.4;
      item.score = x > 0 ? 3 : 1;
    }
    return o;
  }
  std::shared_ptr<GroundTruth> truth() const {
    auto t = std::make_shared<GroundTruth>();
    TruePerson& person = t->people.emplace_back();
    person.id = 12;
    person.position_m = Eigen::Vector2d(1.1, 1);
    person.views.push_back({0, *body_box(scene->cameras[0], {1, 1}, scene->body), 1.0});
    return t;
  }
};

TEST(ReliabilityDiagram, WritesTheCurveAsADetectorTakesIt) {
  SinkRun r;
  r.run(9);
  ASSERT_EQ(r.artifacts.size(), 3U);
  EXPECT_EQ(nlohmann::json::parse(content_of(r.artifacts[2].file)),
            nlohmann::json({{"probability", {{1.0, 0.05}, {3.0, 0.95}}}}));
  EXPECT_THAT(r.artifacts[2].what, testing::HasSubstr("[[1.0,0.05],[3.0,0.95]]"));
  EXPECT_THAT(content_of(r.artifacts[1].file), testing::HasSubstr("0.4,0.5,9,0.4,0\n"));
  EXPECT_THAT(content_of(r.artifacts[1].file), testing::HasSubstr("0.5,0.6,0,,\n"));
  EXPECT_EQ(cv::imread(r.artifacts[0].file.string()).size(), cv::Size(1440, 528));
}

TEST(ReliabilityDiagram, DoesWithoutAnyObservation) {
  SinkRun r;
  r.run(0);
  EXPECT_EQ(content_of(r.artifacts.at(2).file), "{\"probability\":[]}\n");
  EXPECT_FALSE(cv::imread(r.artifacts[0].file.string()).empty());
}

}  // namespace
}  // namespace plaza::reliability_diagram
