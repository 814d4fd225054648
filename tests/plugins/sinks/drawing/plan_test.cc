#include "plugins/sinks/drawing/plan.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::drawing {
namespace {

cv::Vec3b bgr(const Color& c) {
  return {cv::saturate_cast<uchar>(c[0]), cv::saturate_cast<uchar>(c[1]),
          cv::saturate_cast<uchar>(c[2])};
}
cv::Vec3b at(const cv::Mat& picture, const Point& p) {
  return picture.at<cv::Vec3b>(cvRound(p.y), cvRound(p.x));
}

TEST(PlanMap, XIsRightAndYIsUp) {
  const PlanMap map({{-5, -4}, {5, 4}}, {0, 0, 200, 300});
  const Point origin = map.pixel({0, 0});
  EXPECT_NEAR(origin.x, 99.5, 1e-9);
  EXPECT_NEAR(origin.y, 149.5, 1e-9);
  EXPECT_DOUBLE_EQ(map.px_per_m(), 20);
  EXPECT_GT(map.pixel({1, 0}).x, origin.x);
  EXPECT_LT(map.pixel({0, 1}).y, origin.y);
  const Eigen::Vector2d there(1.25, -3.5);
  EXPECT_TRUE(map.metres(map.pixel(there)).isApprox(there, 1e-12));
}

TEST(Plan, ShowsTheAreaAndCamerasNearIt) {
  auto scene = test::ring_scene(1);
  scene->cameras.push_back(Camera::pinhole("near", {640, 480}, {600, 600, 319.5, 239.5, {}},
                                           test::look_at({7, 0, 3}, {0, 0, 1})));
  scene->cameras.push_back(Camera::pinhole("far", {640, 480}, {600, 600, 319.5, 239.5, {}},
                                           test::look_at({500, 0, 30}, {0, 0, 1})));
  const GroundArea extent = plan_extent(*scene);
  EXPECT_TRUE(extent.contains({5, 4}) && extent.contains({-5, -4}));
  EXPECT_TRUE(extent.contains({7, 0}));
  EXPECT_FALSE(extent.contains({14, 0}));
  EXPECT_LT(extent.max_m.x(), 10);
}

TEST(Plan, EverySizeIsDrawn) {
  const auto scene = test::ring_scene(8);
  for (const cv::Size size : {cv::Size(40, 40), cv::Size(900, 200), cv::Size(200, 900)}) {
    const Plan plan = draw_plan(*scene, size, light_theme(), {});
    EXPECT_EQ(plan.picture.size(), size);
  }
}

TEST(Plan, CameraThatLooksStraightDownIsDrawn) {
  auto scene = test::ring_scene(1);
  CameraFromWorld down;
  down.rotation << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  down.translation = {0, 0, 6};
  scene->cameras = {Camera::pinhole("top", {640, 480}, {600, 600, 319.5, 239.5, {}}, down)};
  const Plan plan = draw_plan(*scene, {400, 400}, dark_theme(), {});
  // its field of view, 6.4 m x 4.8 m, is lighter than the floor beside it
  const auto seen = at(plan.picture, plan.map.pixel({1.3, 1.3}));
  const auto unseen = at(plan.picture, plan.map.pixel({4.3, 3.3}));
  EXPECT_GT(seen[0], unseen[0]);
}

TEST(Plan, PeopleAreDotsInTheirColours) {
  const auto scene = test::ring_scene(2);
  Plan plan = draw_plan(*scene, {600, 500}, dark_theme(), {});
  const std::vector<PlanPerson> people = {{3, {2, 1}, std::nullopt, true},
                                          {4, {-2, 1}, std::numbers::pi / 2, true},
                                          {5, {-2, -2}, std::nullopt, false},
                                          {6, {1e6, 0}, 0.0, true}};
  draw_people(plan.picture, plan.map, people, 10, dark_theme());
  EXPECT_EQ(at(plan.picture, plan.map.pixel({2, 1})), bgr(color_of(3)));
  EXPECT_EQ(at(plan.picture, plan.map.pixel({-2, 1})), bgr(color_of(4)));
  // not observed: hollow
  EXPECT_EQ(at(plan.picture, plan.map.pixel({-2, -2})), bgr(dark_theme().paper));
  // the arrow of heading +y goes up
  const double radius_m = 0.25;
  EXPECT_EQ(at(plan.picture, plan.map.pixel({-2, 1 + 2.3 * radius_m})), bgr(color_of(4)));
  EXPECT_NE(at(plan.picture, plan.map.pixel({-2, 1 - 2.3 * radius_m})), bgr(color_of(4)));
}

}  // namespace
}  // namespace plaza::drawing
