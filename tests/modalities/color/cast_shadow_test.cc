#include "modalities/color/cast_shadow.h"

#include <gtest/gtest.h>

#include "tests/modalities/color/pictures.h"

namespace plaza::color {
namespace {

const cv::Scalar kPavement(200, 190, 180);
const cv::Scalar kInShadow(140, 116, 100);  ///< .70, .61, .56 of it: under a blue sky
const cv::Scalar kShoe(60, 30, 90);

class CastShadowTest : public ::testing::Test {
 protected:
  CastShadowTest()
      : scale_(test::camera_above(), {.min_m = {-5, 5}, .max_m = {5, 15}},
               {.height_m = 1.8, .radius_m = 0.3}),
        mask_(240, 320, CV_8UC1, cv::Scalar(0)),
        background_(240, 320, CV_8UC3, kPavement),
        image_(background_.clone()) {}

  void paint(const cv::Rect& box, const cv::Scalar& colour) {
    image_(box).setTo(colour);
    mask_(box).setTo(cv::Scalar(255));
  }
  cv::Mat judged(double most_m) const {
    return without_shadows(mask_, image_, background_, scale_, most_m);
  }
  int left_in(const cv::Rect& box, double most_m = 0.5) const {
    return cv::countNonZero(judged(most_m)(box));
  }
  /// Pixels as high as `length_m` for who stands at this row.
  int pixels(double length_m, int row) const {
    return static_cast<int>(length_m * scale_.px_per_m(150, row));
  }

  BodyScale scale_;
  cv::Mat mask_, background_, image_;
};

TEST_F(CastShadowTest, IsDroppedUpToTheShoe) {
  const cv::Rect leg(150, 140, 6, 40), shoe(150, 180, 6, 6), shadow(135, 186, 30, 8);
  paint(leg, kInShadow);  // trousers may look as the shadow does
  paint(shoe, kShoe);
  paint(shadow, kInShadow);
  EXPECT_EQ(left_in(leg), leg.area());
  // the 3 x 3 mean mixes one row of shoe and shadow, both of which may be either
  EXPECT_GE(left_in(shoe), shoe.area() - shoe.width);
  EXPECT_LE(left_in(shadow), shoe.width);
}

TEST_F(CastShadowTest, ReachesNoHigherThanItMay) {
  const cv::Rect shadow(150, 100, 10, 80);
  paint(shadow, kInShadow);
  for (const double most_m : {0.1, 0.3, 0.6}) {
    EXPECT_EQ(left_in(shadow, most_m), 10 * (80 - pixels(most_m, 179))) << most_m;
  }
}

TEST_F(CastShadowTest, WhatNoShadowCanBeStays) {
  const cv::Rect box(150, 150, 12, 20);
  const cv::Scalar others[] = {
      {210, 200, 190},  // brighter
      {50, 47, 45},     // darker than the sky alone leaves it
      {110, 130, 150},  // redder
      {160, 110, 100},  // far bluer
      {100, 140, 100},  // greener
  };
  for (const cv::Scalar& colour : others) {
    paint(box, colour);
    // its outermost pixels are mixed with the ground, which may look like half a shadow
    const cv::Rect inside(151, 151, 10, 18);
    EXPECT_EQ(left_in(inside, 0.05), inside.area()) << colour;
  }
  paint(box, kInShadow);
  EXPECT_LT(left_in(box), box.area());
}

TEST_F(CastShadowTest, TheBordersAndWhatNobodyReachesStay) {
  const cv::Rect cut(150, 200, 10, 40), sky(150, 2, 10, 20);
  ASSERT_EQ(scale_.px_per_m(150, 10), 0);
  paint(cut, kInShadow);
  paint(sky, kInShadow);
  EXPECT_EQ(left_in(cut), cut.area());
  EXPECT_EQ(left_in(sky), sky.area());
}

TEST_F(CastShadowTest, InputsAreNotWrittenTo) {
  paint({150, 150, 10, 20}, kInShadow);
  const cv::Mat mask = mask_.clone(), image = image_.clone(), background = background_.clone();
  EXPECT_FALSE(test::equal(judged(0.5), mask));
  EXPECT_TRUE(test::equal(mask_, mask));
  EXPECT_TRUE(test::equal(image_, image));
  EXPECT_TRUE(test::equal(background_, background));
}

}  // namespace
}  // namespace plaza::color
