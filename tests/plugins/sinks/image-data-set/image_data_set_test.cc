#include "plugins/sinks/image-data-set/image_data_set.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <sstream>

#include "plaza/geometry/angle.h"
#include "plugins/sinks/image-data-set/pinhole_fit.h"
#include "plugins/sources/detections/ground_truth_source.h"
#include "plugins/sources/images/images_source.h"
#include "tests/plugins/sources/source_harness.h"

namespace plaza::data_set {
namespace {

using sources::Driver;
using sources::same_image;
using sources::test_scene;

cv::Mat noise_image(int seed) {
  cv::Mat image(sources::kHeight, sources::kWidth, CV_8UC3);
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

FrameSet frame_of(int frame, int views) {
  FrameSet out;
  out.frame = frame;
  for (int c = 0; c < views; ++c) {
    out.views.push_back(frame == 1 && c == 1 ? cv::Mat() : noise_image(10 * frame + c));
  }
  return out;
}

GroundTruth truth_of(int frame) {
  GroundTruth truth;
  TruePerson& person = truth.people.emplace_back();
  person.id = 7;
  person.position_m = Eigen::Vector2d(1.25, 0.1 * frame);
  person.heading_rad = 0.5;
  person.views = {{0, {1.5, 2.25, 10, 20.5}, 0.5}, {1, {3, 4, 11, 21}, 1.0}};
  return truth;
}

class ImageDataSetTest : public testing::Test {
 protected:
  std::unique_ptr<ImageDataSet> make(ImageDataSet::Options options = {}) const {
    BuildContext context;
    context.name = "data-set";
    context.scene = scene_;
    context.output_folder = folder_.path();
    return std::make_unique<ImageDataSet>(options, context);
  }

  /// Three frames, and two people-free images before them.
  void write(ImageDataSet& sink) const {
    for (int i = 0; i < 2; ++i) sink.learner()->learn(frame_of(100 + i, 2));
    sink.learner()->finish(2);
    for (int frame = 0; frame < 3; ++frame) {
      std::vector<PayloadPtr> slots = {std::make_shared<FrameSet>(frame_of(frame, 2)),
                                       std::make_shared<GroundTruth>(truth_of(frame))};
      const std::vector<int> inputs = {0, 1};
      NodeIo io(frame, scene_->time_of_frame(frame), slots.data(), inputs, {});
      sink.process(io);
    }
    static_cast<Sink&>(sink).finish(true);
  }

  nlohmann::json json_of(const char* file) const {
    return nlohmann::json::parse(sources::read_bytes(data() / file));
  }
  std::filesystem::path data() const { return folder_.path() / "data-set"; }

  sources::TemporaryFolder folder_;
  std::shared_ptr<Scene> scene_ = test_scene({"left", "right"});
};

TEST_F(ImageDataSetTest, WhatIsReadBackIsWhatWasWritten) {
  const auto sink = make();
  write(*sink);
  const auto nodes = json_of("data-set.json")["nodes"];
  sources::ImagesSource::Options images;
  for (const auto& [camera, pattern] : nodes[0]["pattern"].items()) {
    images.pattern[camera] = data() / pattern.get<std::string>();
  }
  for (const auto& [camera, pattern] : nodes[0]["people_free"].items()) {
    images.people_free[camera] = data() / pattern.get<std::string>();
  }
  Driver<sources::ImagesSource> source(images, scene_);
  EXPECT_TRUE(source->check().empty());
  const SourceInfo info = source->open();
  EXPECT_EQ(info.frame_count, 3);
  ASSERT_EQ(info.background_count, 2);
  for (int frame = 0; frame < 3; ++frame) {
    const auto read = source.frames(frame);
    ASSERT_NE(read, nullptr);
    const FrameSet wanted = frame_of(frame, 2);
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_TRUE(same_image(read->views[c], wanted.views[c])) << frame << " " << c;
    }
  }
  for (int i = 0; i < 2; ++i) {
    const auto background = source->background(i);
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_TRUE(same_image(background->views[c], frame_of(100 + i, 2).views[c]));
    }
  }
}

TEST_F(ImageDataSetTest, TheTruthIsReadBack) {
  const auto sink = make();
  write(*sink);
  const auto node = json_of("data-set.json")["nodes"][1];
  sources::GroundTruthSource::Options options;
  for (const auto& [camera, file] : node["files"].items()) {
    options.files[camera] = data() / file.get<std::string>();
  }
  options.ground = data() / node["ground"].get<std::string>();
  options.frames = node["frames"].get<std::int64_t>();
  Driver<sources::GroundTruthSource> source(options, scene_);
  source->open();
  for (int frame = 0; frame < 3; ++frame) {
    const auto read = source.read_as<GroundTruth>(frame);
    ASSERT_EQ(read->people.size(), 1u);
    const TruePerson person = read->people[0];
    const TruePerson wanted = truth_of(frame).people[0];
    EXPECT_EQ(person.id, wanted.id);
    EXPECT_NEAR((*person.position_m - *wanted.position_m).norm(), 0, 1e-5);
    ASSERT_TRUE(person.heading_rad);
    EXPECT_NEAR(*person.heading_rad, *wanted.heading_rad, 1e-5);
    ASSERT_EQ(person.views.size(), 2u);
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_NEAR(person.views[c].box.left, wanted.views[c].box.left, 1e-3);
      EXPECT_NEAR(person.views[c].box.height, wanted.views[c].box.height, 1e-3);
      EXPECT_NEAR(person.views[c].visibility, wanted.views[c].visibility, 1e-3);
    }
  }
}

TEST_F(ImageDataSetTest, PeopleFreeImagesSurviveTheCache) {
  const auto first = make();
  for (int i = 0; i < 3; ++i) first->learner()->learn(frame_of(100 + i, 2));
  std::stringstream kept;
  first->learner()->save(kept);
  const auto second = make();
  second->learner()->load(kept);
  std::stringstream again;
  second->learner()->save(again);
  EXPECT_EQ(kept.str(), again.str());
  std::istringstream cut(kept.str().substr(0, kept.str().size() / 2));
  EXPECT_THROW(make()->learner()->load(cut), UserError);
}

TEST_F(ImageDataSetTest, NoMorePeopleFreeImagesThanAskedFor) {
  ImageDataSet::Options options;
  options.people_free = 1;
  const auto sink = make(options);
  write(*sink);
  EXPECT_TRUE(std::filesystem::exists(data() / "people-free/left/000001.png"));
  EXPECT_FALSE(std::filesystem::exists(data() / "people-free/left/000002.png"));
  options.people_free = 0;
  EXPECT_EQ(make(options)->learner(), nullptr);
}

TEST_F(ImageDataSetTest, JpegIsSmallerTheLowerItsQuality) {
  std::vector<std::uintmax_t> sizes;
  for (const int quality : {30, 95}) {
    ImageDataSet::Options options;
    options.folder = "q" + std::to_string(quality);
    options.format = ImageDataSet::Format::kJpeg;
    options.jpeg_quality = quality;
    const auto sink = make(options);
    write(*sink);
    sizes.push_back(
        std::filesystem::file_size(folder_.path() / options.folder / "images/left/000001.jpg"));
  }
  EXPECT_LT(sizes[0], sizes[1]);
}

TEST(PinholeFit, FindsTheNumbersAgain) {
  PinholeIntrinsics in;
  in.fx_px = 502.4;
  in.fy_px = 499.1;
  in.cx_px = 381.3;
  in.cy_px = 236.2;
  in.distortion = {-0.182, 0.048, 0.0006, -0.0004, 0};
  const Camera camera = Camera::pinhole("a", {752, 480}, in, {});
  const auto out = fit_pinhole(camera);
  ASSERT_TRUE(out);
  EXPECT_NEAR(out->fx_px, in.fx_px, 1e-6);
  EXPECT_NEAR(out->cy_px, in.cy_px, 1e-6);
  EXPECT_NEAR(out->distortion.k1, in.distortion.k1, 1e-8);
  EXPECT_NEAR(out->distortion.p2, in.distortion.p2, 1e-8);
}

TEST_F(ImageDataSetTest, ACameraThatCannotBeWrittenIsRefused) {
  TsaiIntrinsics tsai;
  tsai.focal_mm = 5.5;
  tsai.kappa1_per_mm2 = 0.02;
  tsai.dpx_mm = tsai.dpy_mm = 0.05;
  tsai.cx_px = 32;
  tsai.cy_px = 24;
  EXPECT_TRUE(make()->check().empty());
  scene_->cameras.push_back(Camera::tsai("odd", {64, 48}, tsai, scene_->cameras[0].pose()));
  EXPECT_THAT(sources::texts(make()->check()),
              testing::ElementsAre(testing::HasSubstr("camera 'odd' is no pinhole camera")));
}

}  // namespace
}  // namespace plaza::data_set
