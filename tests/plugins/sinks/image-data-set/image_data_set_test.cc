#include "plugins/sinks/image-data-set/image_data_set.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <sstream>

#include "framework/scene/scene_file.h"
#include "plaza/geometry/angle.h"
#include "plugins/sources/detections/ground_truth_source.h"
#include "plugins/sources/images/images_source.h"
#include "tests/plugins/sources/source_harness.h"
#include "tests/sdk/geometry/same_camera.h"
#include "tests/sdk/geometry/test_cameras.h"

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

GroundTruth truth_of(int frame, int views = 2) {
  GroundTruth truth;
  TruePerson& person = truth.people.emplace_back();
  person.id = 7;
  person.position_m = Eigen::Vector2d(1.25, 0.1 * frame);
  person.heading_rad = 0.5;
  person.views = {{0, {1.5, 2.25, 10, 20.5}, 0.5}, {1, {3, 4, 11, 21}, 1.0}};
  if (views < 2) person.views.pop_back();
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
    const int views = static_cast<int>(scene_->cameras.size());
    for (int i = 0; i < 2; ++i) sink.learner()->learn(frame_of(100 + i, views));
    sink.learner()->finish(2);
    for (int frame = 0; frame < 3; ++frame) {
      std::vector<PayloadPtr> slots = {std::make_shared<FrameSet>(frame_of(frame, views)),
                                       std::make_shared<GroundTruth>(truth_of(frame, views))};
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

TEST_F(ImageDataSetTest, ACameraWithoutImagesIsDeclaredMissing) {
  const auto sink = make();
  FrameSet frames = frame_of(0, 2);
  frames.views[1].release();
  sink->learner()->learn(frames);
  sink->learner()->finish(1);
  std::vector<PayloadPtr> slots = {std::make_shared<FrameSet>(frames)};
  const std::vector<int> inputs = {0, -1};
  NodeIo io(0, 0, slots.data(), inputs, {});
  sink->process(io);
  static_cast<Sink&>(*sink).finish(true);
  const auto node = json_of("data-set.json")["nodes"][0];
  EXPECT_EQ(node["missing_cameras"], nlohmann::json({"right"}));
  sources::ImagesSource::Options images;
  for (const auto& [camera, pattern] : node["pattern"].items()) {
    images.pattern[camera] = data() / pattern.get<std::string>();
  }
  for (const auto& [camera, pattern] : node["people_free"].items()) {
    images.people_free[camera] = data() / pattern.get<std::string>();
  }
  images.missing_cameras = node["missing_cameras"];
  Driver<sources::ImagesSource> source(images, scene_);
  EXPECT_TRUE(source->check().empty()) << "what was written can be read";
  EXPECT_EQ(source->open().background_count, 1);
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

/// Reads back the scene that a data set of `scene_` has, and compares all cameras.
class WrittenScenes : public ImageDataSetTest {
 protected:
  void expect_read_back() const {
    write(*make());
    const auto again = read_scene(data() / "scene.json");
    ASSERT_EQ(again->cameras.size(), scene_->cameras.size());
    for (std::size_t c = 0; c < scene_->cameras.size(); ++c) {
      EXPECT_EQ(again->cameras[c].name(), scene_->cameras[c].name());
      test::expect_same_camera(scene_->cameras[c], again->cameras[c]);
      EXPECT_EQ(again->cameras[c].intrinsics().index(), scene_->cameras[c].intrinsics().index());
    }
  }
};

TEST_F(WrittenScenes, HaveCamerasOfEveryKind) {
  const CameraFromWorld pose = test::look_at({8, 1, 4}, {0, 0, 1});
  scene_->cameras = test::cameras_of_all_models(pose);
  scene_->area = {{-3, -3}, {3, 3}};
  Eigen::Matrix3d k;
  k << 600, 25, 322, 0, 590, 241, 0, 0, 1;
  const auto plane = [&](double z) {
    Eigen::Matrix3d m;
    m << pose.rotation.leftCols<2>(), pose.rotation.col(2) * z + pose.translation;
    return Eigen::Matrix3d(k * m);
  };
  scene_->cameras.push_back(
      Camera::plane_homographies("homographies", {640, 480}, plane(0), plane(1.8), 1.8));
  expect_read_back();
  for (Camera& camera : scene_->cameras) camera = camera.scaled({400, 240});
  expect_read_back();
}

TEST_F(WrittenScenes, AreTheShippedOnesWithTheirRealCameras) {
  const char* set = std::getenv("PLAZA_DATA");
  const std::filesystem::path real = set != nullptr ? set : PLAZA_SOURCE_DIR "/../shared/data";
  if (!std::filesystem::is_directory(real)) GTEST_SKIP() << "no data; set PLAZA_DATA";
  setenv("PLAZA_DATA", real.c_str(), 1);
  int scenes = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(PLAZA_SOURCE_DIR "/pipelines/scenes")) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".json") || name.ends_with(".schema.json")) continue;
    SCOPED_TRACE(name);
    scene_ = std::make_shared<Scene>(*read_scene(entry.path()));
    expect_read_back();
    ++scenes;
  }
  EXPECT_GE(scenes, 4);
}

}  // namespace
}  // namespace plaza::data_set
