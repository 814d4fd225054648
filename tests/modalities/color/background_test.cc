#include "modalities/color/background.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "plaza/core/error.h"
#include "tests/modalities/color/pictures.h"

namespace plaza::color {
namespace {

using test::equal;
using test::random_image;
using test::seen;
using test::street;

TEST(BackgroundTest, PeopleWhoPassLeaveNoTrace) {
  const cv::Mat scene = street(40, 30);
  BackgroundLearner learner(100);
  for (int i = 0; i < 25; ++i) {
    cv::Mat image = seen(scene, 1, 3, static_cast<std::uint32_t>(i));
    image(cv::Rect(i, 5, 12, 20)).setTo(cv::Scalar(0, 0, 255));  // never half of the time anywhere
    learner.add(image);
  }
  const Background background = learner.background();
  double worst = 0, noise = 0;
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(0.0 + background.image.at<cv::Vec3b>(y, x)[c] -
                                         scene.at<cv::Vec3b>(y, x)[c]));
      }
      if (y < 5) noise += background.noise.at<float>(y, x) / (40 * 5);
    }
  }
  EXPECT_LE(worst, 5 * 3);  // the person is 100 and more away from the street
  EXPECT_NEAR(noise, 3, 0.5);
}

TEST(BackgroundTest, OneFrameIsEnough) {
  const cv::Mat image = random_image(9, 7, 1);
  BackgroundLearner learner(10);
  learner.add(image);
  const Background background = learner.background();
  EXPECT_TRUE(equal(background.image, image));
  EXPECT_EQ(cv::countNonZero(background.noise), 0);
  EXPECT_TRUE(BackgroundLearner(10).background().empty());
}

TEST(BackgroundTest, ALongRecordingIsSampledEvenly) {
  BackgroundLearner learner(8);
  // brightness rises with time: the median tells the middle of what was kept
  for (int i = 0; i < 200; ++i) {
    learner.add(cv::Mat(2, 2, CV_8UC3, cv::Scalar::all(i)));
    EXPECT_LE(learner.samples(), 8U);
    EXPECT_GE(learner.samples(), std::min<std::size_t>(static_cast<std::size_t>(i) + 1, 4));
    const int median = learner.background().image.at<cv::Vec3b>(0, 0)[0];
    EXPECT_NEAR(median, i / 2.0, 1 + i / 6.0) << i;
  }
}

TEST(BackgroundTest, RefusesImagesOfDifferentSizes) {
  BackgroundLearner learner(8);
  learner.add(cv::Mat(2, 2, CV_8UC3, cv::Scalar::all(1)));
  EXPECT_THROW(learner.add(cv::Mat(2, 3, CV_8UC3, cv::Scalar::all(1))), UserError);
}

std::vector<Background> views() {
  Background one = test::background_of(random_image(5, 4, 1), 1.25F);
  one.noise.at<float>(2, 3) = 7.5F;
  return {one, {}, test::background_of(random_image(1, 1, 2))};
}

std::string stored() {
  std::ostringstream out;
  save_backgrounds(views(), out);
  return out.str();
}

TEST(BackgroundTest, IsStoredBitForBit) {
  std::istringstream in(stored());
  const std::vector<Background> loaded = load_backgrounds(in);
  ASSERT_EQ(loaded.size(), 3U);
  EXPECT_TRUE(loaded[1].empty());
  for (const std::size_t i : {0U, 2U}) {
    EXPECT_TRUE(equal(loaded[i].image, views()[i].image));
    EXPECT_TRUE(equal(loaded[i].noise, views()[i].noise));
  }
}

TEST(BackgroundTest, EveryTruncationAndEveryWrongByteIsRefused) {
  const std::string good = stored();
  for (std::size_t length = 0; length < good.size(); ++length) {
    std::istringstream in(good.substr(0, length));
    EXPECT_THROW(load_backgrounds(in), UserError) << length;
  }
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    std::istringstream in(bad);
    EXPECT_THROW(load_backgrounds(in), UserError) << i;
  }
  std::istringstream in(good + "x");
  EXPECT_THROW(load_backgrounds(in), UserError);
}

}  // namespace
}  // namespace plaza::color
