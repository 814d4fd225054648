#include "modalities/edges/segmentation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace plaza::edges {
namespace {

const cv::Size kLabelSize(40, 30);

/// Edges at the given pixels, all with one gradient.
EdgeImage image_of(const std::vector<cv::Point>& pixels, cv::Vec2s gradient = {100, 0}) {
  EdgeImage image;
  image.edges = cv::Mat1b(kLabelSize, uchar{0});
  image.dx = cv::Mat1s(kLabelSize, gradient[0]);
  image.dy = cv::Mat1s(kLabelSize, gradient[1]);
  image.grey = cv::Mat1b(kLabelSize, uchar{0});
  for (const cv::Point& p : pixels) image.edges(p) = 255;
  return image;
}

ViewBackground background_of(const std::vector<cv::Point>& pixels, cv::Vec2f gradient = {1, 0}) {
  cv::Mat1b edges(kLabelSize, uchar{0});
  for (const cv::Point& p : pixels) edges(p) = 255;
  return make_background(edges, cv::Mat2f(kLabelSize, gradient), 2);
}

std::vector<cv::Point> column(int x, int top, int bottom) {
  std::vector<cv::Point> pixels;
  for (int y = top; y < bottom; ++y) pixels.emplace_back(x, y);
  return pixels;
}

struct Segmented {
  LabelImage labels{kLabelSize};
  std::vector<EdgePoint> points;
};

Segmented run(const EdgeImage& image, const ViewBackground* background,
              const SegmentationOptions& options) {
  Segmented s;
  segment(image, background, options, s.labels, s.points);
  return s;
}

const SegmentationOptions kUnlinked{.orientation_threshold = 0.9, .link_px = 0};

TEST(Segment, WithoutABackgroundEverythingStays) {
  const Segmented s = run(image_of(column(10, 5, 25)), nullptr, kUnlinked);
  EXPECT_EQ(s.points.size(), 20u);
  EXPECT_EQ(s.labels.at(10, 5), kEdge | kSegmented | kForeground);
  EXPECT_EQ(s.labels.at(11, 5), 0);
}

TEST(Segment, RemovesWhatLiesNearTheBackgroundAndRunsItsWay) {
  const ViewBackground background = background_of(column(10, 0, 30));
  for (const int x : {8, 10, 12}) {
    EXPECT_TRUE(run(image_of(column(x, 5, 25)), &background, kUnlinked).points.empty()) << x;
  }
  for (const int x : {7, 13}) {
    EXPECT_EQ(run(image_of(column(x, 5, 25)), &background, kUnlinked).points.size(), 20u) << x;
  }
}

TEST(Segment, KeepsWhatCrossesTheBackground) {
  const ViewBackground background = background_of(column(10, 0, 30));
  const auto left = [&](double degrees) {
    const double a = degrees * CV_PI / 180;
    const cv::Vec2s gradient(static_cast<short>(std::lround(1000 * std::cos(a))),
                             static_cast<short>(std::lround(1000 * std::sin(a))));
    return run(image_of(column(10, 5, 25), gradient), &background, kUnlinked).points.size();
  };
  EXPECT_EQ(left(0), 0u);
  EXPECT_EQ(left(25), 0u) << "cos 25 degrees = 0.906 > 0.9";
  EXPECT_EQ(left(27), 20u) << "cos 27 degrees = 0.891 < 0.9";
  EXPECT_EQ(left(-90), 20u);
  EXPECT_EQ(left(180), 20u) << "from bright to dark instead of dark to bright: another edge";
}

TEST(Segment, DropsSpecks) {
  std::vector<cv::Point> pixels = {{3, 3}, {4, 4}, {5, 5}, {4, 6}};  // one piece over its corners
  pixels.push_back({20, 20});
  pixels.push_back({22, 20});  // two pieces of one pixel
  SegmentationOptions options = kUnlinked;
  const auto left = [&](int least) {
    options.min_contour_px = least;
    return run(image_of(pixels), nullptr, options).points.size();
  };
  EXPECT_EQ(left(1), 6u);
  EXPECT_EQ(left(2), 4u);
  EXPECT_EQ(left(4), 4u);
  EXPECT_EQ(left(5), 0u);
  options.min_contour_px = 2;
  const Segmented s = run(image_of(pixels), nullptr, options);
  EXPECT_EQ(s.labels.at(20, 20), kEdge | kSegmented) << "the subtraction left it";
  EXPECT_EQ(s.labels.at(4, 4), kEdge | kSegmented | kForeground);
}

/// A contour down column 20 with a gap of `gap` pixels, where the background hides it.
Segmented with_gap(int gap, const SegmentationOptions& options) {
  const ViewBackground background = background_of(column(20, 12, 12 + gap));
  // the zone reaches two pixels beyond the background's edge
  return run(image_of(column(20, 2, 28)), &background, options);
}

TEST(Link, ClosesAGapFromBothEnds) {
  const Segmented before = with_gap(3, kUnlinked);
  EXPECT_EQ(before.points.size(), 26u - 7u);
  const Segmented after = with_gap(3, {.orientation_threshold = 0.9, .link_px = 4});
  EXPECT_EQ(after.points.size(), 26u);
  EXPECT_EQ(after.labels.at(20, 13), kEdge | kForeground) << "linked, not segmented";
  EXPECT_EQ(after.labels.at(20, 3), kEdge | kSegmented | kForeground);
}

TEST(Link, GrowsNoFurtherThanItMay) {
  const Segmented after = with_gap(9, {.orientation_threshold = 0.9, .link_px = 2});
  EXPECT_EQ(after.points.size(), 26u - 13u + 4u) << "two pixels from each side";
}

TEST(Link, EndsWhenFewEndPointsMove) {
  SegmentationOptions options{
      .orientation_threshold = 0.9, .min_contour_px = 1, .link_px = 20, .link_end_points = 3};
  EXPECT_EQ(with_gap(9, options).points.size(), 26u - 13u + 2u) << "two ends move, once";
  options.link_end_points = 2;
  EXPECT_EQ(with_gap(9, options).points.size(), 26u);
}

TEST(Link, AddsOnlyEdgesOfTheImage) {
  EdgeImage image = image_of(column(20, 2, 12));
  for (const cv::Point& p : column(20, 15, 28)) image.edges(p) = 255;  // a true gap
  const Segmented s = run(image, nullptr, {.orientation_threshold = 0.9, .link_px = 10});
  EXPECT_EQ(s.points.size(), 23u);
  EXPECT_EQ(s.labels.at(20, 13), 0);
}

TEST(Link, WorksAtTheImagesBorder) {
  const ViewBackground background = background_of(column(0, 10, 20));
  const Segmented s =
      run(image_of(column(0, 0, 30)), &background, {.orientation_threshold = 0.9, .link_px = 50});
  EXPECT_EQ(s.points.size(), 30u);
}

TEST(LabelImage, HasABorderThatNobodyLabels) {
  const Segmented s = run(image_of({{0, 0}, {39, 29}}), nullptr, kUnlinked);
  EXPECT_EQ(s.labels.at(-1, -1), 0);
  EXPECT_EQ(s.labels.at(40, 30), 0);
  EXPECT_EQ(s.labels.size(), kLabelSize);
}

}  // namespace
}  // namespace plaza::edges
