#include "modalities/edges/scan_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace plaza::edges {
namespace {

TEST(ScanLines, TwelveDirectionsAreFifteenDegreesApart) {
  const auto directions = make_directions(12, 9);
  ASSERT_EQ(directions.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_NEAR(directions[i].angle_rad, i * std::numbers::pi / 12, 1e-12);
    EXPECT_EQ(directions[i].steep, i >= 4 && i <= 8) << i;
  }
  EXPECT_EQ(directions[0].slope, 0);
  EXPECT_NEAR(directions[3].slope, 1, 1e-12);
  EXPECT_NEAR(directions[9].slope, -1, 1e-12);
  EXPECT_NEAR(directions[5].slope, std::tan(std::numbers::pi / 12), 1e-12);
}

TEST(ScanLines, TheGateHoldsTheStepsThatAreNearEnough) {
  for (const Direction& d : make_directions(12, 9)) {
    EXPECT_LE(d.gate * d.step_px, 9 + 1e-6);
    EXPECT_GT((d.gate + 1) * d.step_px, 9);
  }
  EXPECT_EQ(make_directions(12, 9)[0].gate, 9);
  EXPECT_EQ(make_directions(12, 9)[3].gate, 6);
}

TEST(ScanLines, FollowTheirAngle) {
  for (const Direction& d : make_directions(17, 5)) {
    const double reach = d.shift(1000);
    const double angle = d.steep ? std::atan2(1000.0, reach) : std::atan2(reach, 1000.0);
    double off = std::abs(angle - d.angle_rad);
    off = std::min(off, std::abs(off - std::numbers::pi));
    EXPECT_LT(off, 1e-3) << d.angle_rad;
    for (int i = 1; i < 1000; ++i) EXPECT_LE(std::abs(d.shift(i) - d.shift(i - 1)), 1);
  }
}

TEST(ScanLines, NearestDirectionKnowsNoSign) {
  for (const int count : {1, 4, 7, 12, 36}) {
    for (int i = 0; i < count; ++i) {
      for (const double off : {-0.49, 0.0, 0.49}) {
        const double angle = std::numbers::pi * (i + off) / count;
        const Eigen::Vector2f n(static_cast<float>(std::cos(angle)),
                                static_cast<float>(std::sin(angle)));
        EXPECT_EQ(nearest_direction(n, count), i) << count << ' ' << off;
        EXPECT_EQ(nearest_direction(-n, count), i) << count << ' ' << off;
      }
    }
  }
}

TEST(ScanLines, RefusesWhatCannotBeCounted) {
  EXPECT_THROW(make_directions(0, 9), std::invalid_argument);
  EXPECT_THROW(make_directions(12, -1), std::invalid_argument);
  EXPECT_THROW(make_directions(12, 255), std::invalid_argument);
  EXPECT_THROW(make_directions(12, std::nan("")), std::invalid_argument);
  EXPECT_EQ(make_directions(12, 254)[0].gate, 254);
}

}  // namespace
}  // namespace plaza::edges
