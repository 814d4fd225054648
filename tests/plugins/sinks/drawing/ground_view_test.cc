#include "plugins/sinks/drawing/ground_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::drawing {
namespace {

TEST(GroundView, StepsAreRound) {
  EXPECT_DOUBLE_EQ(round_step(1), 1);
  EXPECT_DOUBLE_EQ(round_step(1.01), 2);
  EXPECT_DOUBLE_EQ(round_step(2.5), 5);
  EXPECT_DOUBLE_EQ(round_step(7), 10);
  EXPECT_DOUBLE_EQ(round_step(0.03), 0.05);
}

TEST(GroundView, MultiplesIncludeBothEnds) {
  EXPECT_THAT(multiples(-1, 1, 0.5), testing::ElementsAre(-1, -0.5, 0, 0.5, 1));
  EXPECT_THAT(multiples(0.1, 0.9, 1), testing::IsEmpty());
  EXPECT_THAT(multiples(-14.07, -9.9, 2), testing::ElementsAre(-14, -12, -10));
}

TEST(GroundView, PathsBehindTheCameraAreCutOff) {
  const auto scene = test::ring_scene(1);  // at x = 14 m, looking along -x
  const Camera& camera = scene->cameras[0];
  const std::vector<Eigen::Vector2d> through = {{0, 0}, {40, 0}};
  const auto pieces = seen_pieces(camera, through);
  ASSERT_EQ(pieces.size(), 1U);
  // begins at the origin's pixel and never comes back from infinity
  const auto origin = camera.project({0, 0, 0});
  EXPECT_NEAR(pieces[0].front().y, origin->y(), 1e-9);
  EXPECT_TRUE(std::is_sorted(pieces[0].begin(), pieces[0].end(),
                             [](const Point& a, const Point& b) { return a.y < b.y; }));
  const std::vector<Eigen::Vector2d> behind = {{30, 0}, {40, 0}};
  EXPECT_TRUE(seen_pieces(camera, behind).empty());
}

TEST(GroundView, CylinderHasTheBodysBox) {
  const auto scene = test::ring_scene(3);
  for (const Camera& camera : scene->cameras) {
    const Eigen::Vector2d position(1.5, -2);
    const auto outline = cylinder_outline(camera, position, scene->body);
    const auto box = body_box(camera, position, scene->body);
    ASSERT_TRUE(outline && box);
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const Point& p : outline->contour) {
      left = std::min(left, p.x);
      right = std::max(right, p.x);
      top = std::min(top, p.y);
      bottom = std::max(bottom, p.y);
    }
    EXPECT_NEAR(left, box->left, 0.5);
    EXPECT_NEAR(right, box->right(), 0.5);
    EXPECT_NEAR(top, box->top, 0.5);
    EXPECT_NEAR(bottom, box->bottom(), 0.5);
  }
}

TEST(GroundView, NoCylinderBehindTheCamera) {
  const auto scene = test::ring_scene(1);
  EXPECT_FALSE(cylinder_outline(scene->cameras[0], {20, 0}, scene->body));
  EXPECT_FALSE(cylinder_outline(scene->cameras[0], {40, 0}, scene->body));
}

TEST(GroundView, ArrowPointsWhereThePersonFaces) {
  const GroundArrow arrow = ground_arrow({1, 2}, std::numbers::pi / 2, 0.8);
  EXPECT_NEAR(arrow.head_m[0].x(), 1, 1e-12);
  EXPECT_NEAR(arrow.head_m[0].y(), 2.8, 1e-12);
  EXPECT_LT(arrow.head_m[1].x(), 1);  // left of north is west
  EXPECT_GT(arrow.head_m[2].x(), 1);
}

}  // namespace
}  // namespace plaza::drawing
