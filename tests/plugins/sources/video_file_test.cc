#include "plugins/sources/video/video_file.h"

#include <opencv2/imgcodecs.hpp>

#include "tests/plugins/sources/avi.h"

namespace plaza::sources {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kPets = "/usr/share/doc/opencv-doc/examples/data/vtest.avi";

std::vector<int> numbers(VideoFile& video) {
  std::vector<int> out;
  for (std::int64_t frame = 0;; ++frame) {
    const auto image = video.read(frame);
    if (!image) return out;
    out.push_back(number_in(*image));
  }
}

class VideoFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write_video(file_, 8);
    avi_ = TakenApartAvi::read(file_);
    ASSERT_EQ(avi_.pictures.size(), 8U);
  }
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "video.avi";
  TakenApartAvi avi_;
};

TEST_F(VideoFileTest, ReadsHeaderAndFrames) {
  VideoFile video(file_);
  EXPECT_EQ(video.header().width, kWidth);
  EXPECT_EQ(video.header().height, kHeight);
  EXPECT_EQ(video.header().frame_count, 8);
  EXPECT_DOUBLE_EQ(video.header().frame_rate_hz, 10);
  EXPECT_THAT(numbers(video), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_EQ(video.end(), 8);
}

TEST_F(VideoFileTest, ReadsInAnyOrder) {
  VideoFile video(file_);
  for (const int frame : {5, 2, 7, 7, 0, 0, 6, 1, 7}) {
    const auto image = video.read(frame);
    ASSERT_TRUE(image) << frame;
    EXPECT_EQ(number_in(*image), frame);
  }
  EXPECT_FALSE(video.read(8));
  EXPECT_FALSE(video.read(1000));
  EXPECT_EQ(number_in(*video.read(7)), 7) << "the last frame again, after the end was seen";
}

TEST_F(VideoFileTest, ImagesAreNotSharedWithTheDecoder) {
  VideoFile video(file_);
  const cv::Mat first = *video.read(0);
  const cv::Mat copy = first.clone();
  video.read(1);
  video.read(7);
  EXPECT_TRUE(same_image(first, copy));
}

TEST_F(VideoFileTest, UndecodableFramesKeepTheirNumber) {
  for (const int frame : {2, 3}) avi_.pictures[frame].assign(avi_.pictures[frame].size(), '\0');
  avi_.write(file_);
  VideoFile video(file_);
  EXPECT_THAT(numbers(video), ElementsAre(0, 1, -1, -1, 4, 5, 6, 7));
  EXPECT_EQ(number_in(*video.read(3)), -1) << "going back into the gap";
  EXPECT_EQ(number_in(*video.read(1)), 1);
  EXPECT_EQ(number_in(*video.read(4)), 4);
}

TEST_F(VideoFileTest, FirstFrameMayBeUndecodable) {
  avi_.pictures[0].assign(avi_.pictures[0].size(), '\0');
  avi_.write(file_);
  VideoFile video(file_);
  EXPECT_THAT(numbers(video), ElementsAre(-1, 1, 2, 3, 4, 5, 6, 7));
}

TEST_F(VideoFileTest, EmptyPicturesAreDroppedFrames) {
  avi_.pictures[4].clear();  // how recorders mark a frame that they dropped
  avi_.write(file_);
  VideoFile video(file_);
  EXPECT_THAT(numbers(video), ElementsAre(0, 1, 2, 3, -1, 5, 6, 7));
}

TEST_F(VideoFileTest, TruncatedFileEndsWhereItsDataEnd) {
  const std::string bytes = read_bytes(file_);
  write_bytes(file_, bytes.substr(0, bytes.find(avi_.pictures[5])));
  VideoFile video(file_);
  EXPECT_EQ(video.header().frame_count, 8);
  EXPECT_THAT(numbers(video), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(video.end(), 5);
}

TEST_F(VideoFileTest, RefusesAnotherSizeHalfWay) {
  std::vector<std::uint8_t> small;
  cv::imencode(".jpg", numbered_image(5, kWidth / 2, kHeight / 2), small);
  avi_.pictures[5].assign(small.begin(), small.end());
  avi_.write(file_);
  VideoFile video(file_);
  EXPECT_EQ(number_in(*video.read(4)), 4);
  const std::string expected =
      "frame 6 of " + file_.string() +
      " is coded as 32x24, the video began with 64x48; cut the file there, "
      "or convert all of it to one size";
  EXPECT_EQ(user_error([&] { video.read(5); }).what(), expected);
  EXPECT_EQ(number_in(*video.read(3)), 3) << "usable after the error";
  EXPECT_EQ(user_error([&] { video.reach(7); }).what(), expected) << "passing over it";
}

TEST_F(VideoFileTest, RefusesWhatIsNoVideo) {
  for (const std::string& bytes :
       {std::string(), std::string("no video\n"), read_bytes(file_).substr(0, 100)}) {
    write_bytes(file_, bytes);
    EXPECT_THAT(user_error([&] { VideoFile video(file_); }).what(),
                AllOf(HasSubstr(file_.string()), HasSubstr("not a video"), HasSubstr("convert")));
  }
}

TEST(VideoFilePets, HasAllFramesAndSeeksExactly) {
  if (!std::filesystem::exists(kPets)) GTEST_SKIP() << kPets << " is absent (package opencv-doc)";
  VideoFile straight(kPets);
  EXPECT_EQ(straight.header().width, 768);
  EXPECT_EQ(straight.header().height, 576);
  EXPECT_DOUBLE_EQ(straight.header().frame_rate_hz, 10);
  std::vector<cv::Mat> sample;
  for (std::int64_t frame = 0; frame < 795; ++frame) {
    const auto image = straight.read(frame);
    ASSERT_TRUE(image && !image->empty()) << frame;
    if (frame % 53 == 0) sample.push_back(*image);
  }
  EXPECT_FALSE(straight.read(795));
  VideoFile jumping(kPets);
  for (const std::int64_t k : {7, 3, 14, 0, 11}) {  // forwards and backwards
    EXPECT_TRUE(same_image(*jumping.read(k * 53), sample[static_cast<std::size_t>(k)])) << k;
  }
}

}  // namespace
}  // namespace plaza::sources
