#include "models/box-parallelepiped/box_parallelepiped.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plaza/contract/gtest.h"
#include "tests/sdk/geometry/test_cameras.h"
#include "tests/support/solid_oracle.h"

namespace plaza {
namespace {

BoxParallelepiped car() { return BoxParallelepiped({}, BuildContext{}); }

test::RayTest rays_of(const Pose& pose) {
  return [pose](const Ray& ray) {
    return test::meets_box(ray, pose, pose.scale * Eigen::Vector3d(4.5, 1.8, 1.5));
  };
}

void expect_agreement(const Camera& camera, const Pose& pose, const std::string& what) {
  SCOPED_TRACE(what + ", camera " + camera.name());
  const Silhouette s = car().silhouette(pose, camera);
  const test::Disagreement d = test::compare(s, camera, rays_of(pose));
  EXPECT_LE(d.farthest, 0.5) << d.pixels << " pixels differ";
  EXPECT_LE(d.pixels, 2 + d.points / 40) << "few pixel centres are so near to the edge";
  EXPECT_LE(d.off_edge, 0.5) << "of " << d.points << " contour points";
  EXPECT_LE(d.wrong_normals, 6) << "beside a corner; of " << d.points << " contour points";
  EXPECT_EQ(test::edge_without_contour(s, test::render(camera, rays_of(pose))), 0);
}

TEST(BoxParallelepiped, AgreesWithRaysFarAndNear) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> ground(-4, 4), heading(-3, 3), scale(0.5, 1.2);
  std::uniform_real_distribution<double> eye(0.3, 3), aim(-1, 1);
  for (int i = 0; i < 8; ++i) {
    const Pose pose{{ground(random), ground(random)}, heading(random), scale(random)};
    CameraFromWorld view = test::random_pose(random);
    if (i % 2 == 1) {  // beside the car
      const double a = heading(random);
      view = test::look_at({pose.position_m.x() + 3.2 * std::cos(a),
                            pose.position_m.y() + 3.2 * std::sin(a), eye(random)},
                           {pose.position_m.x() + aim(random), pose.position_m.y(), 0.8});
    }
    for (const Camera& camera : test::cameras_of_all_models(view)) {
      expect_agreement(camera.scaled({160, 120}), pose, "pose " + std::to_string(i));
    }
  }
}

TEST(BoxParallelepiped, TurnsWithItsHeading) {
  const Camera camera = test::cameras_of_all_models(test::look_at({0, -15, 3}, {0, 0, 0.7}))[0];
  const Box side = car().silhouette({{0, 0}, 0, 1}, camera).box;
  const Box front = car().silhouette({{0, 0}, M_PI / 2, 1}, camera).box;
  EXPECT_GT(side.width, 1.8 * front.width);
  // half a turn gives the same box
  const Box back = car().silhouette({{0, 0}, 3 * M_PI / 2, 1}, camera).box;
  EXPECT_NEAR(front.left, back.left, 1e-9);
}

TEST(BoxParallelepiped, TheBodyHasTheAreaOfTheBase) {
  const Body body = car().body();
  EXPECT_DOUBLE_EQ(body.height_m, 1.5);
  EXPECT_NEAR(M_PI * body.radius_m * body.radius_m, 4.5 * 1.8, 1e-12);
}

TEST(BoxParallelepiped, KeepsTheContract) {
  contract::expect_kept(contract::subject_of<BoxParallelepiped>());
}

}  // namespace
}  // namespace plaza
