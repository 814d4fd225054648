#include "plugins/associators/gnn/reentry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plaza {
namespace {

using ::testing::ElementsAre;

Departure gone(TrackId id, double time_s, double x, std::int64_t last_frame = 10) {
  return {.id = id, .last_frame = last_frame, .time_s = time_s, .position_m = {x, 0}};
}
Arrival back(double time_s, double x, std::int64_t first_frame = 100) {
  return {.first_frame = first_frame, .time_s = time_s, .position_m = {x, 0}};
}

TEST(Reentry, RecognisesWithinReachAndMemoryOnly) {
  const auto recognised = [](double time_s, double x) {
    Reentry reentry(10, 1, 0.5);
    reentry.leave(gone(7, 0, 0));
    const Arrival arrival = back(time_s, x);
    return reentry.recognise({&arrival, 1}).at(0);
  };
  EXPECT_EQ(recognised(2, 1.9), 7);
  EXPECT_EQ(recognised(2, 2.1), 0);
  EXPECT_EQ(recognised(9.9, 5.9), 7);
  EXPECT_EQ(recognised(10.1, 0), 0);
}

TEST(Reentry, NobodyComesBackTwice) {
  Reentry reentry(10, 1, 0);
  reentry.leave(gone(7, 0, 0));
  const std::vector<Arrival> two = {back(1, 0.5), back(1, 0.1)};
  EXPECT_THAT(reentry.recognise(two), ElementsAre(0, 7));
  EXPECT_THAT(reentry.recognise(two), ElementsAre(0, 0));
}

TEST(Reentry, RecognisesAsManyAsPossible) {
  Reentry reentry(10, 1, 0);
  reentry.leave(gone(1, 0, 0));
  reentry.leave(gone(2, 0, 1.5));
  const std::vector<Arrival> two = {back(1, 0.9), back(1, -0.8)};
  EXPECT_THAT(reentry.recognise(two), ElementsAre(2, 1));
}

TEST(Reentry, NobodyIsInTwoPlacesAtOnce) {
  Reentry reentry(10, 1, 0);
  reentry.leave(gone(1, 0, 0, 20));
  const std::vector<Arrival> overlapping = {back(1, 0, 20)};
  EXPECT_THAT(reentry.recognise(overlapping), ElementsAre(0));
  const std::vector<Arrival> following = {back(1, 0, 21)};
  EXPECT_THAT(reentry.recognise(following), ElementsAre(1));
}

TEST(Reentry, ForgetsAfterItsMemory) {
  Reentry reentry(5, 1, 0);
  reentry.leave(gone(1, 0, 0));
  reentry.forget(4);
  const std::vector<Arrival> arrivals = {back(4, 0)};
  EXPECT_THAT(reentry.recognise(arrivals), ElementsAre(1));
  reentry.leave(gone(2, 0, 0));
  reentry.forget(6);
  EXPECT_THAT(reentry.recognise(arrivals), ElementsAre(0));
}

}  // namespace
}  // namespace plaza
