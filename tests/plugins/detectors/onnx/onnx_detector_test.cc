#include "plugins/detectors/onnx/onnx_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "plaza/core/error.h"
#include "tests/plugins/detectors/onnx/onnx_scene.h"

namespace plaza {
namespace {

using test::BlobNetwork;
using testing::context_of;
using testing::Crowd;
using testing::detect;
using testing::frame_of;
using testing::kBlue;
using testing::kGrey;
using testing::kRed;
using testing::person_box;
using testing::street;

const std::vector<Eigen::Vector2d> kPeople = {{-2, 0}, {0.5, 1}, {2, -1.5}};

class OnnxDetectorTest : public ::testing::Test {
 protected:
  OnnxDetector::Options options_for(const BlobNetwork& network) {
    OnnxDetector::Options options;
    options.model = folder_.write("model" + std::to_string(++models_) + ".onnx", network.bytes());
    return options;
  }

  test::TemporaryFolder folder_;
  int models_ = 0;
  std::shared_ptr<Scene> scene_ = street();
};

class OnnxHeadsTest : public OnnxDetectorTest,
                      public ::testing::WithParamInterface<BlobNetwork::Head> {};

TEST_P(OnnxHeadsTest, FindsPeopleWhereTheyStand) {
  Crowd crowd(GetParam());
  for (const auto& p : kPeople) {
    crowd.add(person_box(scene_->cameras[0], p, scene_->body.height_m), kRed);
  }
  crowd.add(person_box(scene_->cameras[0], {-1, 2}, 1.75), kBlue);  // of the other class
  const OnnxDetector detector(options_for(crowd.network), context_of(scene_));
  const Observations seen = detect(detector, frame_of({crowd.image}));
  ASSERT_EQ(seen.items.size(), kPeople.size());
  for (const auto& p : kPeople) {
    const Box expected = person_box(scene_->cameras[0], p, scene_->body.height_m);
    const auto found = std::find_if(seen.items.begin(), seen.items.end(), [&](const auto& o) {
      return (o.position_m - p).norm() < 0.01;
    });
    ASSERT_NE(found, seen.items.end()) << p.transpose();
    ASSERT_EQ(found->boxes.size(), 1U);
    const ViewBox& box = found->boxes[0];
    EXPECT_NEAR(box.box.left, expected.left, 1e-3);
    EXPECT_NEAR(box.box.top, expected.top, 1e-3);
    EXPECT_NEAR(box.box.width, expected.width, 1e-3);
    EXPECT_NEAR(box.box.height, expected.height, 1e-3);
    const double sigmoid = 1 / (1 + std::exp(-6.0));
    const double objectness = GetParam() == BlobNetwork::Head::kYolov5 ? sigmoid : 1;
    EXPECT_NEAR(box.score, sigmoid * objectness, 1e-5);
  }
}

std::string head_name(const ::testing::TestParamInfo<BlobNetwork::Head>& test) {
  const std::vector<std::string> names = {"Yolov8", "Yolov5", "Ssd"};
  return names[static_cast<std::size_t>(test.param)];
}

INSTANTIATE_TEST_SUITE_P(Heads, OnnxHeadsTest,
                         ::testing::Values(BlobNetwork::Head::kYolov8, BlobNetwork::Head::kYolov5,
                                           BlobNetwork::Head::kSsd),
                         head_name);

TEST_F(OnnxDetectorTest, StretchesImagesThatAreNotLetterboxed) {
  Crowd crowd(BlobNetwork::Head::kYolov8, {.x_scale = 0.5, .y_scale = 2.0 / 3, .top = 0});
  const Box box = person_box(scene_->cameras[0], {1, 1}, 1.75);
  crowd.add(box, kRed);
  OnnxDetector::Options options = options_for(crowd.network);
  options.fit = ImageFit::kStretch;
  const auto boxes = OnnxDetector(options, context_of(scene_)).detect_boxes(crowd.image);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_NEAR(boxes[0].box.left, box.left, 1e-3);
  EXPECT_NEAR(boxes[0].box.top, box.top, 1e-3);
  EXPECT_NEAR(boxes[0].box.height, box.height, 1e-3);
  options.fit = ImageFit::kLetterbox;  // the same patch is elsewhere in the input then
  const auto elsewhere = OnnxDetector(options, context_of(scene_)).detect_boxes(crowd.image);
  for (const ImageDetection& d : elsewhere) EXPECT_GT(std::abs(d.box.top - box.top), 5);
}

TEST_F(OnnxDetectorTest, FindsTheClassThatIsAskedFor) {
  Crowd crowd;
  const Eigen::Vector2d red(-2, 0), blue(2, 0);
  crowd.add(person_box(scene_->cameras[0], red, 1.75), kRed);
  crowd.add(person_box(scene_->cameras[0], blue, 1.75), kBlue);
  OnnxDetector::Options options = options_for(crowd.network);
  options.person_class = 1;
  const Observations seen =
      detect(OnnxDetector(options, context_of(scene_)), frame_of({crowd.image}));
  ASSERT_EQ(seen.items.size(), 1U);
  EXPECT_LT((seen.items[0].position_m - blue).norm(), 0.01);
}

TEST_F(OnnxDetectorTest, ShowsTheNetworkColoursInItsOrder) {
  Crowd crowd;
  crowd.add(person_box(scene_->cameras[0], {2, 0}, 1.75), kBlue);
  OnnxDetector::Options options = options_for(crowd.network);
  EXPECT_TRUE(OnnxDetector(options, context_of(scene_)).detect_boxes(crowd.image).empty());
  options.channels = OnnxDetector::Channels::kBgr;  // the network takes blue for red now
  EXPECT_EQ(OnnxDetector(options, context_of(scene_)).detect_boxes(crowd.image).size(), 1U);
}

TEST_F(OnnxDetectorTest, ScalesWhatTheNetworkSees) {
  Crowd crowd;
  crowd.add(person_box(scene_->cameras[0], {2, 0}, 1.75), kRed);
  OnnxDetector::Options options = options_for(crowd.network);
  options.min_score = 0.6;
  options.scale = 0.5 / 255;  // red is 0.5 then, and its score sigmoid(0)
  EXPECT_TRUE(OnnxDetector(options, context_of(scene_)).detect_boxes(crowd.image).empty());
  options.min_score = 0.499;
  const auto boxes = OnnxDetector(options, context_of(scene_)).detect_boxes(crowd.image);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_NEAR(boxes[0].score, 0.5, 1e-5);
  options.mean = {-255, 0, 0};  // and 1 again
  options.min_score = 0.9;      // what is grey has 0.5 now
  EXPECT_NEAR(OnnxDetector(options, context_of(scene_)).detect_boxes(crowd.image).at(0).score,
              1 / (1 + std::exp(-6.0)), 1e-5);
}

TEST_F(OnnxDetectorTest, KeepsTheBestOfBoxesThatOverlap) {
  Crowd crowd;
  const Box best = person_box(scene_->cameras[0], {0, 0}, 1.75);
  Box weaker = best;
  weaker.left += 0.1 * best.width;
  weaker.top += 0.35 * best.height;
  crowd.add(best, kRed);
  crowd.add(weaker, cv::Scalar(20, 40, 235));
  OnnxDetector::Options options = options_for(crowd.network);
  ASSERT_EQ(OnnxDetector(options, context_of(scene_)).detect_boxes(crowd.image).size(), 2U);
  options.nms_overlap = 0.3;
  const Observations one =
      detect(OnnxDetector(options, context_of(scene_)), frame_of({crowd.image}));
  ASSERT_EQ(one.items.size(), 1U);
  EXPECT_NEAR(one.items[0].boxes.at(0).box.left, best.left, 1e-3);
  options.nms_overlap = 0.9;
  EXPECT_EQ(detect(OnnxDetector(options, context_of(scene_)), frame_of({crowd.image})).items.size(),
            2U);
}

TEST_F(OnnxDetectorTest, TellsScoresByTheirCalibration) {
  Crowd crowd;
  crowd.add(person_box(scene_->cameras[0], {0, 0}, 1.75), kRed);
  OnnxDetector::Options options = options_for(crowd.network);
  options.probability = {{0.5, 0.25}, {0.9, 0.75}};
  const Observations seen =
      detect(OnnxDetector(options, context_of(scene_)), frame_of({crowd.image}));
  ASSERT_EQ(seen.items.size(), 1U);
  EXPECT_DOUBLE_EQ(seen.items[0].probability, 0.75);
}

TEST_F(OnnxDetectorTest, LooksAtEveryViewThatHasAnImage) {
  const auto scene = street(3);
  Crowd crowd;
  crowd.add(person_box(scene->cameras[0], {0, 0}, 1.75), kRed);
  const OnnxDetector detector(options_for(crowd.network), context_of(scene));
  const Observations seen =
      detect(detector, frame_of({crowd.image, cv::Mat(), cv::Mat(480, 640, CV_8UC3, kGrey)}));
  ASSERT_EQ(seen.items.size(), 1U);
  EXPECT_EQ(seen.items[0].boxes.at(0).camera, 0U);
}

TEST_F(OnnxDetectorTest, TakesAnInputSizeThatTheModelLeavesOpen) {
  Crowd crowd;
  crowd.network.open_size = true;
  crowd.add(person_box(scene_->cameras[0], {0, 0}, 1.75), kRed);
  OnnxDetector::Options options = options_for(crowd.network);
  options.input_size = {320, 320};
  const OnnxDetector detector(options, context_of(scene_));
  EXPECT_TRUE(detector.check().empty());
  EXPECT_EQ(detector.detect_boxes(crowd.image).size(), 1U);
}

/// Frames with other people in each, and what a detector gives for them, in turn or at once.
TEST_F(OnnxDetectorTest, GivesTheSameBytesOnAnyNumberOfThreads) {
  std::vector<cv::Mat> images;
  Crowd all;
  for (int i = 0; i < 24; ++i) {
    Crowd crowd;
    const Eigen::Vector2d p(-3 + 0.25 * i, 2 - 0.15 * i);
    crowd.add(person_box(scene_->cameras[0], p, 1.75), cv::Scalar(5 * i, 0, 255 - 3 * i));
    all.network.boxes.insert(crowd.network.boxes.begin(), crowd.network.boxes.end());
    images.push_back(crowd.image);
  }
  OnnxDetector::Options options = options_for(all.network);
  const OnnxDetector alone(options, context_of(scene_));
  std::vector<std::vector<ImageDetection>> expected;
  std::size_t boxes = 0;
  for (const cv::Mat& image : images)
    boxes += expected.emplace_back(alone.detect_boxes(image)).size();
  EXPECT_GE(boxes, 15U);
  for (const int copies : {0, 1, 2}) {
    options.copies = copies;
    const OnnxDetector shared(options, context_of(scene_));
    std::vector<std::vector<ImageDetection>> found(images.size());
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        for (std::size_t i = next++; i < images.size(); i = next++) {
          found[i] = shared.detect_boxes(images[i]);
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < images.size(); ++i) {
      ASSERT_EQ(found[i].size(), expected[i].size()) << i;
      for (std::size_t k = 0; k < found[i].size(); ++k) {
        EXPECT_EQ(found[i][k].box.left, expected[i][k].box.left);
        EXPECT_EQ(found[i][k].box.height, expected[i][k].box.height);
        EXPECT_EQ(found[i][k].score, expected[i][k].score);
      }
    }
  }
}

TEST_F(OnnxDetectorTest, RefusesImagesOfAnotherSize) {
  const OnnxDetector detector(options_for(Crowd().network), context_of(scene_));
  try {
    detect(detector, frame_of({cv::Mat(240, 320, CV_8UC3, kGrey)}));
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("320x240"));
    EXPECT_EQ(error.context().camera, "street");
  }
}

TEST_F(OnnxDetectorTest, NamesTheCameraWhoseImageGivesNoScores) {
  Crowd crowd;
  crowd.network.sigmoid = false;
  crowd.add(person_box(scene_->cameras[0], {0, 0}, 1.75), kRed);
  const OnnxDetector detector(options_for(crowd.network), context_of(scene_));
  try {
    detect(detector, frame_of({crowd.image}));
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("export it with its last sigmoid"));
    EXPECT_EQ(error.context().camera, "street");
  }
}

}  // namespace
}  // namespace plaza
