#include "plugins/sources/detections/ground_truth_source.h"

#include <numbers>

#include "plaza/geometry/angle.h"
#include "tests/plugins/sources/source_harness.h"

namespace plaza::sources {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class GroundTruthSourceTest : public ::testing::Test {
 protected:
  void give(const std::string& camera, const std::string& rows) {
    options_.files[camera] = folder_ / (camera + ".txt");
    write_bytes(options_.files[camera], rows);
  }
  void give_ground(const std::string& rows) {
    options_.ground = folder_ / "ground.csv";
    write_bytes(*options_.ground, rows);
  }
  Driver<GroundTruthSource> make() { return {options_, scene_}; }
  std::vector<std::string> faults() { return texts(make()->check()); }
  GroundTruth at(std::int64_t frame) {
    auto source = make();
    source->open(SourceRole::kFollower);
    source->seek(frame);
    return *source.read_as<GroundTruth>(frame);
  }
  std::vector<std::int64_t> ids(std::int64_t frame) {
    std::vector<std::int64_t> out;
    for (const TruePerson& person : at(frame).people) out.push_back(person.id);
    return out;
  }
  /// "y" for annotated, "n" for not, of frames 0, 1, ...
  std::string annotated(std::int64_t frames) {
    auto source = make();
    source->open(SourceRole::kFollower);
    std::string out;
    for (std::int64_t f = 0; f < frames; ++f) {
      out += source.read_as<GroundTruth>(f)->annotated ? 'y' : 'n';
    }
    return out;
  }

  TemporaryFolder folder_;
  GroundTruthSource::Options options_;
  std::shared_ptr<Scene> scene_ = test_scene({"a", "b"});
};

TEST_F(GroundTruthSourceTest, JoinsViewsByIdentity) {
  give("a", "1,7,10,20,30,40,1,1.5,2.5,0\n1,3,50,60,30,40,1,-1,-1,-1\n");
  give("b", "1,7,11,21,31,41,1,-1,-1,-1\n2,7,12,22,32,42,1,-1,-1,-1\n");
  EXPECT_THAT(faults(), IsEmpty());
  const GroundTruth first = at(0);
  EXPECT_TRUE(first.annotated);
  ASSERT_EQ(first.people.size(), 2U);
  EXPECT_EQ(first.people[0].id, 3);
  EXPECT_FALSE(first.people[0].position_m);
  ASSERT_EQ(first.people[0].views.size(), 1U);
  EXPECT_EQ(first.people[0].views[0].camera, 0U);
  const TruePerson& seven = first.people[1];
  EXPECT_EQ(seven.id, 7);
  EXPECT_EQ(seven.position_m, Eigen::Vector2d(1.5, 2.5));
  EXPECT_FALSE(seven.heading_rad);
  ASSERT_EQ(seven.views.size(), 2U);
  EXPECT_EQ(seven.views[1].camera, 1U);
  EXPECT_EQ(seven.views[1].box, (Box{.left = 11, .top = 21, .width = 31, .height = 41}));
  EXPECT_EQ(seven.views[1].visibility, 1);
  EXPECT_THAT(ids(1), ElementsAre(7)) << "in one view only";
}

TEST_F(GroundTruthSourceTest, ReadsVisibilityAndLeavesOutWhatDoesNotCount) {
  give("a",
       "1,1,10,20,30,40,1,1,0.25\n"
       "1,2,10,20,30,40,0,1,1\n"     // confidence 0
       "1,3,10,20,30,40,1,8,1\n"     // a distractor
       "1,4,10,20,30,40,1,-1,1\n");  // class not said
  EXPECT_THAT(ids(0), ElementsAre(1, 4));
  EXPECT_EQ(at(0).people[0].views[0].visibility, 0.25);
}

TEST_F(GroundTruthSourceTest, PositionsOfSeveralViewsAreAveraged) {
  give("a", "1,1,10,20,30,40,1,1,2,0\n");
  give("b", "1,1,10,20,30,40,1,2,4,0\n");
  EXPECT_EQ(at(0).people[0].position_m, Eigen::Vector2d(1.5, 3));
}

TEST_F(GroundTruthSourceTest, GroundFileGivesPositionsAndHeadings) {
  give("a", "1,1,10,20,30,40,1,1,2,0\n");
  give_ground("frame,id,x_m,y_m,heading_deg\n1,1,-1,2.25,270\n1,5,3,4,\n");
  EXPECT_THAT(faults(), IsEmpty());
  const GroundTruth truth = at(0);
  ASSERT_EQ(truth.people.size(), 2U);
  EXPECT_EQ(truth.people[0].position_m, Eigen::Vector2d(-1, 2.25)) << "goes before the box row's";
  EXPECT_NEAR(*truth.people[0].heading_rad, -std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(truth.people[0].views.size(), 1U);
  EXPECT_EQ(truth.people[1].id, 5);
  EXPECT_FALSE(truth.people[1].heading_rad);
  EXPECT_THAT(truth.people[1].views, IsEmpty());
}

TEST_F(GroundTruthSourceTest, FramesBeyondTheLastAreNotAnnotated) {
  give_ground("2,1,0,0\n3,1,0,0\n");
  EXPECT_EQ(annotated(5), "yyynn") << "nobody in frame 1 is an answer, silence after 3 is not";
  EXPECT_THAT(ids(0), IsEmpty());
  options_.frames = 4;
  EXPECT_EQ(annotated(5), "yyyyn");
  options_.frames = 2;
  EXPECT_THAT(faults(), ElementsAre(AllOf(HasSubstr("ground.csv:2"), HasSubstr("/ground: "))));
}

TEST_F(GroundTruthSourceTest, AsClockItEndsAfterItsLastFrame) {
  give_ground("1,1,0,0\n3,1,0,0\n");
  auto source = make();
  EXPECT_EQ(source->open().frame_count, 3);
  source->seek(2);
  EXPECT_TRUE(source.read(2));
  EXPECT_FALSE(source.read(3));
  EXPECT_THAT(user_error([&] { source->seek(9); }).what(),
              HasSubstr("the ground truth has 3 frames"));
}

TEST_F(GroundTruthSourceTest, SparseAnnotationLeavesOtherFramesOut) {
  give_ground("3,1,0,0\n8,1,5,0\n13,2,0,0\n");
  options_.every = 5;
  EXPECT_THAT(faults(), IsEmpty());
  EXPECT_EQ(annotated(15), "nnynnnnynnnnynn");
}

TEST_F(GroundTruthSourceTest, RowsOutOfStepAreFaults) {
  give_ground("3,1,0,0\n8,1,5,0\n9,1,0,0\n10,1,0,0\n");
  options_.every = 5;
  EXPECT_THAT(faults(),
              ElementsAre((folder_ / "ground.csv").string() +
                          ":3: frame 9 and 1 more are not among every 5 frames from frame 3; set "
                          "\"every\" to the true distance between annotated frames"));
}

TEST_F(GroundTruthSourceTest, InterpolatesOnRequest) {
  options_.every = 4;
  options_.interpolate = true;
  give("a",
       "2,1,10,20,30,40,1,1,1\n2,2,0,0,9,9,1,1,1\n"
       "6,1,20,40,50,80,1,1,0.5\n6,3,0,0,9,9,1,1,1\n");
  give("b", "2,1,1,1,9,9,1,1,1\n10,1,1,1,9,9,1,1,1\n");
  give_ground("frame,id,x_m,y_m,heading_deg\n2,1,0,0,170\n6,1,4,2,-150\n");
  EXPECT_THAT(faults(), IsEmpty());
  EXPECT_EQ(annotated(12), "nyyyyyyyyynn");
  const GroundTruth truth = at(2);  // a quarter of the way
  ASSERT_EQ(truth.people.size(), 1U) << "2 and 3 are not in both";
  const TruePerson& person = truth.people[0];
  EXPECT_EQ(person.position_m, Eigen::Vector2d(1, 0.5));
  EXPECT_NEAR(degrees_from_radians(*person.heading_rad), 180, 1e-9) << "the short way round";
  ASSERT_EQ(person.views.size(), 1U) << "view b has 1 at one end only";
  EXPECT_EQ(person.views[0].box, (Box{.left = 12.5, .top = 25, .width = 35, .height = 50}));
  EXPECT_EQ(person.views[0].visibility, 0.875);
  EXPECT_THAT(ids(1), ElementsAre(1, 2)) << "annotated frames are as they are";
}

TEST_F(GroundTruthSourceTest, AreaOnlyLeavesOutWhoStandsOutside) {
  scene_->area = {.min_m = {-5, 1}, .max_m = {5, 9}};
  give_ground("1,1,0,0.9\n1,2,5,9\n1,3,0,2\n2,1,0,1\n");
  give("a", "1,4,10,20,30,40,1,-1,-1,-1\n");
  EXPECT_THAT(ids(0), ElementsAre(1, 2, 3, 4));
  options_.area_only = true;
  EXPECT_THAT(ids(0), ElementsAre(2, 3, 4)) << "the border belongs to the area; 4 has no position";
  EXPECT_THAT(ids(1), ElementsAre(1));
}

TEST_F(GroundTruthSourceTest, ReportsEveryFaultOfEveryFile) {
  give("a", "1,1,10,20,30,40,1\n1,1,10,20,30,40,1\n");
  give("x", "1,1,10,20,30,40,1\n");
  options_.ground = folder_ / "gone.csv";
  EXPECT_THAT(faults(),
              ElementsAre(HasSubstr("/files/x: the scene has no camera 'x'"),
                          AllOf(HasSubstr("a.txt:2"), HasSubstr("/files/a: ")),
                          AllOf(HasSubstr("/ground: there is no file"), HasSubstr("gone.csv"))));
}

TEST_F(GroundTruthSourceTest, RowsNeedAnIdentity) {
  give("a", "1,-1,10,20,30,40,1\n");
  give_ground("1,0.5,2\n");
  EXPECT_THAT(faults(),
              ElementsAre(AllOf(HasSubstr("a.txt:1: "), HasSubstr("needs an identity")),
                          AllOf(HasSubstr("ground.csv:1: "), HasSubstr("needs an identity"))));
}

TEST_F(GroundTruthSourceTest, OptionsThatMeanNothingAreRefused) {
  EXPECT_EQ(user_error([&] { make(); }).what(),
            std::string("/files: there is nothing to read: give \"files\" with boxes per camera, "
                        "\"ground\" with positions, or both"));
  give_ground("1,1,0,0\n");
  options_.interpolate = true;
  EXPECT_THAT(user_error([&] { make(); }).what(),
              HasSubstr("/interpolate: there is nothing between"));
}

}  // namespace
}  // namespace plaza::sources
