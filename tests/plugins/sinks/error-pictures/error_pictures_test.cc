#include "plugins/sinks/error-pictures/error_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::error_pictures {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

struct SinkRun {
  std::shared_ptr<Scene> scene = test::ring_scene(2);
  ErrorPictures::Options options;
  test::TemporaryFolder folder;
  std::vector<Artifact> artifacts;
  bool images = true;

  /// Somebody who is missed at (1, 1), and an alarm at (-3, 2).
  void run(std::int64_t frames) {
    ErrorPictures sink(options, test::context_of(scene, folder.path()));
    for (std::int64_t f = 0; f < frames; ++f) {
      std::vector<PayloadPtr> slots = {observations(), truth(), images ? pictures(f) : nullptr};
      const std::vector<int> inputs = {0, 1, images ? 2 : -1};
      NodeIo io(f, 0, slots.data(), inputs, {});
      sink.process(io);
    }
    artifacts = sink.finish(true);
  }
  std::vector<std::string> rows() const {
    std::ifstream in(artifacts.at(0).file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  cv::Mat sheet() const { return cv::imread(artifacts.at(1).file.string()); }

  std::shared_ptr<Observations> observations() const {
    auto o = std::make_shared<Observations>();
    o->items.emplace_back().position_m = {-3, 2};
    o->items[0].probability = 0.25;
    o->items[0].score = 1.5;
    return o;
  }
  std::shared_ptr<GroundTruth> truth() const {
    auto t = std::make_shared<GroundTruth>();
    TruePerson person;
    person.id = 12;
    person.position_m = Eigen::Vector2d(1, 1);
    for (std::size_t c = 0; c < 2; ++c) {
      person.views.push_back(
          {c, *body_box(scene->cameras[c], *person.position_m, scene->body), 1.0});
    }
    t->people.push_back(person);
    return t;
  }
  static std::shared_ptr<FrameSet> pictures(std::int64_t frame) {
    auto set = std::make_shared<FrameSet>();
    set->frame = frame;
    set->views.assign(2, cv::Mat(480, 640, CV_8UC3, cv::Scalar(10, 200, 10)));
    return set;
  }
};

TEST(ErrorPictures, ListEveryErrorAndShowEpisodes) {
  SinkRun r;
  r.run(3);
  const auto rows = r.rows();
  ASSERT_EQ(rows.size(), 7U);
  EXPECT_THAT(rows[0], StartsWith("frame,error,kind,person,x_m,y_m,view,"));
  EXPECT_THAT(rows[1], StartsWith("1,miss,unexplained,12,1.000,1.000,cam1,"));
  EXPECT_THAT(rows[2], StartsWith("1,false alarm,unexplained,,-3.000,2.000,cam"));
  EXPECT_THAT(rows[2], HasSubstr(",1.500,0.250,,,,,,"));
  for (const std::string& row : rows) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), 18) << row;
  }
  cv::Mat green;
  cv::inRange(r.sheet(), cv::Scalar(10, 200, 10), cv::Scalar(10, 200, 10), green);
  EXPECT_GT(cv::countNonZero(green), 264 * 330) << "both pictures show the image";
}

TEST(ErrorPictures, DoWithoutImages) {
  SinkRun r;
  r.images = false;
  r.run(2);
  EXPECT_EQ(r.rows().size(), 5U);
  EXPECT_FALSE(r.sheet().empty());
}

TEST(ErrorPictures, SayWhereNothingWasWrong) {
  SinkRun r;
  r.run(0);
  EXPECT_EQ(r.rows().size(), 1U);
  EXPECT_FALSE(r.sheet().empty());
}

}  // namespace
}  // namespace plaza::error_pictures
