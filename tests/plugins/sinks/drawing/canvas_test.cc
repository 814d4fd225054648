#include "plugins/sinks/drawing/canvas.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "plaza/core/error.h"
#include "plugins/sinks/drawing/picture_file.h"
#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::drawing {
namespace {

cv::Mat black() { return cv::Mat(100, 100, CV_8UC3, cv::Scalar(0, 0, 0)); }

int painted(const cv::Mat& image) {
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return cv::countNonZero(grey);
}

cv::Vec3b at(const cv::Mat& image, int x, int y) { return image.at<cv::Vec3b>(y, x); }

const Color kRed(0, 0, 255);

TEST(Canvas, LineGoesThroughPixelCentres) {
  cv::Mat image = black();
  draw_path(image, Path{{10, 50}, {90, 50}}, false, {kRed, 1});
  EXPECT_GT(at(image, 50, 50)[2], 200);  // antialiasing spreads a little
  EXPECT_EQ(at(image, 50, 53), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(at(image, 95, 50), cv::Vec3b(0, 0, 0));
}

TEST(Canvas, LinesFromFarOutsideAreWhereTheyBelong) {
  cv::Mat image = black();
  // ends beyond OpenCV's fixed point: 2^31 / 16 pixels
  draw_path(image, Path{{-1e12, -1e12}, {1e12, 1e12}}, false, {kRed, 1});
  EXPECT_GT(at(image, 20, 20)[2], 200);
  EXPECT_GT(at(image, 80, 80)[2], 200);
  EXPECT_EQ(at(image, 80, 20), cv::Vec3b(0, 0, 0));
}

TEST(Canvas, WhatIsOutsideOrNotANumberPaintsNothing) {
  cv::Mat image = black();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  draw_path(image, Path{{500, 500}, {900, 500}}, false, {kRed, 3});
  draw_path(image, Path{{nan, 5}, {50, 50}}, false, {kRed, 3});
  draw_path(image, Path{{50, 50}}, true, {kRed, 3});
  draw_path(image, Path{{1e300, 0}, {1e300, 10}}, false, {kRed, 1, 4});
  draw_disk(image, {1e9, -1e9}, 5, kRed);
  draw_ring(image, {nan, nan}, 5, {kRed, 1});
  fill_convex(image, Path{{1e9, 0}, {2e9, 0}, {1e9, 5}}, kRed);
  EXPECT_EQ(painted(image), 0);
}

TEST(Canvas, DashesLeaveGapsAndRunOnAroundCorners) {
  cv::Mat dashed = black(), solid = black();
  draw_box(dashed, {10, 10, 80, 80}, {kRed, 1, 5});
  draw_box(solid, {10, 10, 80, 80}, {kRed, 1});
  EXPECT_LT(painted(dashed), 0.9 * painted(solid));
  EXPECT_GT(painted(dashed), 0.4 * painted(solid));
  EXPECT_GT(at(dashed, 12, 10)[2], 200);  // a dash begins at the corner
  EXPECT_LT(at(dashed, 17, 10)[2], 60);
}

TEST(Canvas, BoxesHaveCrispSides) {
  cv::Mat image = black();
  draw_box(image, {10.4, 20.3, 60.2, 50.4}, {kRed, 1});  // 70.6, 70.7
  EXPECT_GT(at(image, 10, 40)[2], 200);
  EXPECT_GT(at(image, 71, 40)[2], 200);
  EXPECT_GT(at(image, 40, 20)[2], 200);
  EXPECT_GT(at(image, 40, 71)[2], 200);
  EXPECT_EQ(at(image, 40, 40), cv::Vec3b(0, 0, 0));
}

TEST(Canvas, SeamIsDarkAndInsideIsTheColour) {
  cv::Mat white(100, 100, CV_8UC3, cv::Scalar(255, 255, 255));
  draw_seamed_path(white, Path{{10, 50}, {90, 50}}, false, {kRed, 2});
  EXPECT_EQ(at(white, 50, 50), cv::Vec3b(0, 0, 255));
  int darkest = 255;
  for (int y = 45; y < 56; ++y) darkest = std::min<int>(darkest, at(white, 50, y)[2]);
  EXPECT_LT(darkest, 120);
}

TEST(Canvas, PlateIsMovedIntoTheImage) {
  cv::Mat image = black();
  draw_plate(image, "12", {50, -30}, {10, kRed, Anchor::kBottomCentre});
  EXPECT_GT(painted(image), 100);
  EXPECT_EQ(at(image, 50, 1), cv::Vec3b(0, 0, 255));
}

TEST(Canvas, TextIsAsHighAsAsked) {
  cv::Mat image = black();
  draw_text(image, "HI", {20, 30}, {20, {255, 255, 255}});
  const cv::Rect ink = cv::boundingRect([&] {
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    return grey;
  }());
  EXPECT_NEAR(ink.y + ink.height / 2, 40, 2);
  EXPECT_NEAR(ink.height, 20, 6);  // the pen's width and antialiasing on both sides
}

TEST(Canvas, AnchorsPutTheTextAroundThePoint) {
  const auto ink = [](Anchor anchor) {
    cv::Mat image = black();
    draw_text(image, "HHH", {50, 50}, {10, {255, 255, 255}, anchor});
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    return cv::boundingRect(grey);
  };
  EXPECT_GE(ink(Anchor::kTopLeft).x, 49);
  EXPECT_LE(ink(Anchor::kTopRight).br().x, 52);
  EXPECT_LE(ink(Anchor::kBottomCentre).br().y, 53);
  EXPECT_LT(ink(Anchor::kCentre).x, 50);
  EXPECT_GT(ink(Anchor::kCentre).br().x, 50);
}

TEST(PictureFile, WritesWhatCanBeReadBack) {
  const test::TemporaryFolder folder;
  cv::Mat image = black();
  image.at<cv::Vec3b>(3, 4) = {1, 2, 3};
  write_png(folder.path() / "a.png", image);
  const cv::Mat back = cv::imread((folder.path() / "a.png").string());
  EXPECT_EQ(cv::norm(image, back, cv::NORM_INF), 0);
}

TEST(PictureFile, NamesTheFileThatCannotBeWritten) {
  try {
    write_png("/nowhere/at/all/a.png", black());
    FAIL();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all/a.png"), std::string::npos);
  }
}

TEST(PictureFile, OutputNamesArePlain) {
  EXPECT_EQ(fault_of_file_name("overlay.mp4"), "");
  EXPECT_NE(fault_of_file_name(""), "");
  EXPECT_NE(fault_of_file_name(".."), "");
  EXPECT_NE(fault_of_file_name("a/b.mp4").find("--out"), std::string::npos);
}

}  // namespace
}  // namespace plaza::drawing
