#include "plugins/detectors/ground/sight.h"

#include <gtest/gtest.h>

#include "tests/plugins/detectors/simulated_scene.h"

namespace plaza {
namespace {

using testing::looking_camera;
using testing::person_box;
using testing::round_scene;

TEST(VisibleShare, IsOneInPlainSightAndZeroBehindTheCamera) {
  const auto scene = round_scene(1);
  EXPECT_DOUBLE_EQ(visible_share(*scene, 0, {0, 0}, {}), 1.0);
  EXPECT_DOUBLE_EQ(visible_share(*scene, 0, {40, 15}, {}), 0.0);
}

TEST(VisibleShare, CountsOnlyWhatTheImageShows) {
  auto scene = round_scene(1);
  scene->cameras[0] = looking_camera("near", {0, -3, 3}, {0, 3, 1.5});
  const double share = visible_share(*scene, 0, {0, -0.8}, {});
  EXPECT_GT(share, 0.1);
  EXPECT_LT(share, 0.9);
}

TEST(VisibleShare, NearerPeopleHideFartherOnesOnly) {
  auto scene = round_scene(1);
  scene->cameras[0] = looking_camera("front", {0, -10, 1.6}, {0, 0, 1.0});
  const Eigen::Vector2d near(0, -2), far(0, 1);
  const auto screen = [&](const Eigen::Vector2d& p) {
    return Screen{.box = person_box(scene->cameras[0], p, 1.75),
                  .distance_m = ground_distance(scene->cameras[0], p)};
  };
  const Screen before = screen(near), behind = screen(far);
  EXPECT_LT(visible_share(*scene, 0, far, {&before, 1}), 0.2);
  EXPECT_DOUBLE_EQ(visible_share(*scene, 0, near, {&behind, 1}), 1.0);
  // one's own box hides nobody
  EXPECT_DOUBLE_EQ(visible_share(*scene, 0, far, {&behind, 1}), 1.0);
}

TEST(VisibleShare, StaticOccludersHideInTheirViewOnly) {
  auto scene = round_scene(2);
  const Box box = person_box(scene->cameras[0], {0, 0}, 1.75);
  StaticOccluder sign{.camera = "view1", .name = "sign", .polygon_px = {}};
  sign.polygon_px = {{box.left, box.top - 1},
                     {box.right(), box.top - 1},
                     {box.right(), box.top + 0.5 * box.height},
                     {box.left, box.top + 0.5 * box.height}};
  scene->occluders.push_back(sign);
  EXPECT_NEAR(visible_share(*scene, 0, {0, 0}, {}), 0.5, 0.11);
  EXPECT_DOUBLE_EQ(visible_share(*scene, 1, {0, 0}, {}), 1.0);
}

}  // namespace
}  // namespace plaza
