#include "plugins/sinks/overlay-video/video_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "plaza/core/error.h"
#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::overlay {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const cv::Size kSize(128, 96);

cv::Mat picture(int i) { return cv::Mat(kSize, CV_8UC3, cv::Scalar(20 * i, 200 - 10 * i, 90)); }

/// Noise, which no encoder makes small.
cv::Mat noise(int i, cv::Size size) {
  cv::Mat image(size, CV_8UC3);
  cv::RNG(static_cast<std::uint64_t>(i) + 1).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

template <class Body>
std::string user_error(const Body& body) {
  try {
    body();
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

TEST(VideoFile, EveryCodecAndContainerThatIsOfferedCanBeReadBack) {
  int offered = 0;
  for (const std::string& extension : video_extensions()) {
    for (const Codec codec : {Codec::kAuto, Codec::kH264, Codec::kMpeg4, Codec::kMjpeg}) {
      if (!can_write(extension, codec)) continue;
      ++offered;
      const test::TemporaryFolder folder;
      VideoFile video(folder.path() / ("a" + extension), codec, 7, kSize);
      for (int i = 0; i < 9; ++i) video.write(picture(i));
      video.close();
      EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a" + extension});
      cv::VideoCapture back((folder.path() / ("a" + extension)).string(), cv::CAP_FFMPEG);
      cv::Mat image;
      int frames = 0;
      while (back.read(image)) {
        EXPECT_EQ(image.size(), kSize);
        EXPECT_NEAR(image.at<cv::Vec3b>(48, 64)[0], 20 * frames, 12) << extension << frames;
        ++frames;
      }
      EXPECT_EQ(frames, 9);
      EXPECT_NEAR(back.get(cv::CAP_PROP_FPS), 7, 0.01);
    }
  }
  EXPECT_GE(offered, 4) << "this OpenCV writes hardly any video";
}

TEST(VideoFile, HasNoNameBeforeItIsComplete) {
  const test::TemporaryFolder folder;
  {
    VideoFile video(folder.path() / "a.mp4", Codec::kAuto, 10, kSize);
    video.write(picture(1));
    EXPECT_FALSE(fs::exists(folder.path() / "a.mp4"));
  }  // never closed: as after an exception
  EXPECT_THAT(names_in(folder.path()), testing::IsEmpty());
}

TEST(VideoFile, WithoutFramesThereIsNoFile) {
  const test::TemporaryFolder folder;
  VideoFile video(folder.path() / "a.mp4", Codec::kAuto, 10, kSize);
  video.close();
  EXPECT_THAT(names_in(folder.path()), testing::IsEmpty());
}

TEST(VideoFile, FolderThatCannotBeWrittenToIsNamed) {
  const std::string missing =
      user_error([] { VideoFile("/nowhere/at/all/a.mp4", Codec::kAuto, 10, kSize); });
  EXPECT_THAT(missing, HasSubstr("/nowhere/at/all/a.mp4"));
  EXPECT_THAT(missing, HasSubstr("--out"));

  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "no folder";
  EXPECT_THAT(
      user_error([&] { VideoFile(folder.path() / "file" / "a.mp4", Codec::kAuto, 10, kSize); }),
      HasSubstr("cannot be created"));
}

TEST(VideoFile, ContainerThatCannotHoldTheCodecIsNamed) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(can_write(".txt", Codec::kH264));
  const std::string error =
      user_error([&] { VideoFile(folder.path() / "a.txt", Codec::kH264, 10, kSize); });
  EXPECT_THAT(error, HasSubstr("a.txt"));
  EXPECT_THAT(error, HasSubstr("h264"));
  EXPECT_THAT(names_in(folder.path()), testing::IsEmpty());
}

TEST(VideoFile, FullDiskIsAnErrorAndLeavesNoBrokenFile) {
  const test::TemporaryFolder folder;
  // a limit on the size of files does to the writer what a full disk does: write() fails
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 64 * 1024;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string error = user_error([&] {
    VideoFile video(folder.path() / "a.mp4", Codec::kAuto, 10, {320, 240});
    for (int i = 0; i < 60; ++i) video.write(noise(i, {320, 240}));
    video.close();
  });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(error, HasSubstr("a.mp4"));
  EXPECT_THAT(error, HasSubstr("of 60 frames"));
  EXPECT_THAT(error, HasSubstr("MB are free"));
  EXPECT_THAT(names_in(folder.path()), testing::IsEmpty());
}

TEST(VideoFile, FramesOfAnotherSizeAreRefused) {
  const test::TemporaryFolder folder;
  VideoFile video(folder.path() / "a.mp4", Codec::kAuto, 10, kSize);
  EXPECT_THROW(video.write(cv::Mat(10, 10, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(video.write(cv::Mat(kSize, CV_8UC1)), std::invalid_argument);
}

}  // namespace
}  // namespace plaza::overlay
