// The criterion against the paper's formulas, written down once more without any cleverness, and
// what it is there for: shadows, dark clothes, changing light.
#include "modalities/color/criterion.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "tests/modalities/color/pictures.h"

namespace plaza::color {
namespace {

using test::background_of;
using test::random_image;
using test::seen;
using test::street;

/// Strength of change of one pixel, as in Criterion's comment.
double reference(const cv::Mat& image, const Background& background, const CriterionOptions& o,
                 int y, int x) {
  Eigen::Matrix<double, 28, 2> stacked;
  double variance = 0;
  int i = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int v = std::clamp(y + dy, 0, image.rows - 1);
      const int u = std::clamp(x + dx, 0, image.cols - 1);
      for (int c = 0; c < 3; ++c, ++i) {
        stacked(i, 0) = image.at<cv::Vec3b>(v, u)[c];
        stacked(i, 1) = background.image.at<cv::Vec3b>(v, u)[c];
      }
      const double sigma = std::max<double>(background.noise.at<float>(v, u), o.least_noise_px);
      variance += sigma * sigma / 9;
    }
  }
  stacked(27, 0) = stacked(27, 1) = o.darkness;
  const Eigen::Matrix2d products = stacked.transpose() * stacked;
  const double smallest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(products).eigenvalues()[0];
  return std::max(0.0, 2 * smallest / (26 * variance));
}

double at(const cv::Mat& strength, int y, int x) {
  return static_cast<double>(strength.at<std::uint16_t>(y, x)) / kStepsPerUnit;
}

double mean(const cv::Mat& strength) { return cv::mean(strength)[0] / kStepsPerUnit; }

TEST(CriterionTest, IsTheSmallestEigenvalueInUnitsOfNoise) {
  for (const double darkness : {0.0, 60.0, 500.0}) {
    for (const cv::Size size : {cv::Size(40, 30), cv::Size(3, 5), cv::Size(1, 1), cv::Size(1, 9)}) {
      Background background = background_of(random_image(size.width, size.height, 1));
      std::mt19937 random(2);
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          background.noise.at<float>(y, x) = static_cast<float>(random() % 100) / 10.0F;
        }
      }
      const CriterionOptions options{.darkness = darkness, .least_noise_px = 3};
      const Criterion criterion(background, options);
      for (const cv::Mat& image :
           {random_image(size.width, size.height, 3), seen(background.image, 0.9, 4, 4)}) {
        const cv::Mat strength = criterion.strength(image);
        for (int y = 0; y < size.height; ++y) {
          for (int x = 0; x < size.width; ++x) {
            const double expected = reference(image, background, options, y, x);
            // half a step of rounding, and single precision
            EXPECT_NEAR(at(strength, y, x), std::min(expected, 65535.0 / kStepsPerUnit),
                        0.5 / kStepsPerUnit + 2e-5 * expected + 1e-3)
                << size << " darkness " << darkness << " at " << x << "," << y;
          }
        }
      }
    }
  }
}

TEST(CriterionTest, NoiseAloneGivesOneOnTheAverage) {
  const cv::Mat scene = street(120, 90);
  for (const double sigma : {3.0, 6.0}) {
    const Criterion criterion(background_of(scene, static_cast<float>(sigma)), {100, 0.1});
    EXPECT_NEAR(mean(criterion.strength(seen(scene, 1, sigma, 5))), 1, 0.08) << sigma;
  }
}

TEST(CriterionTest, EqualImagesGiveExactlyNothing) {
  const cv::Mat image = random_image(33, 21, 7);
  EXPECT_EQ(cv::countNonZero(Criterion(background_of(image), {100, 1}).strength(image)), 0);
}

TEST(CriterionTest, LightMayChangeButColourMayNot) {
  const cv::Mat scene = street(60, 40);
  const Criterion criterion(background_of(scene, 2), {100, 2});
  const double shadow = mean(criterion.strength(seen(scene, 0.85, 2, 1)));
  cv::Mat tinted = scene.clone();  // as dark as the shadow on the whole, of another colour
  for (int y = 0; y < scene.rows; ++y) {
    for (int x = 0; x < scene.cols; ++x) {
      auto& p = tinted.at<cv::Vec3b>(y, x);
      p = {static_cast<uchar>(p[0] * 0.70), p[1], static_cast<uchar>(p[2] * 0.86)};
    }
  }
  const double tint = mean(criterion.strength(seen(tinted, 1, 2, 2)));
  EXPECT_LT(shadow, 4);
  EXPECT_GT(tint, 10);
}

TEST(CriterionTest, OnlyDarknessCompensationTellsBlackClothesFromAnEvenGround) {
  const cv::Mat scene(40, 60, CV_8UC3, cv::Scalar(120, 125, 130));
  const cv::Mat clothes = seen(cv::Mat(40, 60, CV_8UC3, cv::Scalar(9, 9, 10)), 1, 1.5, 3);
  const Background background = background_of(scene, 2);
  EXPECT_LT(mean(Criterion(background, {0, 2}).strength(clothes)), 2);
  EXPECT_GT(mean(Criterion(background, {100, 2}).strength(clothes)), 50);
}

TEST(CriterionTest, DarknessTradesShadowsForDarkClothes) {
  const cv::Mat scene = street(60, 40);
  const cv::Mat shadow = seen(scene, 0.7, 2, 3);
  double last = 0;
  for (const double darkness : {0.0, 100.0, 300.0, 1000.0}) {
    const double now = mean(Criterion(background_of(scene, 2), {darkness, 2}).strength(shadow));
    EXPECT_GT(now, last) << darkness;
    last = now;
  }
}

TEST(CriterionTest, LeastNoiseStandsInWhereNoneWasSeen) {
  const cv::Mat scene = street(30, 30);
  const cv::Mat image = seen(scene, 1, 4, 9);
  const double sensitive = mean(Criterion(background_of(scene), {100, 2}).strength(image));
  const double tolerant = mean(Criterion(background_of(scene), {100, 4}).strength(image));
  EXPECT_NEAR(sensitive / tolerant, 4, 0.1);
}

TEST(CriterionTest, BlackAndWhiteImagesAreNumbers) {
  for (const int b : {0, 255}) {
    for (const int f : {0, 255}) {
      const cv::Mat background(8, 8, CV_8UC3, cv::Scalar::all(b));
      const cv::Mat image(8, 8, CV_8UC3, cv::Scalar::all(f));
      for (const double darkness : {0.0, 100.0}) {
        const cv::Mat strength =
            Criterion(background_of(background), {darkness, 1}).strength(image);
        EXPECT_EQ(at(strength, 4, 4) > 100, b != f && darkness > 0) << b << " " << f;
      }
    }
  }
}

}  // namespace
}  // namespace plaza::color
