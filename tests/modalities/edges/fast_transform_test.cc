// The fast transform against the thesis's two forms, on every pixel.
#include "modalities/edges/fast_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "modalities/edges/plain_transform.h"

namespace plaza::edges {
namespace {

/// Nothing but the definition: the nearest edge among the pixels of the same line.
cv::Mat1b by_definition(const cv::Mat1b& edges, const Direction& d) {
  cv::Mat1b out(edges.size(), kNoEdge);
  for (int y = 0; y < edges.rows; ++y) {
    for (int x = 0; x < edges.cols; ++x) {
      const int major = d.steep ? y : x, minor = d.steep ? x : y;
      for (int k = -d.gate; k <= d.gate; ++k) {
        const int other = minor - d.shift(major) + d.shift(major + k);
        const cv::Point p = d.steep ? cv::Point(other, major + k) : cv::Point(major + k, other);
        if (!cv::Rect({}, edges.size()).contains(p) || edges(p) == 0) continue;
        out(y, x) = std::min(out(y, x), static_cast<unsigned char>(std::abs(k)));
      }
    }
  }
  return out;
}

cv::Mat1b noise(cv::Size size, double share, std::mt19937& random) {
  cv::Mat1b edges(size, uchar{0});
  std::bernoulli_distribution edge(share);
  for (auto& pixel : edges) pixel = edge(random) ? 255 : 0;
  return edges;
}

/// Curves, as Canny leaves them.
cv::Mat1b curves(cv::Size size, int count, std::mt19937& random) {
  cv::Mat1b edges(size, uchar{0});
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < count; ++i) {
    double x = unit(random) * size.width, y = unit(random) * size.height, a = unit(random) * 6.3;
    for (int s = 0; s < 60; ++s) {
      const cv::Point p(static_cast<int>(x), static_cast<int>(y));
      if (cv::Rect({}, size).contains(p)) edges(p) = 1;  // any value but 0 is an edge
      x += std::cos(a);
      y += std::sin(a);
      a += 0.1 * (unit(random) - 0.5);
    }
  }
  return edges;
}

int differing(const cv::Mat1b& a, const cv::Mat1b& b) {
  int count = 0;
  for (int y = 0; y < a.rows; ++y) {
    for (int x = 0; x < a.cols; ++x) count += a(y, x) != b(y, x);
  }
  return count;
}

cv::Mat1b read(const ByteBlock& block, const PlaneLayout& layout, std::size_t direction) {
  cv::Mat1b out(layout.size());
  for (int y = 0; y < out.rows; ++y) {
    for (int x = 0; x < out.cols; ++x) {
      out(y, x) =
          steps_of(block.data()[layout.offset(direction, x, y)], layout.directions()[direction]);
    }
  }
  return out;
}

void expect_equal(const cv::Mat1b& edges, int directions, double gate_px) {
  const auto layout =
      std::make_shared<const PlaneLayout>(edges.size(), make_directions(directions, gate_px));
  std::vector<cv::Mat1b> scanned;
  for (const Direction& d : layout->directions()) {
    scanned.push_back(transform_by_scanning(edges, d));
    ASSERT_EQ(differing(scanned.back(), by_definition(edges, d)), 0) << d.angle_rad;
    ASSERT_EQ(differing(scanned.back(), transform_by_exploring(edges, d)), 0) << d.angle_rad;
  }
  for (const SweepVersion& version : sweep_versions()) {
    FastTransform transform(layout, version.run);
    ByteBlock block(layout->bytes());
    transform.run(edges, block);
    for (std::size_t d = 0; d < layout->directions().size(); ++d) {
      EXPECT_EQ(differing(scanned[d], read(block, *layout, d)), 0)
          << version.name << ", direction " << d << ", " << edges.cols << "x" << edges.rows;
    }
  }
}

TEST(FastTransform, EqualsThePlainFormsOnNoise) {
  std::mt19937 random(5);
  for (const cv::Size size : {cv::Size(97, 61), {64, 32}, {31, 33}, {130, 40}, {33, 95}}) {
    for (const double share : {0.002, 0.05, 0.5}) expect_equal(noise(size, share, random), 12, 9);
  }
}

TEST(FastTransform, EqualsThePlainFormsOnCurves) {
  std::mt19937 random(6);
  expect_equal(curves({188, 120}, 20, random), 12, 9);
  expect_equal(curves({101, 143}, 12, random), 12, 4.5);
}

TEST(FastTransform, EqualsThePlainFormsOnImagesOfAnySize) {
  std::mt19937 random(7);
  for (int height = 1; height <= 7; ++height) {
    for (int width = 1; width <= 7; ++width)
      expect_equal(noise({width, height}, 0.2, random), 12, 9);
  }
  for (const int width : {31, 32, 33, 63, 64, 65}) {
    expect_equal(noise({width, 3}, 0.1, random), 12, 9);
    expect_equal(noise({3, width}, 0.1, random), 12, 9);
    expect_equal(noise({width, 1}, 0.1, random), 12, 9);
    expect_equal(noise({1, width}, 0.1, random), 12, 9);
  }
}

TEST(FastTransform, EqualsThePlainFormsForAnyNumberOfDirectionsAndGate) {
  std::mt19937 random(8);
  const cv::Mat1b edges = noise({70, 45}, 0.01, random);
  for (const int directions : {1, 2, 3, 7, 8, 36}) expect_equal(edges, directions, 9);
  for (const double gate_px : {0.0, 0.5, 1.0, 30.0, 254.0}) expect_equal(edges, 12, gate_px);
}

TEST(FastTransform, EmptyAndFullImages) {
  for (const cv::Size size : {cv::Size(1, 1), {40, 30}}) {
    expect_equal(cv::Mat1b(size, uchar{0}), 12, 9);
    expect_equal(cv::Mat1b(size, uchar{255}), 12, 9);
  }
}

TEST(FastTransform, EdgesAtTheBorderDoNotReachTheOtherSide) {
  for (const cv::Point p : {cv::Point(0, 0), {49, 0}, {0, 29}, {49, 29}, {0, 15}, {49, 15}}) {
    cv::Mat1b edges(30, 50, uchar{0});
    edges(p) = 255;
    expect_equal(edges, 12, 40);
  }
}

TEST(FastTransform, IsReusedWithoutATraceOfTheImageBefore) {
  std::mt19937 random(9);
  const auto layout = std::make_shared<const PlaneLayout>(cv::Size(77, 41), make_directions(12, 9));
  FastTransform transform(layout);
  ByteBlock block(layout->bytes());
  for (const double share : {0.5, 0.01, 0.1}) {
    const cv::Mat1b edges = noise({77, 41}, share, random);
    transform.run(edges, block);
    for (std::size_t d = 0; d < 12; ++d) {
      EXPECT_EQ(
          differing(transform_by_scanning(edges, layout->directions()[d]), read(block, *layout, d)),
          0);
    }
  }
}

TEST(PlaneLayout, FindsThePixelOfAnOffset) {
  const PlaneLayout layout({37, 23}, make_directions(12, 9));
  for (std::size_t d = 0; d < 12; ++d) {
    for (const cv::Point p : {cv::Point(0, 0), {36, 22}, {5, 17}}) {
      EXPECT_EQ(layout.pixel(d, layout.offset(d, p.x, p.y)), p);
    }
  }
}

TEST(PlaneLayout, RefusesWhatItCannotHold) {
  const auto directions = make_directions(12, 9);
  EXPECT_THROW(PlaneLayout({0, 5}, directions), std::invalid_argument);
  EXPECT_THROW(PlaneLayout({5, 40000}, directions), std::invalid_argument);
  EXPECT_THROW(PlaneLayout({5, 5}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace plaza::edges
