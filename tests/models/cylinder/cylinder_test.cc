#include "models/cylinder/cylinder.h"

#include <gtest/gtest.h>

#include <random>

#include "plaza/contract/gtest.h"
#include "tests/sdk/geometry/test_cameras.h"
#include "tests/support/solid_oracle.h"

namespace plaza {
namespace {

using test::compare;
using test::Disagreement;

Cylinder person() { return Cylinder({}, BuildContext{}); }

test::RayTest rays_of(const Pose& pose) {
  return [pose](const Ray& ray) {
    const double s = pose.scale;
    const auto part = [&](double radius, double bottom, double top) {
      return test::meets_cylinder(ray, pose.position_m, s * radius, s * bottom, s * top);
    };
    return part(0.18, 0, 0.85) || part(0.25, 0.85, 1.45) || part(0.12, 1.45, 1.75);
  };
}

/// A camera of every model, a quarter of the usual size, at the pose.
std::vector<Camera> cameras(const CameraFromWorld& pose) {
  std::vector<Camera> out;
  for (const Camera& camera : test::cameras_of_all_models(pose)) {
    out.push_back(camera.scaled({160, 120}));
  }
  return out;
}

void expect_agreement(const Camera& camera, const Pose& pose, const std::string& what) {
  SCOPED_TRACE(what + ", camera " + camera.name());
  const Silhouette s = person().silhouette(pose, camera);
  const Disagreement d = compare(s, camera, rays_of(pose));
  EXPECT_LE(d.farthest, 0.5) << d.pixels << " pixels differ";
  EXPECT_LE(d.pixels, 2 + d.points / 40) << "few pixel centres are so near to the edge";
  EXPECT_LE(d.off_edge, 0.5) << "of " << d.points << " contour points";
  EXPECT_EQ(d.wrong_normals, 0) << "of " << d.points << " contour points";
  EXPECT_EQ(test::edge_without_contour(s, test::render(camera, rays_of(pose))), 0);
}

TEST(Cylinder, AgreesWithRaysUnderSurveillanceCameras) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> ground(-4, 4), scale(0.8, 1.2);
  for (int i = 0; i < 6; ++i) {
    const Pose pose{{ground(random), ground(random)}, 0, scale(random)};
    for (const Camera& camera : cameras(test::random_pose(random))) {
      expect_agreement(camera, pose, "pose " + std::to_string(i));
    }
  }
}

TEST(Cylinder, AgreesWithRaysFromNearby) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-3.14, 3.14), distance(0.32, 1.6), eye(0.05, 2.6),
      aim(0.2, 1.6);
  for (int i = 0; i < 10; ++i) {
    const double a = angle(random), r = distance(random);
    const Eigen::Vector3d centre(r * std::cos(a), r * std::sin(a), eye(random));
    // past the person as well, so that parts of the body are behind the image plane
    const Eigen::Vector3d target(0.5 * std::sin(3 * a), 0.5 * std::cos(2 * a), aim(random));
    for (const Camera& camera : cameras(test::look_at(centre, target))) {
      expect_agreement(camera, {}, "pose " + std::to_string(i));
    }
  }
}

TEST(Cylinder, AgreesWithRaysFromAboveTheShoulders) {
  // inside the cylinder that boxes are drawn around, but outside the body
  for (const double angle : {0.3, 2.0, 4.0}) {
    const Eigen::Vector3d centre(0.22 * std::cos(angle), 0.22 * std::sin(angle), 1.6);
    for (const Eigen::Vector3d& target :
         {Eigen::Vector3d(0, 0.1, 1.6), Eigen::Vector3d(0.05, 0, 0), Eigen::Vector3d(3, 3, 1)}) {
      for (const Camera& camera : cameras(test::look_at(centre, target))) {
        expect_agreement(camera, {}, "angle " + std::to_string(angle));
      }
    }
  }
}

TEST(Cylinder, AgreesWithRaysFromStraightAbove) {
  CameraFromWorld down;  // x stays, y and z turn over
  down.rotation.diagonal() << 1, -1, -1;
  down.translation = {0.1, 0.2, 3.5};
  for (const Camera& camera : cameras(down)) expect_agreement(camera, {{0.1, 0.1}, 0, 1}, "above");
}

TEST(Cylinder, CannotBeSeenFromInsideOrBehind) {
  const auto seen_from = [](const Eigen::Vector3d& centre, const Eigen::Vector3d& target) {
    const Silhouette s = person().silhouette({}, cameras(test::look_at(centre, target))[0]);
    return !s.contour.empty() || !s.spans.empty();
  };
  EXPECT_FALSE(seen_from({0.1, 0.1, 1.2}, {5, 5, 1})) << "from inside the torso";
  EXPECT_FALSE(seen_from({3, 0, 1}, {6, 0, 1})) << "behind the camera";
  EXPECT_FALSE(seen_from({3, 0, 1}, {3, 5, 1})) << "to the side of the image";
  EXPECT_TRUE(seen_from({3, 0, 1}, {0, 0, 1}));
}

TEST(Cylinder, TheShareInsideIsThatOfTheArea) {
  const Camera camera = cameras(test::look_at({6, 0, 1.5}, {0, 0, 0.9}))[0];
  const Silhouette whole = person().silhouette({}, camera);
  EXPECT_DOUBLE_EQ(whole.inside_share, 1);
  EXPECT_GT(whole.box.left, 0);
  // the same person moved until the image's border runs through the axis
  const auto border = camera.to_plane({159.5, 100}, 0);
  ASSERT_TRUE(border);
  const Silhouette half = person().silhouette({*border, 0, 1}, camera);
  EXPECT_NEAR(half.inside_share, 0.5, 0.12);
  EXPECT_GT(half.box.right(), 159.5) << "the box is not cut";
}

TEST(Cylinder, TheStepThinsTheContourOnly) {
  const Camera camera = cameras(test::look_at({4, 0, 1.5}, {0, 0, 0.9}))[0];
  Cylinder::Options options;
  options.contour_step_px = 3;
  const Silhouette fine = person().silhouette({}, camera);
  const Silhouette thin = Cylinder(options, BuildContext{}).silhouette({}, camera);
  EXPECT_EQ(fine.spans, thin.spans);
  EXPECT_NEAR(static_cast<double>(fine.contour.size()),
              3.0 * static_cast<double>(thin.contour.size()), 6);
}

TEST(Cylinder, TheBodyIsAsTallAsItsParts) {
  EXPECT_DOUBLE_EQ(person().body().height_m, 1.75);
  EXPECT_DOUBLE_EQ(person().body().radius_m, 0.30);
}

TEST(Cylinder, KeepsTheContract) { contract::expect_kept(contract::subject_of<Cylinder>()); }

}  // namespace
}  // namespace plaza
