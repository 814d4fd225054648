#include "plaza/geometry/box.h"

#include <gtest/gtest.h>

namespace plaza {
namespace {

TEST(BoxTest, OverlapIsWithoutThePlusOneOfPixelCounting) {
  const Box a{0, 0, 10, 10};
  EXPECT_DOUBLE_EQ(intersection_over_union(a, a), 1);
  EXPECT_DOUBLE_EQ(intersection_over_union(a, {5, 0, 10, 10}), 50.0 / 150);
  EXPECT_DOUBLE_EQ(intersection_over_union(a, {0, 0, 10, 20}), 0.5);
  EXPECT_DOUBLE_EQ(intersection_over_union({5, 0, 10, 10}, a), 50.0 / 150) << "symmetric";
}

TEST(BoxTest, ApartOrTouchingIsZero) {
  const Box a{0, 0, 10, 10};
  EXPECT_EQ(intersection_over_union(a, {10, 0, 10, 10}), 0);
  EXPECT_EQ(intersection_over_union(a, {20, 20, 1, 1}), 0);
  EXPECT_EQ(intersection_over_union(a, {-5, -5, 4, 40}), 0);
}

TEST(BoxTest, WithoutAreaIsZeroNotNotANumber) {
  const Box empty{3, 3, 0, 0};
  EXPECT_EQ(intersection_over_union(empty, empty), 0);
  EXPECT_EQ(intersection_over_union(empty, {0, 0, 10, 10}), 0);
}

TEST(BoxTest, NamesItsBorders) {
  const Box a{2, 3, 10, 20};
  EXPECT_EQ(a.right(), 12);
  EXPECT_EQ(a.bottom(), 23);
  EXPECT_EQ(a.area(), 200);
}

}  // namespace
}  // namespace plaza
