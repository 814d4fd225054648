#include "plaza/geometry/scene.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/sdk/geometry/test_cameras.h"

namespace plaza {
namespace {

TEST(SceneTest, FindsCamerasByName) {
  Scene scene;
  scene.cameras = test::cameras_of_all_models(test::look_at({8, 1, 4}, {0, 0, 1}));
  EXPECT_EQ(scene.camera_index("ideal"), 0u);
  EXPECT_EQ(scene.camera_index("tangential"), 3u);
  EXPECT_EQ(scene.camera_index("nobody"), std::nullopt);
}

TEST(SceneTest, TimesDoNotDriftWhenTheRateIsNoDivisorOfASecond) {
  Scene scene;
  scene.frame_rate_hz = 7;
  EXPECT_EQ(scene.time_of_frame(0), 0);
  EXPECT_EQ(scene.time_of_frame(1), 142'857'143);
  EXPECT_EQ(scene.time_of_frame(7), 1'000'000'000);
  EXPECT_EQ(scene.time_of_frame(7 * 86'400), 86'400 * std::int64_t{1'000'000'000});
}

TEST(GroundAreaTest, IncludesItsBorders) {
  const GroundArea area{{-1, 0}, {2, 3}};
  EXPECT_TRUE(area.contains({-1, 0}));
  EXPECT_TRUE(area.contains({2, 3}));
  EXPECT_TRUE(area.contains({0, 1}));
  EXPECT_FALSE(area.contains({2.001, 1}));
  EXPECT_FALSE(area.contains({0, -0.001}));
}

}  // namespace
}  // namespace plaza
