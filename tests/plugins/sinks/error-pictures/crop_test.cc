#include "plugins/sinks/error-pictures/crop.h"

#include <gtest/gtest.h>

namespace plaza::error_pictures {
namespace {

int pixels_of(const cv::Mat& image, const cv::Scalar& color) {
  cv::Mat mask;
  cv::inRange(image, color, color, mask);
  return cv::countNonZero(mask);
}

TEST(Crop, ShowsTheFocusInItsMiddle) {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(90));
  image(cv::Rect(300, 200, 41, 101)).setTo(cv::Scalar(0, 0, 200));
  const cv::Mat crop = crop_around(image, {300, 200, 40, 100}, {}, {}, {200, 250});
  ASSERT_EQ(crop.size(), cv::Size(200, 250));
  const double share = pixels_of(crop, {0, 0, 200}) / (200.0 * 250);
  EXPECT_NEAR(share, 40 * 100 / (190.0 * 152), 0.02) << "1.9 times as high as the focus";
  EXPECT_EQ(crop.at<cv::Vec3b>(125, 100), cv::Vec3b(0, 0, 200));
  EXPECT_EQ(crop.at<cv::Vec3b>(5, 5), cv::Vec3b(90, 90, 90));
}

TEST(Crop, DrawsBoxesAndPolygonsWhereTheyAre) {
  const cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(90));
  const std::vector<DrawnBox> boxes = {{{300, 200, 40, 100}, {drawing::Color(0, 255, 0), 2}}};
  const cv::Mat bare = crop_around(image, {300, 200, 40, 100}, {}, {}, {200, 250});
  const cv::Mat drawn = crop_around(image, {300, 200, 40, 100}, boxes, {}, {200, 250});
  EXPECT_EQ(pixels_of(bare, {0, 255, 0}), 0);
  EXPECT_GT(pixels_of(drawn, {0, 255, 0}), 300);
  const std::vector<std::vector<Eigen::Vector2d>> plate = {{{310, 210}, {330, 210}, {330, 250}}};
  const cv::Mat occluded = crop_around(image, {300, 200, 40, 100}, {}, plate, {200, 250});
  EXPECT_GT(cv::norm(occluded, bare, cv::NORM_L1), 1000);
}

TEST(Crop, ReachesBeyondTheImageAndDoesWithoutOne) {
  const cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(255));
  const cv::Mat corner = crop_around(image, {-30, -60, 40, 100}, {}, {}, {200, 250});
  EXPECT_GT(pixels_of(corner, cv::Scalar::all(255)), 1000);
  EXPECT_LT(pixels_of(corner, cv::Scalar::all(255)), 40000);
  EXPECT_EQ(pixels_of(crop_around({}, {300, 200, 40, 100}, {}, {}, {200, 250}), {0, 0, 0}), 0);
  EXPECT_EQ(crop_around(image, {10, 10, 0, 0}, {}, {}, {200, 250}).size(), cv::Size(200, 250));
}

TEST(Around, HoldsBoth) { EXPECT_EQ(around({0, 10, 5, 5}, {20, 0, 1, 2}), (Box{0, 0, 21, 15})); }

}  // namespace
}  // namespace plaza::error_pictures
