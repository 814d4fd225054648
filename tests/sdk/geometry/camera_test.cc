#include "plaza/geometry/camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <random>

#include "tests/sdk/geometry/same_camera.h"
#include "tests/sdk/geometry/test_cameras.h"

namespace plaza {
namespace {

using test::cameras_of_all_models;
using test::look_at;

TEST(CameraTest, PixelToRayToPixelIsTheIdentityForAllModels) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-0.5, 639.5), v(-0.5, 479.5), distance(0.5, 60);
  for (int trial = 0; trial < 20; ++trial) {
    for (const Camera& camera : cameras_of_all_models(test::random_pose(random))) {
      for (int i = 0; i < 50; ++i) {
        const Eigen::Vector2d pixel(u(random), v(random));
        const auto ray = camera.ray(pixel);
        ASSERT_TRUE(ray) << camera.name() << " at " << pixel.transpose();
        EXPECT_NEAR(ray->direction.norm(), 1, 1e-12);
        EXPECT_NEAR((ray->origin - camera.centre()).norm(), 0, 1e-12);
        const auto again = camera.project(ray->origin + distance(random) * ray->direction);
        ASSERT_TRUE(again) << camera.name() << " at " << pixel.transpose();
        EXPECT_LT((*again - pixel).norm(), 1e-7) << camera.name();
      }
    }
  }
}

TEST(CameraTest, GroundToPixelToGroundIsTheIdentityForAllModels) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> ground(-3, 3), height(0, 1.8);
  for (int trial = 0; trial < 20; ++trial) {
    for (const Camera& camera : cameras_of_all_models(test::random_pose(random))) {
      for (int i = 0; i < 20; ++i) {
        const double z = height(random);
        const Eigen::Vector3d x(ground(random), ground(random), z);
        const auto pixel = camera.project(x);
        if (!pixel || !camera.contains(*pixel)) continue;
        const auto there = camera.to_plane(*pixel, z);
        ASSERT_TRUE(there) << camera.name();
        EXPECT_LT((*there - x.head<2>()).norm(), 1e-7) << camera.name();
      }
    }
  }
}

TEST(CameraTest, AgreesWithOpenCvProjectPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> world(-3, 3);
  std::uniform_real_distribution<double> k1(-0.3, 0.3), k2(-0.1, 0.1), p(-3e-3, 3e-3);
  for (int trial = 0; trial < 50; ++trial) {
    const Distortion d{k1(random), k2(random), p(random), p(random), 0.2 * k2(random)};
    const CameraFromWorld pose = test::random_pose(random);
    const Camera camera = Camera::pinhole("c", {640, 480}, test::intrinsics(d), pose);
    cv::Matx33d rotation;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) rotation(r, c) = pose.rotation(r, c);
    }
    cv::Vec3d rvec;
    cv::Rodrigues(rotation, rvec);
    const cv::Vec3d tvec(pose.translation.x(), pose.translation.y(), pose.translation.z());
    const cv::Matx33d k(600, 0, 322, 0, 590, 241, 0, 0, 1);
    const cv::Matx<double, 5, 1> coefficients(d.k1, d.k2, d.p1, d.p2, d.k3);
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d x(world(random), world(random), std::abs(world(random)));
      const auto pixel = camera.project(x);
      if (!pixel) continue;  // OpenCV answers beyond the fold as well
      std::vector<cv::Point2d> expected;
      cv::projectPoints(std::vector<cv::Point3d>{{x.x(), x.y(), x.z()}}, rvec, tvec, k,
                        coefficients, expected);
      EXPECT_NEAR(pixel->x(), expected[0].x, 1e-8);
      EXPECT_NEAR(pixel->y(), expected[0].y, 1e-8);
    }
  }
}

TEST(CameraTest, TsaiSatisfiesItsDefiningEquation) {
  const CameraFromWorld pose = look_at({8, 1, 4}, {0, 0, 1});
  for (const double kappa1 : {3e-2, 1e-5, -1e-5, -1.2e-2}) {
    const TsaiIntrinsics in = test::tsai_intrinsics(kappa1);
    const Camera camera = Camera::tsai("t", {768, 576}, in, pose);
    for (const Eigen::Vector3d& x :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, -2, 1.7), Eigen::Vector3d(-3, 2, 0.4)}) {
      const auto pixel = camera.project(x);
      ASSERT_TRUE(pixel);
      const double xd_mm = (pixel->x() - in.cx_px) * in.dpx_mm / in.sx;
      const double yd_mm = (pixel->y() - in.cy_px) * in.dpy_mm;
      const double factor = 1 + kappa1 * (xd_mm * xd_mm + yd_mm * yd_mm);
      const Eigen::Vector3d c = pose.rotation * x + pose.translation;
      EXPECT_NEAR(xd_mm * factor, in.focal_mm * c.x() / c.z(), 1e-12) << kappa1;
      EXPECT_NEAR(yd_mm * factor, in.focal_mm * c.y() / c.z(), 1e-12) << kappa1;
    }
  }
}

TEST(CameraTest, TsaiIsContinuousInKappaAtZero) {
  const CameraFromWorld pose = look_at({8, 1, 4}, {0, 0, 1});
  const Eigen::Vector3d x(1, -2, 1.7);
  const Camera ideal = Camera::tsai("t", {768, 576}, test::tsai_intrinsics(0), pose);
  for (const double kappa1 : {1e-12, -1e-12, 1e-16, -1e-16, 1e-300, -1e-300}) {
    const Camera camera = Camera::tsai("t", {768, 576}, test::tsai_intrinsics(kappa1), pose);
    ASSERT_TRUE(camera.project(x)) << kappa1;
    EXPECT_LT((*camera.project(x) - *ideal.project(x)).norm(), 1e-7) << kappa1;
  }
}

TEST(CameraTest, NothingBehindTheCameraOrInItsPlane) {
  const CameraFromWorld pose = look_at({0, 0, 2}, {10, 0, 2});
  for (const Camera& camera : cameras_of_all_models(pose)) {
    EXPECT_TRUE(camera.project({5, 0, 2})) << camera.name();
    EXPECT_FALSE(camera.project({-5, 0, 2})) << camera.name();
    EXPECT_FALSE(camera.project({-5, 1, 0})) << camera.name();
    EXPECT_FALSE(camera.project({0, 3, 2})) << camera.name();
    EXPECT_FALSE(camera.project({0, 0, 2})) << camera.name();
    EXPECT_FALSE(camera.project({1e-9, 3, 2})) << camera.name();
    EXPECT_FALSE(camera.project({std::numeric_limits<double>::quiet_NaN(), 0, 2})) << camera.name();
  }
}

TEST(CameraTest, NothingBeyondTheRadiusWhereDistortionFoldsBack) {
  // r (1 - r^2 / 3) rises up to r = 1, where it is 2 / 3
  const CameraFromWorld pose;  // at the origin, along +z
  const Camera camera =
      Camera::pinhole("fold", {640, 480}, {100, 100, 320, 240, {-1.0 / 3, 0, 0, 0, 0}}, pose);
  ASSERT_TRUE(camera.project({0.999, 0, 1}));
  EXPECT_NEAR(camera.project({0.999, 0, 1})->x(), 320 + 100 * 2.0 / 3, 1e-3);
  EXPECT_FALSE(camera.project({1.001, 0, 1}));
  EXPECT_FALSE(camera.project({1.7, 0, 1})) << "folds back to the middle of the image";
  EXPECT_TRUE(camera.ray({320 + 66.6, 240}));
  EXPECT_FALSE(camera.ray({320 + 66.7, 240}));

  // Tsai: undistorted = distorted (1 - distorted^2 / 3) rises up to distorted = 1
  const Camera tsai =
      Camera::tsai("fold", {640, 480}, {1, -1.0 / 3, 0.01, 0.01, 1, 320, 240}, pose);
  EXPECT_TRUE(tsai.project({0.6666, 0, 1}));
  EXPECT_FALSE(tsai.project({0.6667, 0, 1}));
  EXPECT_TRUE(tsai.ray({320 + 99.9, 240}));
  EXPECT_FALSE(tsai.ray({320 + 100.1, 240}));
}

TEST(CameraTest, FoldOfEveryPolynomialIsWhereItsSlopeFirstVanishes) {
  const CameraFromWorld pose;
  for (const Distortion& d : {Distortion{-0.3, 0.1, 0, 0, 0}, Distortion{-0.3, 0.02, 0, 0, 0},
                              Distortion{0.3, -0.2, 0, 0, 0}, Distortion{0.3, -0.2, 0, 0, 0.01},
                              Distortion{-0.5, 0.4, 0, 0, -0.2}, Distortion{0, 0, 0, 0, -0.05},
                              Distortion{0, -0.1, 0, 0, 0}, Distortion{0.1, 0.1, 0, 0, 0.1},
                              Distortion{-1e-9, 0, 0, 0, 0}}) {
    const Camera camera = Camera::pinhole("c", {10, 10}, {1, 1, 0, 0, d}, pose);
    bool folded = false;
    for (double r = 0; r < 4; r += 0.001) {
      const double q = r * r;
      const double slope = 1 + q * (3 * d.k1 + q * (5 * d.k2 + q * 7 * d.k3));
      folded = folded || slope <= 0;
      if (std::abs(slope) < 5e-3) continue;  // too near to the fold for a step of 0.001 to tell
      EXPECT_EQ(camera.project({r, 0, 1}).has_value(), !folded)
          << "k " << d.k1 << " " << d.k2 << " " << d.k3 << " r " << r;
    }
  }
}

TEST(CameraTest, NothingInsteadOfInfinityForAbsurdNumbers) {
  const CameraFromWorld pose = look_at({8, 1, 4}, {0, 0, 1});
  const Camera strong =
      Camera::tsai("t", {768, 576}, {5.5, 5e-3, 5e-8, 4.5e110, 1, 324, 282}, pose);
  EXPECT_FALSE(strong.ray({0, 0}));
  EXPECT_FALSE(strong.to_plane({0, 500}));
  const Camera huge = Camera::pinhole("p", {640, 480}, {1e308, 1e308, 0, 0, {}}, pose);
  EXPECT_FALSE(huge.project({7, 40, 4}));
}

TEST(CameraTest, NothingOnAPlaneAtOrAboveTheHorizon) {
  const CameraFromWorld pose = look_at({0, 0, 2}, {10, 0, 2});  // level: the horizon is at cy
  const Camera camera = Camera::pinhole("c", {640, 480}, test::intrinsics(), pose);
  EXPECT_FALSE(camera.to_plane({322, 241}));
  EXPECT_FALSE(camera.to_plane({322, 100}));
  EXPECT_FALSE(camera.plane_jacobian({322, 100}));
  ASSERT_TRUE(camera.to_plane({322, 300}));
  EXPECT_NEAR(camera.to_plane({322, 300})->x(), 2 * 590.0 / 59, 1e-9);
  // a plane above the camera is seen above the horizon only, its own plane never
  EXPECT_TRUE(camera.to_plane({322, 100}, 3));
  EXPECT_FALSE(camera.to_plane({322, 300}, 3));
  EXPECT_FALSE(camera.to_plane({322, 300}, 2));
}

TEST(CameraTest, PlaneJacobianIsTheDerivativeOfToPlane) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0, 639), v(200, 479);
  for (int trial = 0; trial < 10; ++trial) {
    for (const Camera& camera : cameras_of_all_models(test::random_pose(random))) {
      const Eigen::Vector2d pixel(u(random), v(random));
      const auto jacobian = camera.plane_jacobian(pixel, 0.3);
      const auto there = camera.to_plane(pixel, 0.3);
      ASSERT_EQ(jacobian.has_value(), there.has_value());
      if (!there || there->norm() > 100) continue;
      const double h = 1e-3;
      for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(axis);
        const Eigen::Vector2d slope =
            (*camera.to_plane(pixel + step, 0.3) - *camera.to_plane(pixel - step, 0.3)) / (2 * h);
        EXPECT_LT((jacobian->col(axis) - slope).norm(), 1e-6 * (1 + slope.norm())) << camera.name();
      }
    }
  }
}

TEST(CameraTest, ScalingKeepsThePartOfTheImageAPointFallsOn) {
  std::mt19937 random(5);
  const Eigen::Vector3d x(0.3, -0.7, 1.1);
  for (const Camera& camera : cameras_of_all_models(test::random_pose(random))) {
    const Camera half = camera.scaled({320, 240});
    EXPECT_EQ(half.width(), 320);
    EXPECT_EQ(half.height(), 240);
    const auto a = camera.project(x), b = half.project(x);
    ASSERT_TRUE(a && b);
    // the corner (-0.5, -0.5) stays where it is
    EXPECT_NEAR((a->x() + 0.5) / 2, b->x() + 0.5, 1e-9) << camera.name();
    EXPECT_NEAR((a->y() + 0.5) / 2, b->y() + 0.5, 1e-9) << camera.name();
    const Camera again = half.scaled({640, 480});
    EXPECT_LT((*again.project(x) - *a).norm(), 1e-9);
  }
}

TEST(CameraTest, ItsIntrinsicNumbersMakeTheCameraAgain) {
  for (const Camera& camera : cameras_of_all_models(look_at({8, 1, 4}, {0, 0, 1}))) {
    test::expect_same_camera(camera, test::made_again(camera));
    const Camera scaled = camera.scaled({213, 360});
    test::expect_same_camera(scaled, test::made_again(scaled));
  }
}

TEST(CameraTest, ItsIntrinsicNumbersAreThoseItWasMadeOf) {
  PinholeIntrinsics in = test::intrinsics({-0.32, 0.11, 4e-3, -3e-3, -0.01});
  in.skew_px = 2.5;
  const auto pinhole =
      std::get<PinholeIntrinsics>(Camera::pinhole("p", {640, 480}, in, {}).intrinsics());
  EXPECT_EQ(pinhole.fx_px, in.fx_px);
  EXPECT_EQ(pinhole.fy_px, in.fy_px);
  EXPECT_EQ(pinhole.cx_px, in.cx_px);
  EXPECT_EQ(pinhole.cy_px, in.cy_px);
  EXPECT_EQ(pinhole.skew_px, in.skew_px);
  EXPECT_EQ(pinhole.distortion.k1, in.distortion.k1);
  EXPECT_EQ(pinhole.distortion.k2, in.distortion.k2);
  EXPECT_EQ(pinhole.distortion.p1, in.distortion.p1);
  EXPECT_EQ(pinhole.distortion.p2, in.distortion.p2);
  EXPECT_EQ(pinhole.distortion.k3, in.distortion.k3);
  for (const double kappa1 : {2e-2, 0.0, -1.2e-2}) {
    const TsaiIntrinsics given = test::tsai_intrinsics(kappa1);
    const Camera camera = Camera::tsai("t", {640, 480}, given, {});
    const auto tsai = std::get<TsaiIntrinsics>(camera.intrinsics());
    EXPECT_DOUBLE_EQ(tsai.focal_mm, given.focal_mm);
    EXPECT_DOUBLE_EQ(tsai.kappa1_per_mm2, given.kappa1_per_mm2);
    EXPECT_DOUBLE_EQ(tsai.dpx_mm, given.dpx_mm);
    EXPECT_DOUBLE_EQ(tsai.dpy_mm, given.dpy_mm);
    EXPECT_DOUBLE_EQ(tsai.sx, given.sx);
    EXPECT_DOUBLE_EQ(tsai.cx_px, given.cx_px);
    EXPECT_DOUBLE_EQ(tsai.cy_px, given.cy_px);
    // half the pixels in a row: each is twice as wide, and the lens is the same
    const auto halved = std::get<TsaiIntrinsics>(camera.scaled({320, 480}).intrinsics());
    EXPECT_DOUBLE_EQ(halved.dpx_mm, 2 * given.dpx_mm);
    EXPECT_DOUBLE_EQ(halved.dpy_mm, given.dpy_mm);
    EXPECT_DOUBLE_EQ(halved.kappa1_per_mm2, given.kappa1_per_mm2);
  }
}

TEST(CameraTest, FingerprintTellsProjectionsApartAndIgnoresTheName) {
  const CameraFromWorld pose = look_at({8, 1, 4}, {0, 0, 1});
  const auto all = cameras_of_all_models(pose);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(all[i].fingerprint(), all[j].fingerprint());
  }
  const Camera a = Camera::pinhole("a", {640, 480}, test::intrinsics(), pose);
  const Camera b = Camera::pinhole("b", {640, 480}, test::intrinsics(), pose);
  EXPECT_EQ(a.fingerprint(), b.fingerprint());
  PinholeIntrinsics moved = test::intrinsics();
  moved.cx_px = std::nextafter(moved.cx_px, 1000);
  EXPECT_NE(a.fingerprint(), Camera::pinhole("a", {640, 480}, moved, pose).fingerprint());
  EXPECT_NE(a.fingerprint(), a.scaled({640, 481}).fingerprint());
}

TEST(CameraTest, ContainsReachesHalfAPixelAroundTheOutermostCentres) {
  const Camera camera = Camera::pinhole("c", {640, 480}, test::intrinsics(), {});
  EXPECT_TRUE(camera.contains({0, 0}));
  EXPECT_TRUE(camera.contains({-0.5, -0.5}));
  EXPECT_TRUE(camera.contains({639.5, 479.5}));
  EXPECT_FALSE(camera.contains({-0.6, 0}));
  EXPECT_FALSE(camera.contains({0, 479.6}));
  EXPECT_FALSE(camera.contains({std::numeric_limits<double>::quiet_NaN(), 0}));
}

TEST(CameraTest, RefusesNumbersThatMakeNoCamera) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto pinhole = [](Eigen::Vector2i size, PinholeIntrinsics in, CameraFromWorld pose = {}) {
    return Camera::pinhole("c", size, in, pose);
  };
  EXPECT_THROW(pinhole({0, 480}, test::intrinsics()), std::invalid_argument);
  EXPECT_THROW(pinhole({640, -1}, test::intrinsics()), std::invalid_argument);
  EXPECT_THROW(pinhole({640, 480}, {0, 600, 320, 240, {}}), std::invalid_argument);
  EXPECT_THROW(pinhole({640, 480}, {600, -600, 320, 240, {}}), std::invalid_argument);
  EXPECT_THROW(pinhole({640, 480}, {600, 600, nan, 240, {}}), std::invalid_argument);
  EXPECT_THROW(pinhole({640, 480}, {600, 600, 320, 240, {nan, 0, 0, 0, 0}}), std::invalid_argument);
  CameraFromWorld pose;
  pose.translation.x() = nan;
  EXPECT_THROW(pinhole({640, 480}, test::intrinsics(), pose), std::invalid_argument);
  TsaiIntrinsics in = test::tsai_intrinsics(0);
  in.dpx_mm = 0;
  EXPECT_THROW(Camera::tsai("c", {640, 480}, in, {}), std::invalid_argument);
  const Camera fine = pinhole({640, 480}, test::intrinsics());
  EXPECT_THROW(fine.scaled({0, 10}), std::invalid_argument);
}

}  // namespace
}  // namespace plaza
