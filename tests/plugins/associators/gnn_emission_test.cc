// What is put out when, and with which words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/plugins/associators/gnn_script.h"

namespace plaza {
namespace {

using ::testing::ElementsAre;
using testing::GnnScript;

Gnn::Options emission_options() {
  Gnn::Options o;
  o.confirm = 2;
  o.max_count = 8;
  return o;
}

TEST(GnnEmission, WithoutSmoothingObservedPointsAreFinalAtOnce) {
  GnnScript script(emission_options());
  script.see({{0, 0}});
  script.see({{0.1, 0}});
  const AssociatorOutput now = script.see({{0.2, 0}});
  ASSERT_EQ(now.points.size(), 1U);
  EXPECT_TRUE(now.points[0].final);
  EXPECT_EQ(now.points[0].frame, 2);
}

TEST(GnnEmission, CoastingPointsAreOpenUntilAnObservationBridgesTheGap) {
  GnnScript script(emission_options());
  for (int i = 0; i < 6; ++i) script.see({{0.1 * i, 0}});
  for (int i = 6; i < 9; ++i) {
    const AssociatorOutput open = script.see_nobody();
    ASSERT_EQ(open.points.size(), 1U);
    EXPECT_FALSE(open.points[0].final);
    EXPECT_FALSE(open.points[0].observed);
  }
  const AssociatorOutput bridged = script.see({{0.9, 0}});
  ASSERT_EQ(bridged.points.size(), 4U);
  for (const TrackPoint& p : bridged.points) {
    EXPECT_TRUE(p.final);
    EXPECT_EQ(p.observed, p.frame == 9);
    EXPECT_NEAR(p.position_m.x(), 0.1 * static_cast<double>(p.frame), 0.06);
  }
}

TEST(GnnEmission, WhoDoesNotComeBackIsPutOutForTheDeclaredTimeOnly) {
  for (const double coast_s : {0.0, 0.3}) {
    Gnn::Options o = emission_options();
    o.coast_s = coast_s;
    GnnScript script(o);
    for (int i = 0; i < 6; ++i) script.see({{0.1 * i, 0}});
    for (int i = 0; i < 10; ++i) script.see_nobody();
    script.flush();
    EXPECT_EQ(script.frames_of(1).size(), coast_s > 0 ? 9U : 6U);
  }
}

TEST(GnnEmission, SmoothedPointsWaitForTheWindowAndAreBetter) {
  double error[2] = {0, 0};
  for (const bool smooth : {false, true}) {
    Gnn::Options o = emission_options();
    o.smoothing_s = smooth ? 0.5 : 0.0;
    GnnScript script(o);
    for (int i = 0; i < 40; ++i) {
      const double zigzag = i % 2 ? 0.15 : -0.15;
      const AssociatorOutput now = script.see({{0.1 * i, zigzag}});
      for (const TrackPoint& p : now.points) {
        EXPECT_EQ(p.final, !smooth || p.frame <= i - 5) << p.frame << " at " << i;
      }
    }
    script.flush();
    EXPECT_EQ(script.frames_of(1).size(), 40U);
    for (const auto& [frame, points] : script.final_points()) {
      error[smooth] += std::abs(points.at(1).position_m.y());
    }
  }
  EXPECT_LT(error[1], 0.5 * error[0]);
}

TEST(GnnEmission, OnlyPointsInsideTheAreaArePutOut) {
  for (const double margin_m : {0.0, 0.5}) {
    Gnn::Options o = emission_options();
    o.margin_m = margin_m;
    GnnScript script(o);
    for (int i = 0; i < 20; ++i) script.see({{9.05 + 0.1 * i, 0}});
    script.flush();
    EXPECT_NEAR(static_cast<double>(script.frames_of(1).size()), 10 + 10 * margin_m, 1);
    for (const auto& [frame, points] : script.final_points()) {
      EXPECT_LE(points.at(1).position_m.x(), 10 + margin_m);
    }
  }
}

TEST(GnnEmission, PeopleFaceWhereTheyWalkAndElseAsObserved) {
  GnnScript script(emission_options());
  for (int i = 0; i < 30; ++i) {
    Observations o;
    o.items.resize(2);
    o.items[0].position_m = {0, 0.12 * i};
    o.items[1].position_m = {5, 5};
    for (Observation& item : o.items) {
      item.covariance_m2 = 0.01 * Eigen::Matrix2d::Identity();
      item.probability = 0.9;
      item.heading_rad = -2.0;
    }
    script.see(o);
  }
  script.flush();
  const TrackId walker = script.id_at(29, {0, 3.5}), stander = script.id_at(29, {5, 5});
  EXPECT_NEAR(*script.final_points().at(29).at(walker).heading_rad, std::numbers::pi / 2, 0.1);
  EXPECT_DOUBLE_EQ(*script.final_points().at(29).at(stander).heading_rad, -2.0);
}

TEST(GnnEmission, StandingPeopleWithoutObservedHeadingHaveNone) {
  GnnScript script(emission_options());
  for (int i = 0; i < 10; ++i) script.see({{1, 1}});
  script.flush();
  EXPECT_FALSE(script.final_points().at(9).at(1).heading_rad);
}

TEST(GnnEmission, BoxesOfTheObservationComeAlong) {
  GnnScript script(emission_options());
  for (int i = 0; i < 3; ++i) {
    Observations o;
    o.items.resize(1);
    o.items[0].covariance_m2 = 0.01 * Eigen::Matrix2d::Identity();
    o.items[0].boxes.push_back(
        {.camera = 2, .box = {.left = 1.0 * i, .top = 2, .width = 3, .height = 4}, .score = 5});
    script.see(o);
  }
  const TrackPoint& p = script.final_points().at(1).at(1);
  ASSERT_EQ(p.boxes.size(), 1U);
  EXPECT_EQ(p.boxes[0].camera, 2U);
  EXPECT_DOUBLE_EQ(p.boxes[0].box.left, 1.0);
}

TEST(GnnEmission, TrackletsAreTheFinalPathsWhenTheyEnd) {
  GnnScript script(emission_options());
  for (int i = 0; i < 10; ++i) script.see({{0, 0}, {3, 0}});
  for (int i = 0; i < 10; ++i) script.see({{0, 0}});  // the second one is gone after 8 frames
  ASSERT_EQ(script.tracklets().size(), 1U);
  EXPECT_EQ(script.tracklets()[0].id, 2);
  EXPECT_EQ(script.tracklets()[0].points.size(), 10U);
  script.flush();
  ASSERT_EQ(script.tracklets().size(), 2U);
  const Tracklet& first = script.tracklets()[1];
  EXPECT_EQ(first.points.size(), 20U);
  for (std::size_t i = 0; i < first.points.size(); ++i) {
    const TrackPoint& p = first.points[i];
    EXPECT_TRUE(p.final);
    EXPECT_EQ(p.frame, static_cast<std::int64_t>(i));
    EXPECT_EQ(p.position_m, script.final_points().at(p.frame).at(1).position_m);
  }
}

}  // namespace
}  // namespace plaza
