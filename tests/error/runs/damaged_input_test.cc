// Runs over damaged input, from the pipeline's file to what is on disk afterwards.
#include <opencv2/imgcodecs.hpp>

#include "framework/config/pipeline.h"
#include "framework/execution/run.h"
#include "plugins/sources/images/images_source.h"
#include "plugins/sources/video/video_source.h"
#include "tests/plugins/sources/avi.h"
#include "tests/support/into_registry.h"

namespace plaza::sources {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class DamagedInput : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    test::IntoRegistry registrar(registry_);
    registrar.add<VideoSource>();
    registrar.add<ImagesSource>();
    write_bytes(folder_ / "scene.json", "{}");  // not read: the scene is made here
  }
  void make_images(int frames) {
    for (const std::string camera : {"a", "b"}) {
      std::filesystem::create_directory(folder_ / camera);
      for (int k = 1; k <= frames; ++k) {
        cv::imwrite(image(camera, k).string(), numbered_image(k));
      }
    }
  }
  std::filesystem::path image(const std::string& camera, int number) const {
    return folder_ / (camera + "/" + std::to_string(number) + ".png");
  }
  RunReport run(const std::string& source) {
    write_bytes(
        folder_ / "pipeline.json",
        R"({ "plaza": 1, "name": "damaged", "scene": "scene.json", "nodes": [ )" + source + " ] }");
    const ResolvedPipeline pipeline =
        read_pipeline({.file = folder_ / "pipeline.json", .sets = {}}, registry_);
    RunOptions options;
    options.output_folder = folder_ / "out";
    options.cache_folder = folder_ / "cache";
    options.threads = GetParam();
    options.progress = ProgressStyle::kQuiet;
    return run_pipeline(pipeline, test_scene({"a", "b"}), options);
  }
  nlohmann::json summary() const {
    return nlohmann::json::parse(read_bytes(folder_ / "out/summary.json"));
  }
  static constexpr const char* kImages =
      R"({ "use": "images", "name": "cameras",
           "pattern": { "a": "a/{frame}.png", "b": "b/{frame}.png" } })";
  static constexpr const char* kVideos =
      R"({ "use": "video", "name": "cameras", "files": { "a": "a.avi", "b": "b.avi" } })";

  TemporaryFolder folder_;
  Registry registry_;
};
INSTANTIATE_TEST_SUITE_P(Threads, DamagedInput, ::testing::Values(1, 4));

TEST_P(DamagedInput, ViewsWithoutImagesAreNamedAndTheRunIsComplete) {
  make_images(9);
  for (const int k : {3, 7, 8, 9}) std::filesystem::remove(image("b", k));
  const RunReport report = run(kImages);
  EXPECT_TRUE(report.complete);
  EXPECT_EQ(report.frames, 9);
  EXPECT_THAT(report.notes, ElementsAre("node 'cameras', camera 'b': no image in frames 3, 7-9 (4 "
                                        "of 9); its last one is that of frame 6"));
  EXPECT_EQ(summary()["complete"], true);
}

TEST_P(DamagedInput, VideosOfDifferentLengthsAreNamedAndTheRunIsComplete) {
  write_video(folder_ / "a.avi", 5);
  write_video(folder_ / "b.avi", 8);
  const RunReport report = run(kVideos);
  EXPECT_TRUE(report.complete);
  EXPECT_EQ(report.frames, 5);
  EXPECT_THAT(report.notes,
              ElementsAre(HasSubstr("node 'cameras', the video of camera 'a' ends after 5 frames, "
                                    "and the run with it, before 'b' (8 by its header)")));
}

TEST_P(DamagedInput, AnotherSizeHalfWayEndsTheRunWithValidPartialOutput) {
  make_images(6);
  cv::imwrite(image("b", 5).string(), numbered_image(5, 32, 24));
  const UserError error = user_error([&] { run(kImages); });
  EXPECT_EQ(error.context(), (FaultContext{.component = "cameras", .frame = 4, .camera = "b"}));
  EXPECT_THAT(error.what(), AllOf(HasSubstr("5.png is 32x24"), HasSubstr("replace it")));
  EXPECT_EQ(summary()["complete"], false);
  EXPECT_EQ(summary()["frames"], 4);
}

TEST_P(DamagedInput, ATruncatedVideoEndsTheRunWithValidPartialOutput) {
  write_video(folder_ / "a.avi", 12);
  write_video(folder_ / "b.avi", 12);
  const TakenApartAvi avi = TakenApartAvi::read(folder_ / "b.avi");
  const std::string bytes = read_bytes(folder_ / "b.avi");
  write_bytes(folder_ / "b.avi", bytes.substr(0, bytes.find(avi.pictures[5])));
  const UserError error = user_error([&] { run(kVideos); });
  EXPECT_EQ(error.context(), (FaultContext{.component = "cameras", .frame = 5, .camera = "b"}));
  EXPECT_THAT(error.what(), HasSubstr("after frame 5 nothing more can be decoded"));
  EXPECT_EQ(summary()["complete"], false);
  EXPECT_EQ(summary()["frames"], 5);
}

TEST_P(DamagedInput, AMissingCameraFileIsFoundBeforeAnythingIsComputed) {
  write_video(folder_ / "a.avi", 3);
  const UserError error = user_error([&] { run(kVideos); });
  EXPECT_THAT(error.what(),
              AllOf(HasSubstr("pipeline.json:1:"),
                    HasSubstr("/files/b: camera 'b': there is no file"), HasSubstr("b.avi")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/summary.json"));
}

}  // namespace
}  // namespace plaza::sources
