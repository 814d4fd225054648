#include "plugins/sources/images/images_source.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/plugins/sources/source_harness.h"

namespace plaza::sources {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

class ImagesSourceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* camera : {"a", "b"}) {
      std::filesystem::create_directory(folder_ / camera);
      options_.pattern[camera] = folder_ / (std::string(camera) + "/{frame}.png");
    }
  }
  std::filesystem::path file(const std::string& camera, int number,
                             const std::string& type = ".png") const {
    return folder_ / (camera + "/" + std::to_string(number) + type);
  }
  void write(const std::string& camera, const std::vector<int>& numbers) {
    for (const int number : numbers) {
      ASSERT_TRUE(cv::imwrite(file(camera, number).string(), numbered_image(number)));
    }
  }
  Driver<ImagesSource> make() { return {options_, scene_}; }
  std::vector<std::string> faults() { return texts(make()->check()); }
  std::vector<std::pair<int, int>> numbers() {
    auto source = make();
    source->open();
    std::vector<std::pair<int, int>> out;
    for (const auto& set : source.rest()) {
      out.emplace_back(number_in(set->views[0]), number_in(set->views[1]));
    }
    return out;
  }

  TemporaryFolder folder_;
  ImagesSource::Options options_;
  std::shared_ptr<Scene> scene_ = test_scene({"a", "b"});
};

TEST_F(ImagesSourceTest, FramesAreNumbersFromTheLowest) {
  write("a", {3, 4, 5});
  write("b", {3, 4, 5});
  EXPECT_THAT(faults(), IsEmpty());
  EXPECT_EQ(make()->open().frame_count, 3);
  EXPECT_THAT(numbers(), ElementsAre(Pair(3, 3), Pair(4, 4), Pair(5, 5)));
}

TEST_F(ImagesSourceTest, NumbersWithoutAFileAreMissingViews) {
  write("a", {1, 2, 5});
  write("b", {2, 3});
  EXPECT_THAT(faults(), IsEmpty());
  EXPECT_THAT(numbers(),
              ElementsAre(Pair(1, -1), Pair(2, 2), Pair(-1, 3), Pair(-1, -1), Pair(5, -1)));
}

TEST_F(ImagesSourceTest, FirstAndStepChooseNumbers) {
  write("a", {0, 5, 10, 15, 20});
  write("b", {5, 12, 15});
  options_.first = 5;
  options_.step = 5;
  EXPECT_THAT(faults(), IsEmpty());
  EXPECT_THAT(numbers(), ElementsAre(Pair(5, 5), Pair(10, -1), Pair(15, 15), Pair(20, -1)));
  options_.step = 10;
  EXPECT_THAT(numbers(), ElementsAre(Pair(5, 5), Pair(15, 15)));
}

TEST_F(ImagesSourceTest, FramesHaveTheScenesTime) {
  write("a", {0, 1, 2});
  write("b", {0});
  auto source = make();
  source->open();
  const auto set = source.rest().at(2);
  EXPECT_EQ(set->frame, 2);
  EXPECT_EQ(set->time_ns, 200'000'000);
}

TEST_F(ImagesSourceTest, SeeksAnywhereInside) {
  write("a", {0, 1, 2, 3});
  write("b", {0, 3});
  auto source = make();
  source->open();
  for (const std::int64_t frame : {3, 1, 2, 0}) {
    source->seek(frame);
    EXPECT_EQ(number_in(source.frames(frame)->views[0]), frame);
  }
  EXPECT_EQ(user_error([&] { source->seek(4); }).what(),
            std::string("frame 5 is beyond the end: the images give 4 frames"));
}

TEST_F(ImagesSourceTest, GreyAndTransparentImagesBecomeColour) {
  cv::Mat grey;
  cv::cvtColor(numbered_image(4), grey, cv::COLOR_BGR2GRAY);
  cv::imwrite(file("a", 0).string(), grey);
  cv::Mat transparent;
  cv::cvtColor(numbered_image(5), transparent, cv::COLOR_BGR2BGRA);
  cv::imwrite(file("b", 0).string(), transparent);
  auto source = make();
  source->open();
  const auto set = source.frames(0);
  EXPECT_TRUE(same_image(set->views[0], numbered_image(4)));
  EXPECT_TRUE(same_image(set->views[1], numbered_image(5)));
}

TEST_F(ImagesSourceTest, CheckReportsAllCamerasAtOnce) {
  write("a", {0});
  scene_ = test_scene({"a", "b", "c", "d"});
  cv::imwrite(file("a", 0).string(), numbered_image(0, 32, 32));
  options_.pattern["c"] = folder_ / "c/{frame}.png";
  options_.pattern["e"] = folder_ / "a/{frame}.png";
  EXPECT_THAT(
      faults(),
      ElementsAre(
          HasSubstr("/pattern/e: the scene has no camera 'e'"),
          HasSubstr("/pattern: camera 'd' of the scene has no entry"),
          "/pattern/a: camera 'a': " + file("a", 0).string() +
              " is 32x32, the calibration of camera 'a' is for 64x48; give the images that "
              "were calibrated, convert them, or correct the image size in the scene",
          AllOf(HasSubstr("/pattern/b: camera 'b': no file in"), HasSubstr("is empty")),
          AllOf(HasSubstr("/pattern/c: camera 'c': the folder"), HasSubstr("cannot be listed"))));
}

TEST_F(ImagesSourceTest, CheckRefusesMoreThanEightBits) {
  write("b", {0});
  cv::imwrite(file("a", 0).string(), cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(30000)));
  EXPECT_THAT(faults(), ElementsAre(AllOf(HasSubstr("0.png has more than 8 bits per channel"),
                                          HasSubstr("convert the images to 8 bits"))));
}

TEST_F(ImagesSourceTest, CheckRefusesNumbersThatAreMostlyGaps) {
  write("a", {0});
  write("b", {0});
  std::filesystem::rename(file("b", 0), folder_ / "b/1700000000.png");
  EXPECT_THAT(faults(),
              ElementsAre(AllOf(HasSubstr("/pattern: the numbers run from 0 to 1700000000"),
                                HasSubstr("set \"step\""))));
}

TEST_F(ImagesSourceTest, CheckRefusesAFirstBeyondTheEnd) {
  write("a", {0, 9});
  write("b", {0});
  options_.first = 5;
  EXPECT_THAT(faults(),
              ElementsAre("/pattern/b: camera 'b': no image has the number 5 (\"first\") or "
                          "a higher one"));
}

TEST_F(ImagesSourceTest, AnotherSizeHalfWayNamesCameraFrameAndFile) {
  write("a", {0, 1, 2});
  write("b", {0, 1, 2});
  cv::imwrite(file("b", 1).string(), numbered_image(1, 32, 24));
  auto source = make();
  EXPECT_THAT(source->check(), IsEmpty());
  source->open();
  ASSERT_TRUE(source.frames(0));
  const UserError error = user_error([&] { source.frames(1); });
  EXPECT_EQ(error.what(),
            "frame 2: " + file("b", 1).string() +
                " is 32x24, the calibration of camera 'b' is for 64x48; replace it, or "
                "delete it to run without this view in this frame");
  EXPECT_EQ(error.context(), (FaultContext{.component = "", .frame = 1, .camera = "b"}));
}

TEST_F(ImagesSourceTest, CutOffImagesAreFound) {
  write("b", {0, 1});
  for (const std::string type : {".png", ".jpg"}) {
    options_.pattern["a"] = folder_ / ("a/{frame}" + type);
    cv::imwrite(file("a", 0, type).string(), numbered_image(0));
    cv::Mat busy = numbered_image(1);
    cv::randu(busy, 0, 255);
    cv::imwrite(file("a", 1, type).string(), busy);
    const std::string whole = read_bytes(file("a", 1, type));
    for (const double part : {0.0, 0.3, 0.7, 0.99}) {
      write_bytes(
          file("a", 1, type),
          whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
      options_.damaged = ImagesSource::Damaged::kError;
      auto source = make();
      source->open();
      ASSERT_TRUE(source.frames(0));
      const UserError error = user_error([&] { source.frames(1); });
      EXPECT_THAT(error.what(),
                  AllOf(HasSubstr("frame 2: "), HasSubstr(file("a", 1, type).string()),
                        HasSubstr("\"damaged\": \"missing\"")));
      EXPECT_EQ(error.context().camera, "a");
      options_.damaged = ImagesSource::Damaged::kMissing;
      EXPECT_THAT(numbers(), ElementsAre(Pair(0, 0), Pair(-1, 1))) << type << " " << part;
    }
  }
}

TEST_F(ImagesSourceTest, PeopleFreeFilesOfAllCamerasAreGivenByNumber) {
  write("a", {0, 7, 9});
  write("b", {0, 9});
  options_.people_free = options_.pattern;
  EXPECT_THAT(faults(), IsEmpty());
  auto source = make();
  ASSERT_EQ(source->open().background_count, 3);
  EXPECT_EQ(number_in(source->background(1)->views[0]), 7);
  EXPECT_TRUE(source->background(1)->views[1].empty());
  EXPECT_EQ(number_in(source->background(2)->views[1]), 9);
}

TEST_F(ImagesSourceTest, CheckFindsPeopleFreeFilesThatAreMissing) {
  write("a", {0});
  write("b", {0});
  std::filesystem::create_directory(folder_ / "empty");
  options_.people_free["a"] = folder_ / "empty/{frame}.png";
  options_.people_free["b"] = folder_ / "nowhere/{frame}.png";
  options_.people_free["e"] = folder_ / "a/{frame}.png";
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("/people_free/e: the scene has no camera 'e'"),
                                    AllOf(HasSubstr("/people_free/a: camera 'a': no file in"),
                                          HasSubstr("is empty")),
                                    AllOf(HasSubstr("/people_free/b: camera 'b': the folder"),
                                          HasSubstr("cannot be listed"))));
}

TEST_F(ImagesSourceTest, DamagedPeopleFreeFilesAreFound) {
  write("a", {0, 1});
  write("b", {0, 1});
  options_.people_free = options_.pattern;
  const std::string whole = read_bytes(file("b", 1));
  write_bytes(file("b", 1), whole.substr(0, whole.size() / 2));
  auto source = make();
  source->open();
  EXPECT_EQ(number_in(source->background(0)->views[1]), 0);
  const UserError error = user_error([&] { source->background(1); });
  EXPECT_THAT(error.what(),
              AllOf(HasSubstr("people-free image: "), HasSubstr(file("b", 1).string()),
                    HasSubstr("\"damaged\": \"missing\"")));
  EXPECT_EQ(error.context().camera, "b");
  options_.damaged = ImagesSource::Damaged::kMissing;
  auto lenient = make();
  lenient->open();
  EXPECT_TRUE(lenient->background(1)->views[1].empty());
}

TEST_F(ImagesSourceTest, AlteredBytesInPngAreFound) {
  write("b", {0});
  cv::Mat busy = numbered_image(1);
  cv::randu(busy, 0, 255);
  cv::imwrite(file("a", 0).string(), busy);
  std::string bytes = read_bytes(file("a", 0));
  bytes[bytes.size() / 2] = static_cast<char>(~bytes[bytes.size() / 2]);
  write_bytes(file("a", 0), bytes);
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("is no image that can be decoded, or is damaged")));
}

TEST_F(ImagesSourceTest, ContentKeyFollowsTheFiles) {
  write("a", {0, 1});
  write("b", {0});
  auto source = make();
  const std::string before = source->content_key();
  EXPECT_EQ(source->content_key(), before);
  write("b", {1});
  EXPECT_NE(source->content_key(), before);
}

}  // namespace
}  // namespace plaza::sources
