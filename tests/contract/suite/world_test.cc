#include "plaza/contract/world.h"

#include <gmock/gmock.h>

namespace plaza::contract {
namespace {

TEST(WorldTest, FollowsFromItsSeed) {
  const World a(1), b(1), c(2);
  ASSERT_EQ(a.observations(3).items.size(), b.observations(3).items.size());
  for (std::size_t i = 0; i < a.observations(3).items.size(); ++i) {
    EXPECT_EQ(a.observations(3).items[i].position_m, b.observations(3).items[i].position_m);
  }
  EXPECT_NE(a.observations(3).items[0].position_m, c.observations(3).items[0].position_m);
}

TEST(WorldTest, IsAwkwardOnPurpose) {
  const World world;
  int missing_views = 0, empty = 0, missed = 0, false_alarms = 0, tracklets = 0;
  for (std::int64_t frame = 0; frame < world.frame_count(); ++frame) {
    const auto& views = world.frames(frame).views;
    ASSERT_EQ(views.size(), world.scene()->cameras.size());
    for (const cv::Mat& view : views) missing_views += view.empty() ? 1 : 0;
    const std::size_t seen = world.observations(frame).items.size();
    const std::size_t there = world.ground_truth(frame).people.size();
    empty += seen == 0 ? 1 : 0;
    missed += seen < there ? 1 : 0;
    false_alarms += seen > there ? 1 : 0;
    const auto payload = world.payload(Tracklets::kPort, frame);
    tracklets += static_cast<int>(static_cast<const Tracklets&>(*payload).items.size());
  }
  EXPECT_GT(missing_views, 5);
  EXPECT_GE(empty, 2);
  EXPECT_GT(missed, 3);
  EXPECT_GT(false_alarms, 3);
  EXPECT_GT(tracklets, 10);
}

TEST(WorldTest, PeopleStandOnTheGroundInEveryView) {
  const World world;
  for (const TruePerson& person : world.ground_truth(10).people) {
    EXPECT_TRUE(world.scene()->area.contains(*person.position_m));
    EXPECT_EQ(person.views.size(), 3U);
    for (const Camera& camera : world.scene()->cameras) {
      const auto pixel = camera.project({person.position_m->x(), person.position_m->y(), 0});
      ASSERT_TRUE(pixel.has_value());
      EXPECT_TRUE(camera.contains(*pixel));
    }
  }
}

TEST(WorldTest, GivesOtherPayloadTypesWhenTold) {
  World world;
  EXPECT_EQ(world.payload("Smells", 0), nullptr);
  world.provide("Smells", {std::make_shared<Observations>()});
  EXPECT_NE(world.payload("Smells", 0), nullptr);
  EXPECT_EQ(world.payload("Smells", 1), nullptr);
}

}  // namespace
}  // namespace plaza::contract
