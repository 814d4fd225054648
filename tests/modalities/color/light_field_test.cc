// Light that changes, all over the view or in parts of it.
#include "modalities/color/light_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/modalities/color/pictures.h"

namespace plaza::color {
namespace {

using test::equal;
using test::seen;
using test::street;

constexpr int kWidth = 203, kHeight = 97;  // neither a multiple of a cell

double difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

/// `scene` times a factor on each column of pixels.
template <class Factor>
cv::Mat lit(const cv::Mat& scene, const Factor& factor) {
  cv::Mat image = scene.clone();
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        auto& value = image.at<cv::Vec3b>(y, x)[c];
        value = cv::saturate_cast<uchar>(value * factor(x));
      }
    }
  }
  return image;
}

LightField follow(const cv::Mat& image, const cv::Mat& background, int frames, LightOptions options,
                  const cv::Mat& mask = {}) {
  LightField light;
  for (int i = 0; i < frames; ++i) {
    light.all = light_of_all(image, background, mask, light.all);
    light.here = light_of_cells(image, background, mask, light, 0.04, options);
  }
  return light;
}

TEST(LightField, WithoutChangeTheImageIsItself) {
  const cv::Mat scene = street(kWidth, kHeight);
  const LightField light = follow(scene, scene, 3, {});
  EXPECT_TRUE(equal(relight(scene, scene, light), scene));
  const LightField none;
  EXPECT_TRUE(equal(relight(scene, scene, none), scene));
}

TEST(LightField, HalvedOrDoubledLightOfTheWholeViewIsFollowedAtOnce) {
  const cv::Mat scene = street(kWidth, kHeight);
  for (const double linear : {0.5, 2.0}) {
    const double factor = std::pow(linear, 1 / 2.2);
    const cv::Mat image = seen(scene, factor, 0, 1);
    const LightField light = follow(image, scene, 1, {});
    for (const float log : light.all) EXPECT_NEAR(log, std::log(factor), 0.01);
    EXPECT_LE(difference(relight(image, scene, light), scene), 2) << linear;
  }
}

TEST(LightField, ColourOfTheLightIsFollowedByChannel) {
  const cv::Mat scene = street(kWidth, kHeight);
  cv::Mat image = scene.clone();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) image.at<cv::Vec3b>(y, x)[0] /= 2;
  }
  const LightField light = follow(image, scene, 1, {.rate_per_s = 0});
  EXPECT_NEAR(light.all[0], std::log(0.5), 0.01);
  EXPECT_NEAR(light.all[2], 0, 0.01);
  EXPECT_TRUE(light.here.empty());
  EXPECT_LE(difference(relight(image, scene, light), scene), 2);
}

TEST(LightField, AShadowOnAPartIsFollowedAtItsRateAndNotFaster) {
  const cv::Mat scene = street(kWidth, kHeight);
  const auto shadow = [](int x) { return x < 60 ? 0.75 : 1.0; };
  const cv::Mat image = lit(scene, shadow);
  const double depth = -std::log(0.75);  // 0.29, so 0.58 s at the default rate
  const LightField early = follow(image, scene, 5, {});
  EXPECT_NEAR(early.here(2, 1)[1], -0.5 * 5 * 0.04, 1e-5);
  const LightField late = follow(image, scene, 40, {});
  EXPECT_NEAR(late.here(2, 1)[1], -depth, 0.02);
  EXPECT_NEAR(late.here(2, 9)[1], 0, 0.02);
  const cv::Mat corrected = relight(image, scene, late);
  EXPECT_LE(difference(corrected.colRange(0, 40), scene.colRange(0, 40)), 4);
  EXPECT_LE(difference(corrected.colRange(80, kWidth), scene.colRange(80, kWidth)), 3);
  const LightField never = follow(image, scene, 40, {.rate_per_s = 0});
  EXPECT_GT(difference(relight(image, scene, never), scene), 20);
}

TEST(LightField, ForegroundIsNotTakenForLight) {
  const cv::Mat scene = street(kWidth, kHeight);
  cv::Mat image = scene.clone();
  const cv::Rect person(64, 0, 48, kHeight);
  image(person).setTo(cv::Scalar(30, 30, 30));
  cv::Mat mask(image.size(), CV_8UC1, cv::Scalar(0));
  mask(person).setTo(255);
  const LightField aware = follow(image, scene, 50, {}, mask);
  EXPECT_NEAR(aware.here(2, 5)[0], 0, 0.02);
  EXPECT_LE(difference(relight(image, scene, aware)(person), image(person)), 2);
  const LightField unaware = follow(image, scene, 50, {});
  EXPECT_LT(unaware.here(2, 5)[0], -0.5) << "the mask has an effect";
}

TEST(LightField, WhatForegroundHidesTakesOnTheLightAroundIt) {
  const cv::Mat scene = street(kWidth, kHeight);
  const cv::Mat image = lit(scene, [](int x) { return x < 120 ? 0.75 : 1.0; });
  cv::Mat mask(image.size(), CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(32, 0, 32, kHeight)).setTo(255);  // amid the shadow
  const LightField light = follow(image, scene, 200, {}, mask);
  EXPECT_NEAR(light.all[1] + light.here(2, 2)[1], std::log(0.75), 0.03);
}

TEST(LightField, AClippedPixelSaysOnlyThatItIsNotDarker) {
  const cv::Mat scene(kHeight, kWidth, CV_8UC3, cv::Scalar(240, 240, 240));
  cv::Mat image(scene.size(), CV_8UC3, cv::Scalar(255, 255, 255));
  LightField light;
  light.all = {0.3F, 0.3F, 0.3F};  // 240 would be 324
  EXPECT_TRUE(equal(relight(image, scene, light), scene));
  const cv::Mat dark(kHeight, kWidth, CV_8UC3, cv::Scalar(90, 90, 90));
  EXPECT_GT(relight(image, dark, light).at<cv::Vec3b>(5, 5)[0], 180) << "brighter than it may be";
}

TEST(LightField, NothingToCompareLeavesTheLightAsItWas) {
  const cv::Mat scene = street(kWidth, kHeight);
  LightField before;
  before.all = {0.1F, 0.2F, 0.3F};
  const cv::Mat white(scene.size(), CV_8UC3, cv::Scalar::all(255));
  EXPECT_EQ(light_of_all(white, scene, {}, before.all), before.all);
}

}  // namespace
}  // namespace plaza::color
