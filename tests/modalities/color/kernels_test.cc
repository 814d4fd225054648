// Every instruction set gives the bytes of the scalar one.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "modalities/color/criterion.h"
#include "modalities/color/label_field.h"
#include "modalities/color/row_kernels.h"
#include "tests/modalities/color/pictures.h"

namespace plaza::color {
namespace {

using test::background_of;
using test::equal;
using test::random_image;
using test::seen;

TEST(RowKernelsTest, TheScalarOneIsAlwaysThere) {
  EXPECT_STREQ(available_kernels().front()->name, "scalar");
  EXPECT_EQ(&fastest_kernels(), available_kernels().back());
}

TEST(RowKernelsTest, AllGiveTheSameBytesForEveryWidth) {
  if (available_kernels().size() == 1) GTEST_SKIP() << "this CPU has no vector instructions";
  for (int width = 1; width <= 70; ++width) {
    const int height = 1 + width % 5;
    const auto seed = static_cast<std::uint32_t>(width);
    const cv::Mat background = random_image(width, height, seed);
    const Criterion criterion(background_of(background, 2), {80, 2});
    const cv::Mat previous = [&] {
      cv::Mat mask(height, width, CV_8UC1);
      std::mt19937 random(seed);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          mask.at<uchar>(y, x) = static_cast<uchar>(random() % 2 == 0 ? 0 : 255);
        }
      }
      return mask;
    }();
    const LabelFieldOptions field{
        .threshold = 30, .neighbourhood = 6, .previous = 2.3, .iterations = 5};
    for (const cv::Mat& image : {random_image(width, height, seed + 100),
                                 seen(background, 0.8, 10, seed), background.clone()}) {
      const cv::Mat strength = criterion.strength(image, kScalarKernels);
      const cv::Mat mask = solve_labels(strength, previous, field, kScalarKernels);
      for (const RowKernels* kernels : available_kernels()) {
        EXPECT_TRUE(equal(criterion.strength(image, *kernels), strength))
            << kernels->name << ", width " << width;
        EXPECT_TRUE(equal(solve_labels(strength, previous, field, *kernels), mask))
            << kernels->name << ", width " << width;
      }
    }
  }
}

TEST(RowKernelsTest, AllGiveTheSameBytesOnALargeImage) {
  const cv::Mat background = random_image(752, 480, 1);
  const Criterion criterion(background_of(background, 3), {100, 2});
  const cv::Mat image = seen(background, 0.95, 6, 2);
  const cv::Mat strength = criterion.strength(image, kScalarKernels);
  for (const RowKernels* kernels : available_kernels()) {
    EXPECT_TRUE(equal(criterion.strength(image, *kernels), strength)) << kernels->name;
  }
}

TEST(RowKernelsTest, ThresholdsStopAtZeroAndStrengthsAtTheirLargest) {
  const std::vector<std::uint8_t> ones(40, 1);
  const std::array<const std::uint8_t*, 3> rows = {ones.data() + 1, ones.data() + 1,
                                                   ones.data() + 1};
  const std::vector<std::uint16_t> strengths(38, 65535);
  const std::vector<std::uint16_t> thresholds(38, 65535);
  for (const RowKernels* kernels : available_kernels()) {
    std::vector<std::uint16_t> out(38, 1);
    kernels->threshold(rows.data(), 65535, 65535, out.data(), 38);
    EXPECT_EQ(out, std::vector<std::uint16_t>(38, 0)) << kernels->name;
    kernels->threshold(rows.data(), 65535, 100, out.data(), 38);
    EXPECT_EQ(out, std::vector<std::uint16_t>(38, 64635)) << kernels->name;
    std::vector<std::uint8_t> labels(38, 7);
    kernels->label(strengths.data(), thresholds.data(), rows.data(), 0, labels.data(), 38);
    EXPECT_EQ(labels, std::vector<std::uint8_t>(38, 0)) << kernels->name;
    kernels->label(strengths.data(), thresholds.data(), rows.data(), 1, labels.data(), 38);
    EXPECT_EQ(labels, std::vector<std::uint8_t>(38, 1)) << kernels->name;
  }
}

}  // namespace
}  // namespace plaza::color
