#include "modalities/edges/edge_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plaza::edges {
namespace {

const cv::Size kShapeImage(320, 240);

/// 3 m above the ground, looking along +y and a little down.
Camera camera_above() {
  const double c = std::cos(0.25), s = std::sin(0.25);
  CameraFromWorld pose;
  pose.rotation << 1, 0, 0, 0, -s, -c, 0, c, -s;
  pose.translation = -pose.rotation * Eigen::Vector3d(0, 0, 3);
  return Camera::pinhole("one", {kShapeImage.width, kShapeImage.height},
                         {.fx_px = 300, .fy_px = 300, .cx_px = 160, .cy_px = 120, .distortion = {}},
                         pose);
}

class EdgeShapesTest : public ::testing::Test {
 protected:
  EdgeShapesTest()
      : camera_(camera_above()),
        scale_(camera_, {.min_m = {-5, 5}, .max_m = {5, 15}}, {.height_m = 1.8, .radius_m = 0.3}),
        grey_(kShapeImage, uchar{60}) {}

  cv::Point at(double x, double y, double z) const {
    const Eigen::Vector2d p = *camera_.project({x, y, z});
    return {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
  }
  /// A bright rectangle that stands at (x, y); its box with the edges around it.
  cv::Rect stand(double x, double y, double half_width, double low, double high) {
    const cv::Rect box(at(x - half_width, y, high), at(x + half_width, y, low));
    grey_(box).setTo(uchar{180});
    return {box.x - 2, box.y - 2, box.width + 4, box.height + 4};
  }
  /// Number of foreground edges in a box.
  struct Found {
    LabelImage labels{kShapeImage};
    std::vector<EdgePoint> points;
    int in(const cv::Rect& box) const {
      int count = 0;
      for (const EdgePoint p : points) count += box.contains({p.x, p.y}) ? 1 : 0;
      return count;
    }
  };
  Found found(double least_piece_m, double longest_line_m) const {
    EdgeImage image;
    find_edges(grey_, {}, image);
    Found r;
    segment(image, nullptr,
            {.least_piece_m = least_piece_m, .longest_line_m = longest_line_m, .link_px = 0},
            r.labels, r.points, &scale_);
    for (int y = 0; y < kShapeImage.height; ++y) {
      for (int x = 0; x < kShapeImage.width; ++x) {
        EXPECT_EQ(r.labels.at(x, y) & kVisited, 0);
      }
    }
    for (const EdgePoint p : r.points) EXPECT_NE(r.labels.at(p.x, p.y) & kForeground, 0);
    return r;
  }

  Camera camera_;
  BodyScale scale_;
  cv::Mat1b grey_;
};

TEST_F(EdgeShapesTest, ShortPiecesAreDroppedAtTheirPlace) {
  const cv::Rect person = stand(0, 8, 0.25, 0, 1.7), head = stand(2, 8, 0.12, 1.45, 1.75);
  const cv::Rect stone = stand(-2, 8, 0.06, 0, 0.12), near_stone = stand(-1, 5.5, 0.06, 0, 0.12);
  const Found all = found(0, 0), some = found(0.22, 0);
  for (const cv::Rect& box : {stone, near_stone}) {
    EXPECT_GT(all.in(box), 10);
    EXPECT_EQ(some.in(box), 0);
  }
  for (const cv::Rect& box : {person, head}) {
    EXPECT_GT(all.in(box), 20);
    EXPECT_EQ(some.in(box), all.in(box));
  }
  EXPECT_EQ(some.points.size(), static_cast<std::size_t>(some.in(person) + some.in(head)));
}

TEST_F(EdgeShapesTest, LongStraightLinesAreDroppedAndWhoCrossesThemStays) {
  // a shadow's border over the ground, slanted, and somebody before it
  const std::vector<cv::Point> shadow = {at(-5, 9, 0), at(5, 12, 0), at(5, 20, 0), at(-5, 20, 0)};
  cv::fillPoly(grey_, std::vector<std::vector<cv::Point>>{shadow}, cv::Scalar(20), cv::LINE_AA);
  const cv::Rect person = stand(0.5, 8, 0.25, 0, 1.7);
  const Found all = found(0, 0), some = found(0, 2.2);
  // along the border, left and right of the person
  const cv::Point begin = shadow[0], end = shadow[1];
  const auto along = [&](const Found& found) {
    const cv::Point2d line = end - begin;
    int count = 0;
    for (const EdgePoint p : found.points) {
      const cv::Point2d from_begin = cv::Point(p.x, p.y) - begin;
      count += std::abs(line.cross(from_begin)) < 3 * std::hypot(line.x, line.y) &&
                       !person.contains({p.x, p.y})
                   ? 1
                   : 0;
    }
    return count;
  };
  EXPECT_GT(along(all), 150);
  EXPECT_LT(along(some), along(all) / 5) << along(all);
  EXPECT_GE(some.in(person), all.in(person)*9 / 10);
  // what is as long as a leg or an arm stays
  EXPECT_EQ(found(0, 20).points.size(), all.points.size());
}

TEST_F(EdgeShapesTest, AShapeThatIsLongButNotSlimIsNoLine) {
  cv::ellipse(grey_, at(0, 8, 0.5), {100, 12}, 0, 0, 360, cv::Scalar(180), cv::FILLED);
  const Found all = found(0, 0), some = found(0, 2.2);
  EXPECT_GT(some.points.size(), all.points.size() / 2);
}

TEST_F(EdgeShapesTest, WithoutAScaleNothingIsJudged) {
  stand(-2, 8, 0.06, 0, 0.12);
  EdgeImage image;
  find_edges(grey_, {}, image);
  Found with, without;
  const SegmentationOptions asked{.least_piece_m = 5, .longest_line_m = 0.1, .link_px = 0};
  segment(image, nullptr, asked, with.labels, with.points, nullptr);
  segment(image, nullptr, {.link_px = 0}, without.labels, without.points, &scale_);
  EXPECT_GT(with.points.size(), 10U);
  EXPECT_EQ(with.points.size(), without.points.size());
}

}  // namespace
}  // namespace plaza::edges
