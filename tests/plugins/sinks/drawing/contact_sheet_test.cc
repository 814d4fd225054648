#include "plugins/sinks/drawing/contact_sheet.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace plaza::drawing {
namespace {

Tile tile(cv::Size size, const cv::Scalar& color, std::string name = "name") {
  return {cv::Mat(size, CV_8UC3, color), name, "of " + name};
}

int pixels_of(const cv::Mat& sheet, const cv::Scalar& color) {
  cv::Mat mask;
  cv::inRange(sheet, color, color, mask);
  return cv::countNonZero(mask);
}

TEST(ContactSheet, ShowsEveryTileAtTheSameWidth) {
  const cv::Scalar red(0, 0, 200), blue(200, 0, 0), green(0, 200, 0);
  const cv::Mat sheet = contact_sheet(
      "title", {{"one", {tile({400, 300}, red), tile({400, 300}, blue), tile({400, 300}, green)}}},
      640, 2);
  EXPECT_EQ(sheet.cols, 640);
  // two columns: (640 - 3 gaps of 12) / 2
  EXPECT_EQ(pixels_of(sheet, red), 302 * 227);
  EXPECT_EQ(pixels_of(sheet, blue), 302 * 227);
  EXPECT_EQ(pixels_of(sheet, green), 302 * 227) << "in a second row";
}

TEST(ContactSheet, MixesShapesAndSections) {
  const cv::Scalar red(0, 0, 200), blue(200, 0, 0);
  const cv::Mat sheet = contact_sheet(
      "title", {{"a", {tile({100, 300}, red), tile({300, 100}, blue)}}, {"b", {}}}, 640, 4);
  EXPECT_EQ(pixels_of(sheet, red), 200 * 600) << "enlarged to no more than twice its size";
  EXPECT_EQ(pixels_of(sheet, blue), 302 * 101);
}

TEST(ContactSheet, LongAndMissingTextsDoNoHarm) {
  const std::string endless(500, 'W');
  EXPECT_FALSE(contact_sheet(endless, {{endless, {tile({8, 8}, {}, endless)}}}, 320, 20).empty());
  EXPECT_FALSE(contact_sheet("", {}, 320, 1).empty());
  EXPECT_FALSE(contact_sheet("", {{"", {tile({1, 1}, {}, "")}}}, 320, 1).empty());
}

}  // namespace
}  // namespace plaza::drawing
