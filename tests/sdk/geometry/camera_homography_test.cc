#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "plaza/core/error.h"
#include "plaza/geometry/camera.h"
#include "tests/sdk/geometry/same_camera.h"
#include "tests/sdk/geometry/test_cameras.h"

namespace plaza {
namespace {

/// The homography of the plane z of an ideal pinhole camera, arbitrarily scaled.
Eigen::Matrix3d homography(const PinholeIntrinsics& in, const CameraFromWorld& pose, double z,
                           double scale) {
  Eigen::Matrix3d k;
  k << in.fx_px, 0, in.cx_px, 0, in.fy_px, in.cy_px, 0, 0, 1;
  Eigen::Matrix3d m;
  m << pose.rotation.leftCols<2>(), pose.rotation.col(2) * z + pose.translation;
  return scale * k * m;
}

TEST(PlaneHomographiesTest, GiveBackTheWholeCamera) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> ground(-3, 3), height(0, 2.5);
  for (int trial = 0; trial < 30; ++trial) {
    const CameraFromWorld pose = test::random_pose(random);
    const PinholeIntrinsics in = test::intrinsics();
    const Camera expected = Camera::pinhole("c", {640, 480}, in, pose);
    // a projection matrix has no sign: any combination must do
    const double a = trial % 2 == 0 ? 3.7 : -0.02, b = trial % 3 == 0 ? -11 : 0.5;
    const Camera camera = Camera::plane_homographies("c", {640, 480}, homography(in, pose, 0, a),
                                                     homography(in, pose, 1.8, b), 1.8);
    EXPECT_LT((camera.centre() - expected.centre()).norm(), 1e-7);
    EXPECT_LT((camera.pose().rotation - pose.rotation).norm(), 1e-9);
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d x(ground(random), ground(random), height(random));
      const auto pixel = camera.project(x);
      ASSERT_EQ(pixel.has_value(), expected.project(x).has_value());
      if (!pixel) continue;
      EXPECT_LT((*pixel - *expected.project(x)).norm(), 1e-6);
      const auto there = camera.to_plane(*pixel, x.z());
      ASSERT_TRUE(there);
      EXPECT_LT((*there - x.head<2>()).norm(), 1e-6);
    }
    EXPECT_FALSE(camera.project(camera.centre() - pose.rotation.row(2).transpose()));
  }
}

TEST(PlaneHomographiesTest, KeepSkewAndScaleWithTheImage) {
  const CameraFromWorld pose = test::look_at({8, 1, 4}, {0, 0, 1});
  const PinholeIntrinsics in = test::intrinsics();
  Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
  shear(0, 1) = 0.05;
  const Eigen::Matrix3d ground = shear * homography(in, pose, 0, 1);
  const Eigen::Matrix3d head = shear * homography(in, pose, 2, 1);
  const Camera camera = Camera::plane_homographies("c", {640, 480}, ground, head, 2);
  const Eigen::Vector3d x(1, -0.5, 0);
  const Eigen::Vector2d expected = (ground * Eigen::Vector3d(1, -0.5, 1)).hnormalized();
  EXPECT_LT((*camera.project(x) - expected).norm(), 1e-8);
  test::expect_same_camera(camera, test::made_again(camera));
  const Camera half = camera.scaled({320, 240});
  test::expect_same_camera(half, test::made_again(half));
  EXPECT_NE(std::get<PinholeIntrinsics>(half.intrinsics()).skew_px, 0);
  EXPECT_NEAR(half.project(x)->x() + 0.5, (expected.x() + 0.5) / 2, 1e-8);
  EXPECT_LT((*half.to_plane(*half.project(x)) - x.head<2>()).norm(), 1e-8);
}

TEST(PlaneHomographiesTest, TolerateRoundedNumbers) {
  const CameraFromWorld pose = test::look_at({8, 1, 4}, {0, 0, 1});
  Eigen::Matrix3d ground = homography(test::intrinsics(), pose, 0, 1);
  Eigen::Matrix3d head = homography(test::intrinsics(), pose, 1.75, 1);
  for (Eigen::Matrix3d* h : {&ground, &head}) {
    *h = (*h / (*h)(2, 2) * 1e4).array().round() / 1e4;
  }
  const Camera camera = Camera::plane_homographies("c", {640, 480}, ground, head, 1.75);
  const Eigen::Vector2d expected = (ground * Eigen::Vector3d(0.5, 0.5, 1)).hnormalized();
  EXPECT_LT((*camera.project({0.5, 0.5, 0}) - expected).norm(), 0.5);
}

TEST(PlaneHomographiesTest, RefuseContradictions) {
  const CameraFromWorld pose = test::look_at({8, 1, 4}, {0, 0, 1});
  const CameraFromWorld other = test::look_at({1, 8, 4}, {0, 0, 1});
  const PinholeIntrinsics in = test::intrinsics();
  const Eigen::Matrix3d ground = homography(in, pose, 0, 1);
  const auto message = [&](const Eigen::Matrix3d& g, const Eigen::Matrix3d& h) -> std::string {
    try {
      Camera::plane_homographies("left", {640, 480}, g, h, 1.8);
    } catch (const UserError& error) {
      return error.what();
    }
    return "no error";
  };
  using testing::HasSubstr;
  EXPECT_THAT(
      message(ground, homography(in, other, 1.8, 1)),
      HasSubstr("camera 'left': the ground and the head-plane homography do not come from one"));
  EXPECT_THAT(message(ground, ground), HasSubstr("two heights"));
  EXPECT_THAT(message(ground, Eigen::Matrix3d::Ones()),
              HasSubstr("head-plane homography is singular"));
  EXPECT_THAT(message(ground.inverse(), homography(in, pose, 1.8, 1)), HasSubstr("one camera"));
  EXPECT_THROW(Camera::plane_homographies("c", {640, 480}, ground, ground, 0),
               std::invalid_argument);
}

}  // namespace
}  // namespace plaza
