#include "plugins/sources/synthetic/world/crowd.h"

#include <gtest/gtest.h>

#include "plugins/sources/synthetic/world/routes.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;

Stage empty_stage() {
  Stage stage = outdoor_stage({{-10, -10}, {10, 10}});
  return stage;
}

Walker walker(const Vector2d& from, const Vector2d& to) {
  Walker w;
  w.present = true;
  w.position = from;
  w.way = {to};
  const Vector2d along = to - from;
  w.heading = std::atan2(along.y(), along.x());
  return w;
}

/// Moves a crowd for some seconds; returns the least distance between any two.
double least_distance(Crowd& crowd, double seconds) {
  double least = 1e9;
  for (double t = 0; t < seconds; t += Crowd::kTickS) {
    crowd.tick();
    for (std::size_t i = 0; i < crowd.walkers.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        least = std::min(least, (crowd.walkers[i].position - crowd.walkers[j].position).norm());
      }
    }
  }
  return least;
}

TEST(Crowd, OneAloneGoesStraightAndStops) {
  const Stage stage = empty_stage();
  Crowd crowd(stage);
  crowd.walkers = {walker({0, 0}, {4, 0})};
  double aside = 0;
  for (int k = 0; k < 400; ++k) {
    crowd.tick();
    aside = std::max(aside, std::abs(crowd.walkers[0].position.y()));
  }
  EXPECT_LT(aside, 0.02);
  EXPECT_NEAR(crowd.walkers[0].position.x(), 4, 0.1);
  EXPECT_LT(crowd.walkers[0].velocity.norm(), 0.05);
}

TEST(Crowd, TwoHeadOnPassEachOtherOnTheRight) {
  const Stage stage = empty_stage();
  Crowd crowd(stage);
  crowd.walkers = {walker({-3, 0}, {3, 0}), walker({3, 0}, {-3, 0})};
  double aside = 0;
  double least = 1e9;
  for (int k = 0; k < 450; ++k) {
    crowd.tick();
    least = std::min(least, (crowd.walkers[0].position - crowd.walkers[1].position).norm());
    if (std::abs(crowd.walkers[0].position.x() - crowd.walkers[1].position.x()) < 0.1) {
      aside = crowd.walkers[0].position.y();
    }
  }
  EXPECT_GT(least, Crowd::kBodyDistance - 0.02);
  EXPECT_LT(aside, -0.1) << "who goes towards +x has its right at -y";
  EXPECT_LT((crowd.walkers[0].position - Vector2d(3, 0)).norm(), 0.3);
  EXPECT_LT((crowd.walkers[1].position - Vector2d(-3, 0)).norm(), 0.3);
}

TEST(Crowd, EightThroughOnePointDoNotOverlap) {
  const Stage stage = empty_stage();
  Crowd crowd(stage);
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.785398 * k + 0.02 * (k % 3);
    const Vector2d from = 3 * Vector2d(std::cos(angle), std::sin(angle));
    crowd.walkers.push_back(walker(from, -from));
  }
  EXPECT_GT(least_distance(crowd, 12), Crowd::kBodyDistance - 0.06);
}

TEST(Crowd, WalksAroundSomeoneWhoStands) {
  const Stage stage = empty_stage();
  Crowd crowd(stage);
  crowd.walkers = {walker({-3, 0}, {3, 0.02}), walker({0, 0}, {0, 0})};
  crowd.walkers[1].settled = true;
  EXPECT_GT(least_distance(crowd, 8), Crowd::kBodyDistance - 0.02);
  EXPECT_LT(crowd.walkers[1].position.norm(), 0.15) << "who stands is not pushed away";
  EXPECT_GT(crowd.walkers[0].position.x(), 2.5);
}

TEST(Routes, GoAroundFurnitureTheShorterWay) {
  Furniture table;
  table.footprint = {{-0.5, -2}, {0.5, 0.5}};
  const Routes routes({table}, {{-5, -5}, {5, 5}});
  EXPECT_EQ(routes.find({-3, 2}, {3, 2}).size(), 1U);
  const auto way = routes.find({-3, 0}, {3, 0});
  ASSERT_EQ(way.size(), 3U);
  EXPECT_GT(way[0].y(), 0.75);
  EXPECT_GT(way[1].y(), 0.75);
  EXPECT_FALSE(routes.is_free({0, 0}));
  EXPECT_TRUE(routes.is_free({0, 1}));
}

}  // namespace
}  // namespace plaza::synthetic
