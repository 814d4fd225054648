#include "framework/results/track_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "plaza/core/error.h"

namespace plaza {
namespace {

TrackPoint point(TrackId id, std::int64_t frame, bool final = true, double x_m = 0) {
  TrackPoint p;
  p.id = id;
  p.frame = frame;
  p.final = final;
  p.position_m = {x_m, 0};
  return p;
}

Tracks tracks(std::vector<TrackPoint> points) {
  Tracks t;
  t.points = std::move(points);
  return t;
}

std::vector<TrackId> ids_at(const TrackStore& store, std::int64_t frame) {
  std::vector<TrackId> ids;
  for (const TrackPoint& p : store.at(frame)) ids.push_back(p.id);
  return ids;
}

TEST(TrackStoreTest, GivesFinalPointsByRisingId) {
  TrackStore store("tracks", 10);
  store.add(tracks({point(7, 11), point(2, 11), point(5, 11, false), point(9, 10)}));
  store.add(tracks({point(5, 11), point(1, 14)}));
  EXPECT_THAT(ids_at(store, 11), ::testing::ElementsAre(2, 5, 7));
  EXPECT_THAT(ids_at(store, 10), ::testing::ElementsAre(9));
  EXPECT_TRUE(store.at(12).empty());
  EXPECT_TRUE(store.at(3).empty());
  EXPECT_TRUE(store.at(100).empty());
}

TEST(TrackStoreTest, PointsThatStayOpenAreNotPartOfTheAnswer) {
  TrackStore store("tracks", 0);
  store.add(tracks({point(1, 0, false, 1), point(1, 0, false, 2)}));
  EXPECT_TRUE(store.at(0).empty());
  store.add(tracks({point(1, 0, true, 3)}));
  EXPECT_EQ(store.at(0).at(0).position_m.x(), 3);
}

void expect_refused(TrackStore& store, TrackPoint p, const std::string& why) {
  try {
    store.add(tracks({std::move(p)}));
    FAIL() << why;
  } catch (const InternalError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(why));
    EXPECT_EQ(error.context().component, "gnn");
  }
}

TEST(TrackStoreTest, RefusesWhatBreaksTheInvariants) {
  TrackStore store("gnn", 10);
  store.add(tracks({point(1, 10)}));
  expect_refused(store, point(1, 10), "id 1 became final twice");
  expect_refused(store, point(1, 9), "before the first one");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused(store, point(2, 10, true, nan), "not finite");
  TrackPoint heading = point(2, 10);
  heading.heading_rad = nan;
  expect_refused(store, heading, "not finite");
  TrackPoint box = point(2, 10);
  box.boxes.push_back({.camera = 0, .box = {0, 0, nan, 1}, .score = 0});
  expect_refused(store, box, "not finite");
}

}  // namespace
}  // namespace plaza
