// Counting by look-ups against counting pixel by pixel.
#include "modalities/color/occupancy.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <random>

#include "modalities/color/explained_patch.h"

namespace plaza::color {
namespace {

const cv::Size kImage(50, 40);

cv::Mat random_mask(std::uint32_t seed, int percent) {
  std::mt19937 random(seed);
  cv::Mat mask(kImage, CV_8UC1);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      mask.at<uchar>(y, x) =
          static_cast<uchar>(static_cast<int>(random() % 100) < percent ? 255 : 0);
    }
  }
  return mask;
}

cv::Mat painted(const std::vector<RowSpan>& spans) {
  cv::Mat mask(kImage, CV_8UC1, cv::Scalar(0));
  for (const RowSpan& s : spans) {
    for (int x = s.begin; x < s.end; ++x) mask.at<uchar>(s.row, x) = 255;
  }
  return mask;
}

/// A blob of one or two spans per row, possibly cut by the image's border.
Silhouette random_silhouette(std::mt19937& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  Silhouette s;
  const int top = below(kImage.height);
  const int bottom = std::min(top + 1 + below(25), kImage.height);
  for (int row = top; row < bottom; ++row) {
    const int begin = below(kImage.width - 12);
    s.spans.push_back({row, begin, begin + 1 + below(5)});
    if (below(2) == 0) s.spans.push_back({row, begin + 7, begin + 8 + below(4)});
  }
  s.box = {0, static_cast<double>(top), 10, static_cast<double>(bottom - top)};
  s.inside_share = 1;
  return s;
}

std::optional<double> brute_force(const Silhouette& s, int gap, int radius,
                                  const cv::Mat& foreground, const cv::Mat& hidden,
                                  double least_visible) {
  const cv::Mat inside = painted(s.spans);
  double in = 0, in_set = 0, ring = 0, ring_set = 0, full = 0;
  for (int y = 0; y < kImage.height; ++y) {
    for (int x = 0; x < kImage.width; ++x) {
      full += inside.at<uchar>(y, x) != 0;
      if (hidden.at<uchar>(y, x) != 0) continue;
      bool near = false, in_gap = false;
      for (int v = std::max(y - radius, 0); v <= std::min(y + radius, kImage.height - 1); ++v) {
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, kImage.width - 1); ++u) {
          if (inside.at<uchar>(v, u) == 0) continue;
          near = true;
          in_gap = in_gap || (std::abs(u - x) <= gap && std::abs(v - y) <= gap);
        }
      }
      const bool set = foreground.at<uchar>(y, x) != 0;
      if (inside.at<uchar>(y, x) != 0) {
        ++in;
        in_set += set;
      } else if (near && !in_gap) {
        ++ring;
        ring_set += set;
      }
    }
  }
  full /= s.inside_share;
  if (in == 0 || in < least_visible * full) return std::nullopt;
  return in_set / in - (ring > 0 ? ring_set / ring : 0);
}

TEST(OccupancyTest, EqualsCountingPixelByPixel) {
  std::mt19937 random(5);
  int told = 0, untold = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Silhouette s = random_silhouette(random);
    const RingShape ring{.gap = 0.06 * (i % 3), .width = 0.05 + 0.1 * (i % 4)};
    const int gap = static_cast<int>(std::lround(ring.gap * s.box.height));
    const int radius = gap + std::max(1, static_cast<int>(std::lround(ring.width * s.box.height)));
    SpanTemplates templates(kImage);
    templates.add(random_silhouette(random), ring);
    templates.add(s, ring);
    const cv::Mat blind = random_mask(i + 1000, i % 3 == 0 ? 0 : 60);
    cv::Mat foreground = random_mask(i, 40);
    foreground.setTo(cv::Scalar(0), blind);
    std::vector<std::shared_ptr<const ExplainedPatch>> explained;
    cv::Mat hidden = blind.clone();
    for (std::uint32_t people = 0; people < i % 4; ++people) {
      const Silhouette other = random_silhouette(random);
      cv::bitwise_or(hidden, painted(other.spans), hidden);
      int left = kImage.width, right = 0;
      for (const RowSpan& span : other.spans) {
        left = std::min(left, span.begin);
        right = std::max(right, span.end);
      }
      const int top = other.spans.front().row, bottom = other.spans.back().row + 1;
      explained.push_back(std::make_shared<const ExplainedPatch>(
          boundary_of(other.spans), cv::Rect(left, top, right - left, bottom - top), foreground,
          i % 3 == 0 ? cv::Mat() : blind, explained));
    }
    const auto expected = brute_force(s, gap, radius, foreground, hidden, 0.4);
    const AreaCounts blind_counts = cv::countNonZero(blind) == 0 ? AreaCounts() : AreaCounts(blind);
    const auto actual =
        occupancy(templates, 1, {AreaCounts(foreground), blind_counts, explained}, 0.4);
    ASSERT_EQ(actual.has_value(), expected.has_value()) << i;
    if (actual) {
      EXPECT_NEAR(*actual, *expected, 1e-12) << i;
    }
    ++(actual ? told : untold);
  }
  EXPECT_GT(told, 50);
  EXPECT_GT(untold, 50);
}

TEST(OccupancyTest, UprightBoundariesAreFewRuns) {
  std::vector<RowSpan> spans;
  for (int row = 5; row < 25; ++row) spans.push_back({row, row < 15 ? 10 : 12, 20});
  const std::vector<BoundaryRun> runs = boundary_of(spans);
  ASSERT_EQ(runs.size(), 3U);  // two on the left, one on the right
  const AreaCounts all(cv::Mat(kImage, CV_8UC1, cv::Scalar(1)));
  SpanTemplates templates(kImage);
  Silhouette s;
  s.spans = spans;
  s.inside_share = 1;
  s.box = {10, 5, 10, 20};
  templates.add(s, {0, 0.1});
  EXPECT_EQ(count(templates, 0, all, {}).inner.set, 180U);
}

TEST(OccupancyTest, PartsOutsideTheImageAreNotVisible) {
  Silhouette s;
  for (int row = 0; row < 10; ++row) s.spans.push_back({row, 0, 4});
  s.box = {-6, 0, 10, 10};
  s.inside_share = 0.4;
  SpanTemplates templates(kImage);
  templates.add(s, {0, 0.1});
  templates.add(Silhouette(), {0, 0.1});  // not visible at all
  const AreaCounts counts(cv::Mat(kImage, CV_8UC1, cv::Scalar(255))), none;
  const Countable all{counts, none, {}};
  EXPECT_DOUBLE_EQ(occupancy(templates, 0, all, 0.3).value(), 0);
  EXPECT_FALSE(occupancy(templates, 0, all, 0.5).has_value());
  EXPECT_FALSE(occupancy(templates, 1, all, 0).has_value());
}

TEST(OccupancyTest, DilatesAsASquareBrush) {
  std::mt19937 random(9);
  for (int i = 0; i < 50; ++i) {
    const std::vector<RowSpan> spans = random_silhouette(random).spans;
    const int radius = 1 + i % 4;
    const std::vector<RowSpan> grown = dilated(spans, radius, kImage);
    const cv::Mat small = painted(spans);
    const cv::Mat large = painted(grown);
    int area = 0;
    for (const RowSpan& s : grown) area += s.end - s.begin;
    EXPECT_EQ(area, cv::countNonZero(large)) << "spans overlap";
    for (int y = 0; y < kImage.height; ++y) {
      for (int x = 0; x < kImage.width; ++x) {
        const cv::Rect brush = cv::Rect(x - radius, y - radius, 2 * radius + 1, 2 * radius + 1) &
                               cv::Rect(cv::Point(), kImage);
        ASSERT_EQ(large.at<uchar>(y, x) != 0, cv::countNonZero(small(brush)) > 0)
            << x << "," << y << " of " << i;
      }
    }
  }
}

TEST(OccupancyTest, FilledInEmptySurroundingsIsOneAndTheOtherWayRoundMinusOne) {
  Silhouette s;
  for (int row = 10; row < 20; ++row) s.spans.push_back({row, 10, 16});
  s.box = {10, 10, 6, 10};
  s.inside_share = 1;
  SpanTemplates templates(kImage);
  templates.add(s, {0, 0.2});
  const cv::Mat inside = painted(s.spans);
  const cv::Mat outside = 255 - inside;
  EXPECT_DOUBLE_EQ(occupancy(templates, 0, {AreaCounts(inside), AreaCounts(), {}}, 0).value(), 1);
  EXPECT_DOUBLE_EQ(occupancy(templates, 0, {AreaCounts(outside), AreaCounts(), {}}, 0).value(), -1);
}

}  // namespace
}  // namespace plaza::color
