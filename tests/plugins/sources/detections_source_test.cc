#include "plugins/sources/detections/detections_source.h"

#include "tests/plugins/sources/source_harness.h"

namespace plaza::sources {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class DetectionsSourceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    give("a",
         "2,-1,10,20,30,40,0.9,-1,-1,-1\n"
         "2,-1,11,21,31,41,0.2,-1,-1,-1\n"
         "4,-1,12,22,32,42,0.5,-1,-1,-1\n");
    give("b", "1,-1,1,2,3,4,-3.5,-1,-1,-1\n");
  }
  void give(const std::string& camera, const std::string& rows) {
    options_.files[camera] = folder_ / (camera + ".txt");
    write_bytes(options_.files[camera], rows);
  }
  Driver<DetectionsSource> make() { return {options_, scene_}; }
  static std::vector<double> scores(const std::vector<ImageDetection>& detections) {
    std::vector<double> out;
    for (const ImageDetection& d : detections) out.push_back(d.score);
    return out;
  }

  TemporaryFolder folder_;
  DetectionsSource::Options options_;
  std::shared_ptr<Scene> scene_ = test_scene({"a", "b"});
};

TEST_F(DetectionsSourceTest, AsClockGivesEmptyFramesAndEndsWithTheHighestFrame) {
  auto source = make();
  EXPECT_THAT(source->check(), IsEmpty());
  EXPECT_EQ(source->open().frame_count, 4);
  for (std::int64_t frame = 0; frame < 4; ++frame) {
    const auto slots = source.read(frame);
    ASSERT_TRUE(slots) << frame;
    const auto& frames = dynamic_cast<const FrameSet&>(*slots->at(0));
    EXPECT_EQ(frames.frame, frame);
    EXPECT_EQ(frames.time_ns, frame * 100'000'000);
    ASSERT_EQ(frames.views.size(), 2U);
    EXPECT_TRUE(frames.views[0].empty() && frames.views[1].empty());
  }
  EXPECT_FALSE(source.read(4));
}

TEST_F(DetectionsSourceTest, GivesRowsByFrameInTheFilesOrder) {
  auto source = make();
  source->open();
  auto first = source.read_as<Detections>(0, 1);
  EXPECT_THAT(first->views[0], IsEmpty());
  EXPECT_THAT(scores(first->views[1]), ElementsAre(-3.5));
  auto second = source.read_as<Detections>(1, 1);
  EXPECT_THAT(scores(second->views[0]), ElementsAre(0.9, 0.2));
  EXPECT_EQ(second->views[0][0].box, (Box{.left = 10, .top = 20, .width = 30, .height = 40}));
  EXPECT_THAT(source.read_as<Detections>(2, 1)->views[0], IsEmpty());
  source->seek(1);
  EXPECT_THAT(scores(source.read_as<Detections>(1, 1)->views[0]), ElementsAre(0.9, 0.2));
}

TEST_F(DetectionsSourceTest, AsFollowerGivesOnlyDetectionsAndNeverEnds) {
  auto source = make();
  source->open(SourceRole::kFollower);
  source->seek(3);
  const auto last = source.read(3);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->at(0), nullptr) << "only the clock gives Frames";
  EXPECT_EQ(dynamic_cast<const Detections&>(*last->at(1)).views[0].size(), 1U);
  for (std::int64_t frame = 4; frame < 7; ++frame) {
    const auto detections = source.read_as<Detections>(frame, 1);
    ASSERT_TRUE(detections) << frame;
    ASSERT_EQ(detections->views.size(), 2U);
    EXPECT_THAT(detections->views[0], IsEmpty());
  }
  source->seek(1000);
}

TEST_F(DetectionsSourceTest, MinScoreLeavesRowsOutButNotFrames) {
  options_.min_score = 0.6;
  auto source = make();
  EXPECT_EQ(source->open().frame_count, 4) << "frame 4 was looked at all the same";
  source->seek(1);
  EXPECT_THAT(scores(source.read_as<Detections>(1, 1)->views[0]), ElementsAre(0.9));
  options_.min_score = 0.2;
  auto other = make();
  other->open();
  other->seek(1);
  EXPECT_THAT(scores(other.read_as<Detections>(1, 1)->views[0]), ElementsAre(0.9, 0.2));
}

TEST_F(DetectionsSourceTest, FramesMayBeDeclared) {
  options_.frames = 6;
  auto source = make();
  EXPECT_EQ(source->open().frame_count, 6);
  source->seek(5);
  EXPECT_TRUE(source.read(5));
  EXPECT_FALSE(source.read(6));
  EXPECT_EQ(
      user_error([&] { source->seek(7); }).what(),
      std::string("frame 8 is beyond the end: the files give 6 frames; where the detector saw "
                  "more, say so with \"frames\""));
  options_.frames = 3;
  EXPECT_THAT(texts(make()->check()),
              ElementsAre(AllOf(HasSubstr("a.txt:3:"), HasSubstr("/files/a"), HasSubstr("4"))));
}

TEST_F(DetectionsSourceTest, CheckReportsEveryFaultOfEveryFile) {
  give("a", "1,-1,10,20,30,40,0.9\n1,-1,10,twenty,30,40,0.9\n0,-1,10,20,30,40,0.9\n");
  give("b", "");
  options_.files["c"] = folder_ / "c.txt";
  options_.files["x"] = folder_ / "a.txt";
  scene_ = test_scene({"a", "b", "c", "d"});
  const auto faults = texts(make()->check());
  EXPECT_THAT(faults,
              ElementsAre(HasSubstr("/files/x: the scene has no camera 'x'"),
                          HasSubstr("/files: camera 'd' of the scene has no entry"),
                          AllOf(HasSubstr("a.txt:2:"), HasSubstr("/files/a: ")),
                          AllOf(HasSubstr("a.txt:3:"), HasSubstr("/files/a: ")),
                          AllOf(HasSubstr("b.txt:1"), HasSubstr("/files/b: ")),
                          AllOf(HasSubstr("/files/c: there is no file"), HasSubstr("c.txt"))));
  EXPECT_EQ(user_error([&] { make()->open(); }).diagnostics().size(), faults.size());
}

TEST_F(DetectionsSourceTest, ContentKeyFollowsTheFiles) {
  const std::string before = make()->content_key();
  EXPECT_EQ(make()->content_key(), before);
  give("b", "1,-1,1,2,3,4,5,-1,-1,-1\n2,-1,1,2,3,4,5,-1,-1,-1\n");
  EXPECT_NE(make()->content_key(), before);
}

}  // namespace
}  // namespace plaza::sources
