#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "plaza/geometry/camera.h"
#include "tests/sdk/geometry/test_cameras.h"

namespace plaza {
namespace {

/// Box of a dense sample of the cylinder's side; never larger than the true one.
std::optional<Box> sampled_box(const Camera& camera, const Eigen::Vector2d& position,
                               const Body& body) {
  double left = 1e300, top = 1e300, right = -1e300, bottom = -1e300;
  for (int i = 0; i < 720; ++i) {
    const double angle = i * std::numbers::pi / 360;
    for (int level = 0; level <= 20; ++level) {
      const auto pixel = camera.project({position.x() + body.radius_m * std::cos(angle),
                                         position.y() + body.radius_m * std::sin(angle),
                                         body.height_m * level / 20});
      if (!pixel) return std::nullopt;
      left = std::min(left, pixel->x());
      right = std::max(right, pixel->x());
      top = std::min(top, pixel->y());
      bottom = std::max(bottom, pixel->y());
    }
  }
  return Box{left, top, right - left, bottom - top};
}

TEST(BodyBoxTest, EqualsADenseSampleOfTheCylinder) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> ground(-4, 4), height(1.2, 2.1), radius(0.1, 0.5);
  int compared = 0;
  for (int trial = 0; trial < 12; ++trial) {
    for (const Camera& camera : test::cameras_of_all_models(test::random_pose(random))) {
      const Eigen::Vector2d position(ground(random), ground(random));
      const Body body{height(random), radius(random)};
      const auto box = body_box(camera, position, body);
      const auto expected = sampled_box(camera, position, body);
      ASSERT_EQ(box.has_value(), expected.has_value()) << camera.name();
      if (!box) continue;
      // half a degree away from an extreme, a circle is 1 - cos(0.25 deg) = 1e-5 of its radius
      // short
      const double slack = 0.02 + 1e-4 * (box->width + box->height);
      EXPECT_LE(box->left, expected->left + 1e-6) << camera.name();
      EXPECT_LE(box->top, expected->top + 1e-6) << camera.name();
      EXPECT_GE(box->right(), expected->right() - 1e-6) << camera.name();
      EXPECT_GE(box->bottom(), expected->bottom() - 1e-6) << camera.name();
      EXPECT_NEAR(box->left, expected->left, slack) << camera.name();
      EXPECT_NEAR(box->top, expected->top, slack) << camera.name();
      EXPECT_NEAR(box->right(), expected->right(), slack) << camera.name();
      EXPECT_NEAR(box->bottom(), expected->bottom(), slack) << camera.name();
      ++compared;
    }
  }
  EXPECT_GT(compared, 60);
}

TEST(BodyBoxTest, IsExactForALevelPinholeCamera) {
  // Camera 1 m high, looking along +x; a cylinder of radius r at distance d spans the tangents'
  // angle.
  const CameraFromWorld pose = test::look_at({0, 0, 1}, {10, 0, 1});
  const Camera camera = Camera::pinhole("c", {640, 480}, {500, 500, 320, 240, {}}, pose);
  for (const double d : {20.0, 5.0, 1.0, 0.5}) {
    const Body body{1.8, 0.3};
    const auto box = body_box(camera, {d, 0}, body);
    ASSERT_TRUE(box);
    const double tangent = 0.3 / std::sqrt(d * d - 0.09);
    EXPECT_NEAR(box->left, 320 - 500 * tangent, 1e-6) << d;
    EXPECT_NEAR(box->right(), 320 + 500 * tangent, 1e-6) << d;
    EXPECT_NEAR(box->top, 240 - 500 * 0.8 / (d - 0.3), 1e-6) << d;
    EXPECT_NEAR(box->bottom(), 240 + 500 * 1.0 / (d - 0.3), 1e-6) << d;
  }
}

TEST(BodyBoxTest, IncludesSidesThatTheLensBendsOutwards) {
  // Level with the body's middle and at the image's right: barrel distortion pushes the middle
  // outwards.
  const CameraFromWorld pose = test::look_at({0, 0, 1}, {10, 0, 1});
  const Camera camera =
      Camera::pinhole("c", {640, 480}, {500, 500, 320, 240, {-0.3, 0.1, 0, 0, 0}}, pose);
  const Eigen::Vector2d position(2.5, -1.5);
  const Body body{2.0, 0.3};
  double rims = 0;
  for (int i = 0; i < 3600; ++i) {
    const double angle = i * std::numbers::pi / 1800;
    for (const double z : {0.0, 2.0}) {
      rims = std::max(rims, camera
                                .project({position.x() + 0.3 * std::cos(angle),
                                          position.y() + 0.3 * std::sin(angle), z})
                                ->x());
    }
  }
  EXPECT_GT(body_box(camera, position, body)->right(), rims + 2);
}

TEST(BodyBoxTest, NothingWhenAnyPartIsBehindTheCamera) {
  const CameraFromWorld pose = test::look_at({0, 0, 1}, {10, 0, 1});
  for (const Camera& camera : test::cameras_of_all_models(pose)) {
    EXPECT_FALSE(body_box(camera, {-5, 0}, {})) << camera.name();
    EXPECT_FALSE(body_box(camera, {0.1, 0}, {})) << camera.name() << ": the camera is inside";
    EXPECT_FALSE(body_box(camera, {0.29, 4}, {})) << camera.name() << ": one side is behind";
    EXPECT_TRUE(body_box(camera, {6, 0}, {})) << camera.name();
  }
  // looking steeply down: the feet are in front, the head reaches behind the image plane
  const Camera down = Camera::pinhole("down", {640, 480}, test::intrinsics(),
                                      test::look_at({0, 0, 1.5}, {0.2, 0, 0}));
  EXPECT_FALSE(body_box(down, {0.5, 0}, {1.8, 0.2}));
  EXPECT_TRUE(body_box(down, {0.5, 0}, {1.0, 0.2}));
}

TEST(BodyBoxTest, ReachesBeyondTheImageUncut) {
  const CameraFromWorld pose = test::look_at({0, 0, 1}, {10, 0, 1});
  const Camera camera = Camera::pinhole("c", {640, 480}, {500, 500, 320, 240, {}}, pose);
  const auto box = body_box(camera, {1, 0}, {1.8, 0.3});
  ASSERT_TRUE(box);
  EXPECT_LT(box->top, -200);
  EXPECT_GT(box->bottom(), 700);
}

}  // namespace
}  // namespace plaza
