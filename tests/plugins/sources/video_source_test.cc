#include "plugins/sources/video/video_source.h"

#include "tests/plugins/sources/avi.h"

namespace plaza::sources {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

// (number in view 0, number in view 1) of each frame
using Numbers = std::vector<std::pair<int, int>>;
Numbers numbers(const std::vector<std::shared_ptr<const FrameSet>>& sets) {
  Numbers out;
  for (const auto& set : sets) out.emplace_back(number_in(set->views[0]), number_in(set->views[1]));
  return out;
}

class VideoSourceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write_video(options_.files["a"] = folder_ / "a.avi", 6);
    write_video(options_.files["b"] = folder_ / "b.avi", 9, 10, kWidth, kHeight, 20);
  }
  /// Cuts the file of camera b off after `frames` of its 9 frames.
  void truncate(int frames) {
    const std::string bytes = read_bytes(options_.files["b"]);
    const TakenApartAvi avi = TakenApartAvi::read(options_.files["b"]);
    write_bytes(options_.files["b"],
                bytes.substr(0, bytes.find(avi.pictures[static_cast<std::size_t>(frames)])));
  }
  Driver<VideoSource> make() { return {options_, scene_}; }

  TemporaryFolder folder_;
  VideoSource::Options options_;
  std::shared_ptr<Scene> scene_ = test_scene({"a", "b"}, 7);
};

TEST_F(VideoSourceTest, GivesFrameSetsInTheScenesOrderAndRate) {
  scene_ = test_scene({"b", "a"}, 7);
  auto source = make();
  EXPECT_EQ(source->open().frame_count, 6);
  const auto sets = source.rest();
  ASSERT_EQ(sets.size(), 6U);
  EXPECT_THAT(numbers(sets).front(), Pair(20, 0));
  EXPECT_EQ(sets[5]->frame, 5);
  EXPECT_EQ(sets[5]->time_ns, 714285714) << "5 frames at the scene's 7 Hz; the header says 10";
  EXPECT_EQ(sets[5]->views[0].type(), CV_8UC3);
}

TEST_F(VideoSourceTest, EndsWithTheShortestVideo) {
  auto source = make();
  source->open();
  EXPECT_THAT(numbers(source.rest()), ElementsAre(Pair(0, 20), Pair(1, 21), Pair(2, 22),
                                                  Pair(3, 23), Pair(4, 24), Pair(5, 25)));
}

TEST_F(VideoSourceTest, SaysWhichVideoEndedBeforeTheOthers) {
  auto source = make();
  source->open();
  EXPECT_NE(source.frames(0), nullptr);
  EXPECT_THAT(source->notes(), IsEmpty()) << "no end was met";
  source.rest(1);
  EXPECT_THAT(
      source->notes(),
      ElementsAre("the video of camera 'a' ends after 6 frames, and the run with it, before 'b' "
                  "(9 by its header); to go on without the views that have ended, set \"uneven\": "
                  "\"missing\""));
  source->open();
  EXPECT_THAT(source->notes(), IsEmpty());
}

TEST_F(VideoSourceTest, SaysNothingOfVideosThatEndTogetherOrGoOn) {
  write_video(options_.files["a"], 9);
  auto even = make();
  even->open();
  EXPECT_EQ(even.rest().size(), 9U);
  EXPECT_THAT(even->notes(), IsEmpty());

  write_video(options_.files["a"], 6);
  options_.uneven = VideoSource::Uneven::kMissing;  // the kernel lists missing views
  auto longest = make();
  longest->open();
  EXPECT_EQ(longest.rest().size(), 9U);
  EXPECT_THAT(longest->notes(), IsEmpty());
}

TEST_F(VideoSourceTest, GoesOnWithMissingViewsWhereAllowed) {
  options_.uneven = VideoSource::Uneven::kMissing;
  auto source = make();
  EXPECT_EQ(source->open().frame_count, 9);
  const Numbers got = numbers(source.rest());
  ASSERT_EQ(got.size(), 9U);
  EXPECT_THAT(got[5], Pair(5, 25));
  EXPECT_THAT(got[6], Pair(-1, 26));
  EXPECT_THAT(got[8], Pair(-1, 28));
  source->seek(7);
  EXPECT_THAT(numbers(source.rest(7)), ElementsAre(Pair(-1, 27), Pair(-1, 28)));
}

TEST_F(VideoSourceTest, CamerasDeclaredMissingAreEmptyViews) {
  options_.files.erase("a");
  options_.missing_cameras = {"a"};
  auto source = make();
  EXPECT_THAT(source->check(), IsEmpty());
  source->open();
  const Numbers got = numbers(source.rest());
  ASSERT_EQ(got.size(), 9U);
  EXPECT_THAT(got[0], Pair(-1, 20));
}

TEST_F(VideoSourceTest, SeeksToWhatReadingThroughGives) {
  auto through = make();
  through->open();
  const auto all = through.rest();
  auto source = make();
  source->open();
  for (const std::int64_t start : {4, 1, 5, 0, 3}) {
    source->seek(start);
    const auto rest = source.rest(start);
    ASSERT_EQ(rest.size(), all.size() - static_cast<std::size_t>(start));
    for (std::size_t i = 0; i < rest.size(); ++i) {
      for (const std::size_t view : {0, 1}) {
        EXPECT_TRUE(same_image(rest[i]->views[view],
                               all[static_cast<std::size_t>(start) + i]->views[view]));
      }
    }
  }
}

TEST_F(VideoSourceTest, SeekingBeyondTheEndNamesTheVideoThatEnds) {
  auto source = make();
  source->open();
  const UserError error = user_error([&] { source->seek(7); });
  EXPECT_EQ(error.what(),
            "frame 8 is beyond the end: " + (folder_ / "a.avi").string() + " gives 6 frames");
  EXPECT_EQ(error.context().camera, "a");
}

TEST_F(VideoSourceTest, ATruncatedVideoIsAnErrorWithCameraAndFrame) {
  truncate(4);
  auto source = make();
  source->open();
  for (std::int64_t frame = 0; frame < 4; ++frame) ASSERT_TRUE(source.frames(frame)) << frame;
  const UserError error = user_error([&] { source.frames(4); });
  EXPECT_EQ(error.what(),
            "after frame 4 nothing more can be decoded of " + (folder_ / "b.avi").string() +
                ", its header promises 9 frames: the file is cut off or damaged; copy it again, or "
                "set \"truncated\": \"end\" to take this as its end");
  EXPECT_EQ(error.context(), (FaultContext{.component = "", .frame = 4, .camera = "b"}));
}

TEST_F(VideoSourceTest, ATruncatedVideoMayBeTakenAsItsEnd) {
  truncate(4);
  options_.truncated = VideoSource::Truncated::kEnd;
  {
    auto source = make();
    source->open();
    EXPECT_EQ(source.rest().size(), 4U);
  }
  options_.uneven = VideoSource::Uneven::kMissing;
  auto source = make();
  source->open();
  const Numbers got = numbers(source.rest());
  ASSERT_EQ(got.size(), 6U);
  EXPECT_THAT(got[4], Pair(4, -1));
}

TEST_F(VideoSourceTest, AHeaderMayBeWrongByAFewFrames) {
  options_.files.erase("a");
  options_.missing_cameras = {"a"};
  truncate(7);
  auto source = make();
  EXPECT_EQ(source->open().frame_count, 9) << "the header's word";
  EXPECT_EQ(source.rest().size(), 7U);
}

TEST_F(VideoSourceTest, UndecodableFramesAreMissingViews) {
  TakenApartAvi avi = TakenApartAvi::read(folder_ / "a.avi");
  avi.pictures[2].assign(avi.pictures[2].size(), '\0');
  avi.write(folder_ / "a.avi");
  auto source = make();
  source->open();
  EXPECT_THAT(numbers(source.rest()), ElementsAre(Pair(0, 20), Pair(1, 21), Pair(-1, 22),
                                                  Pair(3, 23), Pair(4, 24), Pair(5, 25)));
}

TEST_F(VideoSourceTest, PicksFramesByTimeWhenTheFilesHaveAHigherRate) {
  scene_ = test_scene({"b"}, 4);
  options_.files.erase("a");
  options_.frame_rate_hz = 10;  // 2.5 frames of the file per frame of the scene
  auto source = make();
  EXPECT_EQ(source->open().frame_count, 4);
  std::vector<int> got;
  for (const auto& set : source.rest()) got.push_back(number_in(set->views[0]));
  EXPECT_THAT(got, ElementsAre(20, 23, 25, 28));
  source->seek(2);
  EXPECT_EQ(number_in(source.frames(2)->views[0]), 25);
  EXPECT_THAT(user_error([&] { source->seek(4); }).what(), HasSubstr("gives 4 frames"));
}

TEST_F(VideoSourceTest, AnotherSizeThanCalibratedNamesCameraAndFrame) {
  write_video(options_.files["b"], 6, 10, 32, 32);  // replaced after the check
  auto source = make();
  source->open();
  const UserError error = user_error([&] { source.frames(0); });
  EXPECT_THAT(error.what(), AllOf(HasSubstr("frame 1 of "), HasSubstr("b.avi is 32x32"),
                                  HasSubstr("the calibration of camera 'b' is for 64x48")));
  EXPECT_EQ(error.context().camera, "b");
}

TEST_F(VideoSourceTest, OpeningAgainStartsAgain) {
  auto source = make();
  source->open();
  EXPECT_EQ(source.rest().size(), 6U);
  source->open();
  EXPECT_THAT(numbers({source.frames(0)}), ElementsAre(Pair(0, 20)));
}

TEST_F(VideoSourceTest, ContentKeyFollowsTheFiles) {
  auto source = make();
  const std::string before = source->content_key();
  EXPECT_EQ(source->content_key(), before);
  write_video(options_.files["b"], 7);
  EXPECT_NE(source->content_key(), before);
}

}  // namespace
}  // namespace plaza::sources
