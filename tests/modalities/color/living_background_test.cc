// What becomes background while people come and go, and what does not.
#include "modalities/color/living_background.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <stdexcept>
#include <vector>

#include "modalities/color/color.h"
#include "tests/modalities/color/pictures.h"

namespace plaza {
namespace {

using color::test::equal;
using color::test::seen;
using color::test::street;

constexpr int kWidth = 160, kHeight = 96;
constexpr double kFrameRate = 10;
const cv::Rect kThing(60, 30, 20, 40);

class LivingBackgroundTest : public ::testing::Test {
 protected:
  LivingBackgroundTest() : ground_(street(kWidth, kHeight)) {
    auto scene = std::make_shared<Scene>();
    scene->frame_rate_hz = kFrameRate;
    PinholeIntrinsics lens;
    lens.fx_px = lens.fy_px = 100;
    scene->cameras.push_back(Camera::pinhole("one", {kWidth, kHeight}, lens, {}));
    context_.scene = scene;
  }

  /// Share of a box that is foreground after each image, in the order in which they come.
  std::vector<double> watch(const std::vector<cv::Mat>& images, cv::Rect box) const {
    ColorModality modality(options_, context_);
    FrameSet empty;
    empty.views = {ground_};
    modality.learner()->learn(empty);
    modality.learner()->finish(1);
    Modality::Past past;
    std::vector<double> shares;
    for (const cv::Mat& image : images) {
      Modality::Prepared prepared = modality.prepare(image, 0, past);
      const Modality::Prepared again = modality.prepare(image, 0, past);
      EXPECT_TRUE(equal(prepared.foreground, again.foreground)) << "a function of image and past";
      EXPECT_EQ(prepared.memory != nullptr, lives());
      shares.push_back(prepared.foreground.empty()
                           ? 1.0
                           : cv::countNonZero(prepared.foreground(box)) / double(box.area()));
      past = {prepared.foreground, prepared.memory};
    }
    return shares;
  }
  bool lives() const { return options_.follow_light || options_.settle_s.has_value(); }

  cv::Mat with(const cv::Rect& box, const cv::Scalar& colour, double light = 1) const {
    cv::Mat image = ground_.clone();
    image(box).setTo(colour);
    return seen(image, light, 1.5, 7);
  }

  ColorModality::Options options_;
  BuildContext context_;
  cv::Mat ground_;
};

TEST_F(LivingBackgroundTest, DoublingLightDrownsEverythingUnlessItIsFollowed) {
  std::vector<cv::Mat> images;
  for (int i = 0; i < 50; ++i) images.push_back(with(kThing, {20, 25, 30}, 1 + 0.4 * i / 49));
  const cv::Rect elsewhere(0, 0, 40, kHeight);
  EXPECT_GT(watch(images, elsewhere).back(), 0.9);
  options_.follow_light = true;
  EXPECT_LT(watch(images, elsewhere).back(), 0.01);
  EXPECT_GT(watch(images, kThing).back(), 0.95) << "and who is there is still seen";
}

TEST_F(LivingBackgroundTest, WhatStaysIsBackgroundAfterItsTimeAndNotBefore) {
  const std::vector<cv::Mat> images(80, with(kThing, {40, 160, 60}));
  EXPECT_GT(watch(images, kThing).back(), 0.95) << "by default it never is";
  options_.settle_s = 5;  // 50 frames
  const std::vector<double> shares = watch(images, kThing);
  EXPECT_GT(shares[48], 0.95);
  EXPECT_LT(shares[54], 0.05);
}

TEST_F(LivingBackgroundTest, ThePlaceThatAThingLeavesBecomesBackgroundToo) {
  options_.settle_s = 3;
  std::vector<cv::Mat> images(45, with(kThing, {40, 160, 60}));
  for (int i = 0; i < 45; ++i) images.push_back(seen(ground_, 1, 1.5, 9));
  const std::vector<double> shares = watch(images, kThing);
  EXPECT_LT(shares[44], 0.05);
  EXPECT_GT(shares[46], 0.9) << "now the floor is what is new here";
  EXPECT_LT(shares[89], 0.05);
}

TEST_F(LivingBackgroundTest, WhoStandsForAMinuteIsNotTakenInByALongerTime) {
  options_.settle_s = 90;
  options_.follow_light = true;
  const std::vector<cv::Mat> images(static_cast<std::size_t>(60 * kFrameRate),
                                    with(kThing, {40, 160, 60}));
  EXPECT_GT(watch(images, kThing).back(), 0.95);
}

TEST_F(LivingBackgroundTest, WhoPassesBeforeAThingOnlyDelaysIt) {
  options_.settle_s = 4;
  std::vector<cv::Mat> images;
  for (int i = 0; i < 90; ++i) {
    images.push_back(with(kThing, {40, 160, 60}));
    if (i % 20 / 2 == 5) images.back()(kThing).setTo(cv::Scalar(200, 40, 30));
  }
  const std::vector<double> shares = watch(images, kThing);
  EXPECT_GT(shares[41], 0.9);
  EXPECT_LT(shares.back(), 0.05);
}

TEST_F(LivingBackgroundTest, WhoMovesIsNeverTakenIn) {
  options_.settle_s = 2;
  options_.follow_light = true;
  std::vector<cv::Mat> images;
  for (int i = 0; i < 60; ++i) images.push_back(with({20 + i, 30, 20, 40}, {40, 160, 60}));
  EXPECT_GT(watch(images, {79, 30, 20, 40}).back(), 0.95);
  EXPECT_LT(watch(images, {20, 30, 30, 40}).back(), 0.05);
}

TEST_F(LivingBackgroundTest, RefusesTheMemoryOfAnother) {
  struct Strange final : Modality::Memory {};
  options_.settle_s = 2;
  ColorModality modality(options_, context_);
  FrameSet empty;
  empty.views = {ground_};
  modality.learner()->learn(empty);
  modality.learner()->finish(1);
  EXPECT_THROW(modality.prepare(ground_, 0, {cv::Mat(), std::make_shared<Strange>()}),
               std::invalid_argument);
}

}  // namespace
}  // namespace plaza
