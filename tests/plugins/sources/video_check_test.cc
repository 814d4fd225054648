#include "plugins/sources/video/video_source.h"
#include "tests/plugins/sources/avi.h"

namespace plaza::sources {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

VideoSource::Options one_file(const std::filesystem::path& file) {
  VideoSource::Options options;
  options.files = {{"a", file}};
  return options;
}

Diagnostics check(const VideoSource::Options& options, std::shared_ptr<const Scene> scene) {
  return Driver<VideoSource>(options, std::move(scene))->check();
}

TEST(VideoCheck, AcceptsGoodFiles) {
  const TemporaryFolder folder;
  write_video(folder / "a.avi", 3, 25);  // a header's rate is not compared: the scene's holds
  EXPECT_THAT(texts(check(one_file(folder / "a.avi"), test_scene({"a"}))), IsEmpty());
}

TEST(VideoCheck, ReportsAllFaultsAtOnce) {
  const TemporaryFolder folder;
  write_video(folder / "small.avi", 3, 10, 32, 32);
  write_bytes(folder / "text.avi", "hello");
  VideoSource::Options options;
  options.files = {{"gone", folder / "gone.avi"},
                   {"small", folder / "small.avi"},
                   {"stranger", folder / "small.avi"},
                   {"text", folder / "text.avi"}};
  options.frame_rate_hz = 5;
  const auto faults = texts(check(options, test_scene({"gone", "small", "text", "without"})));
  EXPECT_THAT(
      faults,
      ElementsAre(
          HasSubstr("/files/stranger: the scene has no camera 'stranger'"),
          HasSubstr("/files: camera 'without' of the scene has no entry"),
          HasSubstr("/frame_rate_hz: the files' rate of 5 Hz is below the scene's 10 Hz"),
          AllOf(HasSubstr("/files/gone: camera 'gone': there is no file"), HasSubstr("gone.avi")),
          "/files/small: camera 'small': " + (folder / "small.avi").string() +
              " is 32x32, the calibration of camera 'small' is for 64x48; give the video that was "
              "calibrated, convert "
              "it, or correct the image size in the scene",
          AllOf(HasSubstr("/files/text: camera 'text': "), HasSubstr("is not a video"))));
}

TEST(VideoCheck, AVideoNeedsAFrame) {
  const TemporaryFolder folder;
  write_video(folder / "a.avi", 4);
  TakenApartAvi avi = TakenApartAvi::read(folder / "a.avi");
  for (std::string& picture : avi.pictures) picture.assign(picture.size(), '\0');
  avi.write(folder / "a.avi");
  EXPECT_THAT(texts(check(one_file(folder / "a.avi"), test_scene({"a"}))),
              ElementsAre(HasSubstr("a.avi has no frame that can be decoded")));
}

TEST(VideoCheck, DeclaresItsParameters) {
  const ComponentDeclaration info = VideoSource::declare().info("source");
  EXPECT_EQ(info.name, "video");
  ASSERT_EQ(info.outputs.size(), 1U);
  EXPECT_EQ(info.outputs[0].type, "Frames");
  const auto defaults = VideoSource::declare().parameters().read(nlohmann::json::object());
  EXPECT_FALSE(defaults.frame_rate_hz);
  const auto read = VideoSource::declare().parameters().read(
      {{"files", {{"a", "/x.avi"}}}, {"uneven", "missing"}, {"truncated", "end"}});
  EXPECT_EQ(read.files.at("a"), "/x.avi");
  EXPECT_EQ(read.uneven, VideoSource::Uneven::kMissing);
  EXPECT_EQ(read.truncated, VideoSource::Truncated::kEnd);
}

}  // namespace
}  // namespace plaza::sources
