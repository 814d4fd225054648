#include "framework/results/result_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <limits>
#include <numbers>

#include "framework/results/number_text.h"
#include "plaza/core/error.h"
#include "tests/support/execution_doubles.h"

namespace plaza {
namespace {

using test::lines_of;
using ::testing::ElementsAre;

TEST(NumberTextTest, IsFixedRoundedAndWithoutNegativeZero) {
  EXPECT_EQ(fixed_text(1.0 / 3, 4), "0.3333");
  EXPECT_EQ(fixed_text(2, 0), "2");
  EXPECT_EQ(fixed_text(-1.25, 1), "-1.2");  // ties to even
  EXPECT_EQ(fixed_text(-0.00001, 3), "0.000");
  EXPECT_EQ(fixed_text(-0.0, 2), "0.00");
  EXPECT_EQ(fixed_text(1e21, 1), "1000000000000000000000.0");
  EXPECT_EQ(fixed_text(std::numeric_limits<double>::max(), 2).size(), 312u);
  EXPECT_THROW(fixed_text(std::numeric_limits<double>::infinity(), 2), InternalError);
  EXPECT_THROW(fixed_text(std::numeric_limits<double>::quiet_NaN(), 2), InternalError);
}

TEST(NumberTextTest, DoesNotFollowTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  EXPECT_EQ(fixed_text(1234.5, 1), "1234.5");
  std::setlocale(LC_ALL, before.c_str());
}

class ResultFilesTest : public ::testing::Test {
 protected:
  static TrackPoint person(TrackId id, std::int64_t frame, double x_m, double y_m) {
    TrackPoint p;
    p.id = id;
    p.frame = frame;
    p.position_m = {x_m, y_m};
    p.score = 0.5;
    p.final = true;
    return p;
  }
  test::TemporaryFolder folder_;
  std::shared_ptr<const Scene> scene_ = test::double_scene();
};

TEST_F(ResultFilesTest, ObservationsHaveEmptyFieldsForWhatIsUnknown) {
  ObservationsFile file(folder_.path());
  Observations two;
  two.items.resize(2);
  two.items[0].position_m = {1.23456, -2};
  two.items[0].probability = 0.75;
  two.items[1].heading_rad = -1.5 * std::numbers::pi;
  file.add(0, two);
  file.add(1, {});
  file.add(9, two);
  file.commit();
  EXPECT_THAT(lines_of(folder_ / "observations.ground.csv"),
              ElementsAre("frame,x_m,y_m,heading_deg,score", "1,1.2346,-2.0000,,0.750000",
                          "1,0.0000,0.0000,90.000,0.000000", "10,1.2346,-2.0000,,0.750000",
                          "10,0.0000,0.0000,90.000,0.000000"));
}

TEST_F(ResultFilesTest, MeasuredBoxesComeBeforeDrawnOnes) {
  TrackPoint p = person(3, 0, 0, 2);
  const auto drawn = box_in_view(p, *scene_, 0);
  ASSERT_TRUE(drawn);
  EXPECT_EQ(*drawn, *body_box(scene_->cameras[0], p.position_m, scene_->body));
  p.boxes.push_back({.camera = 1, .box = {5, 6, 7, 8}, .score = 1});
  EXPECT_EQ(*box_in_view(p, *scene_, 0), *drawn) << "measured in the other view only";
  EXPECT_EQ(*box_in_view(p, *scene_, 1), (Box{5, 6, 7, 8}));
}

TEST_F(ResultFilesTest, WhoIsWhollyOutsideHasNoBox) {
  EXPECT_TRUE(box_in_view(person(1, 0, 0, 2), *scene_, 0));
  EXPECT_FALSE(box_in_view(person(1, 0, 60, 2), *scene_, 0)) << "far to the right";
  EXPECT_FALSE(box_in_view(person(1, 0, 0, -9), *scene_, 0)) << "behind the camera";
  TrackPoint p = person(1, 0, 0, 2);
  p.boxes.push_back({.camera = 0, .box = {-10, 5, 9.5, 10}, .score = 1});
  EXPECT_FALSE(box_in_view(p, *scene_, 0)) << "ends where the image begins";
  p.boxes[0].box.width = 9.6;
  EXPECT_TRUE(box_in_view(p, *scene_, 0)) << "reaches into the first pixel";
}

TEST_F(ResultFilesTest, TracksAreByFrameThenIdAndIdsAreShared) {
  TrackStore store("tracks", 0);
  Tracks tracks;
  tracks.points = {person(2, 1, 0, 2), person(1, 1, 60, 2), person(1, 0, 0.5, 3),
                   person(4, 2, 0, 2)};
  tracks.points[2].heading_rad = std::numbers::pi / 2;
  tracks.points[2].boxes.push_back({.camera = 0, .box = {1.5, 2.25, 3, 4}, .score = 9});
  store.add(tracks);
  const auto artifacts = write_tracks(folder_.path(), store, 2, *scene_);
  EXPECT_EQ(artifacts.size(), 3u);
  EXPECT_THAT(lines_of(folder_ / "tracks.ground.csv"),
              ElementsAre("frame,id,x_m,y_m,heading_deg,score", "1,1,0.5000,3.0000,90.000,0.500000",
                          "2,1,60.0000,2.0000,,0.500000", "2,2,0.0000,2.0000,,0.500000"))
      << "frames from the end on are left out";
  const auto left = lines_of(folder_ / "tracks.left.txt");
  ASSERT_EQ(left.size(), 2u) << "id 1 is outside in frame 2";
  EXPECT_EQ(left[0], "1,1,1.500,2.250,3.000,4.000,0.500000,0.5000,3.0000,0.0000");
  EXPECT_THAT(left[1], ::testing::StartsWith("2,2,"));
  EXPECT_EQ(std::count(left[1].begin(), left[1].end(), ','), 9);
}

TEST_F(ResultFilesTest, OnlyTheContractsFilesAreTakenAway) {
  for (const char* name : {"tracks.ground.csv", "tracks.left.txt", "tracks.left.txt.part",
                           "tracks.other.txt", "mine.csv"}) {
    test::write_text(folder_ / name, "x");
  }
  remove_earlier_results(folder_.path(), *scene_);
  std::vector<std::string> names;
  for (const auto& [name, content] : test::contents_of(folder_.path())) names.push_back(name);
  EXPECT_THAT(names, ElementsAre("mine.csv", "tracks.other.txt"));
}

}  // namespace
}  // namespace plaza
