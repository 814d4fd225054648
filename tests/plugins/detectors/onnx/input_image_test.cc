#include "plugins/detectors/onnx/input_image.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace plaza {
namespace {

InputFormat format_of(cv::Size size, ImageFit fit = ImageFit::kLetterbox) {
  return {.size = size, .fit = fit, .values = PixelValues(1.0 / 255, {0, 0, 0}, {1, 1, 1})};
}

float value(const cv::Mat& input, int channel, int row, int column) {
  return input.ptr<float>(0, channel, row)[column];
}

TEST(ImagePlace, LetterboxKeepsProportionsInTheMiddle) {
  EXPECT_EQ(ImagePlace({640, 480}, {320, 320}, ImageFit::kLetterbox).placed(),
            cv::Rect(0, 40, 320, 240));
  EXPECT_EQ(ImagePlace({480, 640}, {320, 320}, ImageFit::kLetterbox).placed(),
            cv::Rect(40, 0, 240, 320));
  EXPECT_EQ(ImagePlace({768, 576}, {640, 640}, ImageFit::kLetterbox).placed(),
            cv::Rect(0, 80, 640, 480));
  EXPECT_EQ(ImagePlace({768, 576}, {640, 640}, ImageFit::kStretch).placed(),
            cv::Rect(0, 0, 640, 640));
}

TEST(ImagePlace, MapsTheWholeImageToItselfWhateverWasRounded) {
  for (const ImageFit fit : {ImageFit::kLetterbox, ImageFit::kStretch}) {
    for (const cv::Size image : {cv::Size(641, 479), {7, 5}, {1, 90}, {752, 480}, {33, 1000}}) {
      const ImagePlace place(image, {320, 256}, fit);
      const cv::Rect at = place.placed();
      const Box box = place.in_image(at.x, at.y, at.x + at.width, at.y + at.height);
      EXPECT_DOUBLE_EQ(box.left, -0.5) << image;
      EXPECT_DOUBLE_EQ(box.top, -0.5) << image;
      EXPECT_NEAR(box.width, image.width, 1e-9) << image;
      EXPECT_NEAR(box.height, image.height, 1e-9) << image;
      EXPECT_TRUE((at & cv::Rect(0, 0, 320, 256)) == at && !at.empty()) << image;
    }
  }
}

TEST(ImagePlace, MapsABoxByHand) {
  // 640 x 480 at half the size, 40 px of padding above
  const ImagePlace place({640, 480}, {320, 320}, ImageFit::kLetterbox);
  const Box box = place.in_image(100, 140, 110, 170);
  EXPECT_DOUBLE_EQ(box.left, 199.5);
  EXPECT_DOUBLE_EQ(box.top, 199.5);
  EXPECT_DOUBLE_EQ(box.width, 20);
  EXPECT_DOUBLE_EQ(box.height, 60);
}

TEST(NetworkInput, HoldsTheImageWhereImagePlaceSaysItIs) {
  cv::Mat image(48, 64, CV_8UC3, cv::Scalar(0, 0, 0));
  image(cv::Rect(20, 10, 8, 16)).setTo(cv::Scalar(255, 255, 255));
  const cv::Mat input = network_input(image, format_of({32, 32}));
  const ImagePlace place(image.size(), {32, 32}, ImageFit::kLetterbox);
  double left = 32, top = 32, right = 0, bottom = 0;
  const cv::Rect at = place.placed();
  for (int row = at.y; row < at.y + at.height; ++row) {
    for (int column = at.x; column < at.x + at.width; ++column) {
      if (value(input, 0, row, column) < 0.9F) continue;
      left = std::min<double>(left, column);
      top = std::min<double>(top, row);
      right = std::max<double>(right, column + 1);
      bottom = std::max<double>(bottom, row + 1);
    }
  }
  const Box box = place.in_image(left, top, right, bottom);
  EXPECT_DOUBLE_EQ(box.left, 19.5);  // the edge of the first white column
  EXPECT_DOUBLE_EQ(box.top, 9.5);
  EXPECT_DOUBLE_EQ(box.width, 8);
  EXPECT_DOUBLE_EQ(box.height, 16);
}

TEST(NetworkInput, PadsALetterboxAndNothingElse) {
  const cv::Mat image(10, 20, CV_8UC3, cv::Scalar(255, 255, 255));
  InputFormat format = format_of({20, 20});
  format.padding = 51;
  const cv::Mat input = network_input(image, format);
  ASSERT_EQ(input.dims, 4);
  EXPECT_EQ(input.size[1], 3);
  for (int channel = 0; channel < 3; ++channel) {
    for (int row = 0; row < 20; ++row) {
      const float expected = row >= 5 && row < 15 ? 1.0F : 0.2F;
      for (int column = 0; column < 20; ++column) {
        ASSERT_FLOAT_EQ(value(input, channel, row, column), expected) << row << ", " << column;
      }
    }
  }
  const cv::Mat stretched = network_input(image, format_of({20, 20}, ImageFit::kStretch));
  EXPECT_FLOAT_EQ(value(stretched, 0, 0, 0), 1.0F);
  EXPECT_FLOAT_EQ(value(stretched, 2, 19, 19), 1.0F);
}

TEST(NetworkInput, OrdersScalesAndCentresChannels) {
  const cv::Mat image(4, 4, CV_8UC3, cv::Scalar(10, 20, 30));  // blue, green, red
  InputFormat format = format_of({4, 4});
  format.values = PixelValues(0.5, {1, 2, 3}, {1, 2, 4});
  const cv::Mat rgb = network_input(image, format);
  EXPECT_FLOAT_EQ(value(rgb, 0, 3, 3), 14.5F);   // (30 - 1) / 2 / 1
  EXPECT_FLOAT_EQ(value(rgb, 1, 3, 3), 4.5F);    // (20 - 2) / 2 / 2
  EXPECT_FLOAT_EQ(value(rgb, 2, 3, 3), 0.875F);  // (10 - 3) / 2 / 4
  format.rgb = false;
  const cv::Mat bgr = network_input(image, format);
  EXPECT_FLOAT_EQ(value(bgr, 0, 0, 0), 4.5F);    // (10 - 1) / 2 / 1
  EXPECT_FLOAT_EQ(value(bgr, 2, 0, 0), 3.375F);  // (30 - 3) / 2 / 4
}

}  // namespace
}  // namespace plaza
