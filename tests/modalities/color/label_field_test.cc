// The random field: its update rule against the formula, that it settles, and what each prior does.
#include "modalities/color/label_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/modalities/color/pictures.h"

namespace plaza::color {
namespace {

using test::equal;

cv::Mat strengths(int width, int height, double value) {
  return cv::Mat(height, width, CV_16UC1, cv::Scalar(value * kStepsPerUnit));
}
void put(cv::Mat& strength, cv::Rect where, double value) {
  strength(where).setTo(cv::Scalar(value * kStepsPerUnit));
}
cv::Mat random_strengths(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  cv::Mat s(height, width, CV_16UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      s.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(random() % (10 * kStepsPerUnit));
    }
  }
  return s;
}
cv::Mat random_mask(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  cv::Mat m(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      m.at<uchar>(y, x) = static_cast<uchar>(random() % 3 == 0 ? 255 : 0);
    }
  }
  return m;
}

int ones_around(const cv::Mat& mask, int y, int x, bool centre) {
  int ones = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0 && !centre) continue;
      ones += mask.at<uchar>(std::clamp(y + dy, 0, mask.rows - 1),
                             std::clamp(x + dx, 0, mask.cols - 1)) != 0;
    }
  }
  return ones;
}

/// The formula of solve_labels(), in doubles; the options are multiples of a step.
cv::Mat reference(const cv::Mat& strength, const cv::Mat& previous, const LabelFieldOptions& o,
                  int rounds) {
  cv::Mat now(strength.size(), CV_8UC1, cv::Scalar(0));
  for (int round = 0; round <= rounds; ++round) {
    cv::Mat next(strength.size(), CV_8UC1);
    for (int y = 0; y < strength.rows; ++y) {
      for (int x = 0; x < strength.cols; ++x) {
        const double n = round == 0 ? 4 : ones_around(now, y, x, false);
        const double m = previous.empty() ? 4.5 : ones_around(previous, y, x, true);
        const double threshold = o.threshold + o.neighbourhood * (4 - n) + o.previous * (4.5 - m);
        const double s = static_cast<double>(strength.at<std::uint16_t>(y, x)) / kStepsPerUnit;
        next.at<uchar>(y, x) = static_cast<uchar>(s > std::max(threshold, 0.0) ? 255 : 0);
      }
    }
    now = next;
  }
  return now;
}

TEST(LabelFieldTest, FollowsItsFormula) {
  const LabelFieldOptions options{
      .threshold = 5, .neighbourhood = 0.75, .previous = 0.5, .iterations = 1};
  for (const cv::Size size : {cv::Size(50, 40), cv::Size(3, 5), cv::Size(1, 1)}) {
    const cv::Mat strength = random_strengths(size.width, size.height, 1);
    for (const cv::Mat& previous : {cv::Mat(), random_mask(size.width, size.height, 2)}) {
      for (int rounds = 1; rounds <= 4; ++rounds) {
        LabelFieldOptions o = options;
        o.iterations = rounds;
        EXPECT_TRUE(equal(solve_labels(strength, previous, o),
                          reference(strength, previous, options, rounds)))
            << size << ", rounds " << rounds << (previous.empty() ? "" : ", with previous");
      }
    }
  }
}

TEST(LabelFieldTest, SettlesAndStopsThere) {
  cv::Mat strength = strengths(60, 50, 1);
  put(strength, {20, 10, 15, 30}, 9);
  put(strength, {22, 20, 10, 2}, 4.6);  // a slit that closes from its ends
  LabelFieldOptions options{.threshold = 5, .neighbourhood = 1, .previous = 0.2, .iterations = 100};
  int rounds = 0;
  const cv::Mat settled = solve_labels(strength, {}, options, fastest_kernels(), &rounds);
  EXPECT_GT(rounds, 1);
  EXPECT_LT(rounds, 10);
  options.iterations = rounds;
  EXPECT_TRUE(equal(settled, solve_labels(strength, {}, options)));
}

TEST(LabelFieldTest, FillsHolesAndRemovesSpecks) {
  cv::Mat strength = strengths(40, 40, 1);
  put(strength, {10, 10, 12, 12}, 9);
  put(strength, {15, 15, 2, 2}, 4.5);  // a hole, below the threshold
  put(strength, {30, 30, 1, 1}, 6);    // a speck, above it
  const LabelFieldOptions none{.threshold = 5, .neighbourhood = 0, .previous = 0, .iterations = 10};
  LabelFieldOptions compact = none;
  compact.neighbourhood = 1;
  const cv::Mat plain = solve_labels(strength, {}, none);
  const cv::Mat field = solve_labels(strength, {}, compact);
  EXPECT_EQ(plain.at<uchar>(15, 15), 0);
  EXPECT_EQ(plain.at<uchar>(30, 30), 255);
  EXPECT_EQ(field.at<uchar>(15, 15), 255);
  EXPECT_EQ(field.at<uchar>(30, 30), 0);
}

TEST(LabelFieldTest, ThePreviousMaskTipsTheBalance) {
  const cv::Mat strength = strengths(30, 30, 5.25);
  cv::Mat previous(30, 30, CV_8UC1, cv::Scalar(0));
  previous(cv::Rect(5, 5, 10, 10)).setTo(cv::Scalar(255));
  const LabelFieldOptions without{
      .threshold = 5.5, .neighbourhood = 0, .previous = 0, .iterations = 3};
  LabelFieldOptions with = without;
  with.previous = 0.25;
  EXPECT_EQ(cv::countNonZero(solve_labels(strength, previous, without)), 0);
  const cv::Mat kept = solve_labels(strength, previous, with);
  EXPECT_EQ(kept.at<uchar>(9, 9), 255);
  EXPECT_EQ(kept.at<uchar>(25, 25), 0);
  EXPECT_EQ(cv::countNonZero(solve_labels(strength, {}, with)), 0);
}

TEST(LabelFieldTest, EachParameterHasItsEffect) {
  const cv::Mat strength = random_strengths(80, 60, 3);
  const cv::Mat previous = random_mask(80, 60, 4);
  const LabelFieldOptions base{
      .threshold = 5, .neighbourhood = 0.5, .previous = 0.25, .iterations = 2};
  const cv::Mat mask = solve_labels(strength, previous, base);
  LabelFieldOptions o = base;
  o.threshold = 6;
  EXPECT_LT(cv::countNonZero(solve_labels(strength, previous, o)), cv::countNonZero(mask));
  o = base;
  o.neighbourhood = 0.75;
  EXPECT_FALSE(equal(solve_labels(strength, previous, o), mask));
  o = base;
  o.previous = 0.5;
  EXPECT_FALSE(equal(solve_labels(strength, previous, o), mask));
  o = base;
  o.iterations = 3;
  EXPECT_FALSE(equal(solve_labels(strength, previous, o), mask));
}

}  // namespace
}  // namespace plaza::color
