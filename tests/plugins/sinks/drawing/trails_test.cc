#include "plugins/sinks/drawing/trails.h"

#include <gtest/gtest.h>

#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::drawing {
namespace {

using test::track_point;

TEST(Trails, KeepTheLastFramesOnly) {
  TrailMemory memory(3);
  for (int f = 0; f < 10; ++f) memory.add(f, std::vector{track_point(1, f, f, 0)});
  const Trail& trail = memory.trails().at(1);
  ASSERT_EQ(trail.size(), 4U);
  EXPECT_EQ(trail.front().frame, 6);
  EXPECT_EQ(trail.back().frame, 9);
  EXPECT_EQ(trail.back().position_m.x(), 9);
}

TEST(Trails, PeopleWhoLeftAreForgotten) {
  TrailMemory memory(2);
  memory.add(0, std::vector{track_point(1, 0, 0, 0), track_point(2, 0, 1, 0)});
  memory.add(1, std::vector{track_point(2, 1, 1, 0)});
  EXPECT_TRUE(memory.trails().contains(1));
  memory.add(3, {});
  EXPECT_FALSE(memory.trails().contains(1));
  EXPECT_TRUE(memory.trails().contains(2));
  memory.add(100, {});
  EXPECT_TRUE(memory.trails().empty());
}

TEST(Trails, PiecesEndAtGaps) {
  const Trail trail = {{0, {0, 0}}, {1, {1, 0}}, {3, {3, 0}}, {9, {9, 0}}, {10, {10, 0}}};
  EXPECT_EQ(unbroken_pieces(trail, 10).size(), 1U);
  const auto two = unbroken_pieces(trail, 2);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].size(), 3U);
  EXPECT_EQ(two[1].front().frame, 9);
  EXPECT_EQ(unbroken_pieces(trail, 1).size(), 3U);
  EXPECT_TRUE(unbroken_pieces({}, 1).empty());
}

}  // namespace
}  // namespace plaza::drawing
