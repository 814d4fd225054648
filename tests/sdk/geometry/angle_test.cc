#include "plaza/geometry/angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace plaza {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(AngleTest, WrapsIntoTheHalfOpenTurn) {
  EXPECT_DOUBLE_EQ(wrap_angle(0), 0);
  EXPECT_DOUBLE_EQ(wrap_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi) << "-pi and pi are one direction and get one number";
  EXPECT_NEAR(wrap_angle(3 * kPi / 2), -kPi / 2, 1e-15);
  EXPECT_NEAR(wrap_angle(-7 * kPi + 0.1), -kPi + 0.1, 1e-14);
  EXPECT_NEAR(wrap_angle(1000 * kPi + 0.25), 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(wrap_angle(std::nan(""))));
}

TEST(AngleTest, DifferenceIsTheShortWayRound) {
  EXPECT_NEAR(angle_difference(-3, 3), 2 * kPi - 6, 1e-15);
  EXPECT_NEAR(angle_difference(3, -3), 6 - 2 * kPi, 1e-15);
  EXPECT_NEAR(angle_difference(0.5, 0.2), 0.3, 1e-15);
}

TEST(AngleTest, MeanIsTakenOnTheCircle) {
  EXPECT_NEAR(std::abs(circular_mean(std::vector{kPi - 0.1, -kPi + 0.1})), kPi, 1e-12);
  EXPECT_NEAR(circular_mean(std::vector{0.1, 0.3}), 0.2, 1e-12);
  EXPECT_NEAR(circular_mean(std::vector{1.0}), 1.0, 1e-15);
  EXPECT_NEAR(circular_mean(std::vector{0.0, 0.0, kPi / 2}), std::atan2(1, 2), 1e-15);
}

TEST(AngleTest, MeanOfCancellingDirectionsIsNotANumber) {
  EXPECT_TRUE(std::isnan(circular_mean({})));
  EXPECT_TRUE(std::isnan(circular_mean(std::vector{0.3, 0.3 + kPi})));
  EXPECT_TRUE(std::isnan(circular_mean(std::vector{0.0, 2 * kPi / 3, 4 * kPi / 3})));
}

TEST(AngleTest, DegreesAndRadiansAreInverse) {
  EXPECT_DOUBLE_EQ(degrees_from_radians(kPi), 180);
  EXPECT_DOUBLE_EQ(radians_from_degrees(-90), -kPi / 2);
  EXPECT_DOUBLE_EQ(radians_from_degrees(degrees_from_radians(1.234)), 1.234);
}

}  // namespace
}  // namespace plaza
