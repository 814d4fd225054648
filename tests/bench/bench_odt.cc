// The oriented distance transform of four 752x480 images with 4-5 % edge pixels in 12 directions,
// one thread, in the three forms, beside twelve of OpenCV's transforms and a copy of its output.
// The forms take turns, so that other work on the machine meets all of them; of each the fastest
// turn counts.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "modalities/edges/fast_transform.h"
#include "modalities/edges/plain_transform.h"

namespace plaza::edges {
namespace {

constexpr int kImages = 4;
constexpr int kDirections = 12;
const cv::Size kSize(752, 480);

/// Contours as Canny leaves them: thin curves, until `share` of the pixels are edges.
cv::Mat1b contours(std::uint32_t seed, double share) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  cv::Mat1b edges(kSize, uchar{0});
  const auto enough = static_cast<int>(share * kSize.area());
  while (cv::countNonZero(edges) < enough) {
    double x = unit(random) * kSize.width, y = unit(random) * kSize.height;
    double angle = 2 * CV_PI * unit(random), bend = 0;
    for (int step = 0; step < 120; ++step) {
      const cv::Point p(static_cast<int>(x), static_cast<int>(y));
      if (!cv::Rect({}, kSize).contains(p)) break;
      edges(p) = 255;
      bend = 0.95 * bend + 0.02 * (unit(random) - 0.5);
      angle += bend;
      x += std::cos(angle);
      y += std::sin(angle);
    }
  }
  return edges;
}

/// One thing to measure and its fastest turn, seconds.
struct Turn {
  std::function<void()> work;
  double best_s = std::numeric_limits<double>::infinity();
  void take() {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    best_s = std::min(best_s, taken.count());
  }
};

void oriented_transform(benchmark::State& state) {
  cv::setNumThreads(1);
  const auto layout = std::make_shared<const PlaneLayout>(kSize, make_directions(kDirections, 9.0));
  std::vector<cv::Mat1b> images, inverse;
  std::vector<ByteBlock> blocks;
  int edges = 0;
  for (std::uint32_t i = 0; i < kImages; ++i) {
    images.push_back(contours(i + 1, 0.045));
    inverse.emplace_back();
    cv::bitwise_not(images.back(), inverse.back());
    blocks.emplace_back(layout->bytes());
    edges += cv::countNonZero(images.back());
  }
  FastTransform fast(layout);
  const std::size_t output = std::size_t{kImages} * kDirections * kSize.area();
  std::vector<std::uint8_t> from(output, 1), to(output, 2);
  cv::Mat1f distances(kSize);

  Turn transform{[&] {
    for (std::size_t i = 0; i < kImages; ++i) fast.run(images[i], blocks[i]);
  }};
  Turn copy{[&] {
    std::memcpy(to.data(), from.data(), output);
    benchmark::ClobberMemory();
  }};
  Turn opencv{[&] {
    for (const cv::Mat1b& image : inverse) {
      for (int d = 0; d < kDirections; ++d) {
        cv::distanceTransform(image, distances, cv::DIST_L2, cv::DIST_MASK_3);
      }
    }
  }};
  const auto each = [&](const auto& plain) {
    for (const cv::Mat1b& image : images) {
      for (const Direction& d : layout->directions()) {
        benchmark::DoNotOptimize(plain(image, d).data);
      }
    }
  };
  Turn scanning{[&] { each(transform_by_scanning); }};
  Turn exploring{[&] { each(transform_by_exploring); }};

  for ([[maybe_unused]] auto _ : state) {
    for (int i = 0; i < 5; ++i) {
      transform.take();
      copy.take();
    }
    opencv.take();
    scanning.take();
    exploring.take();
  }
  state.counters["odt.times_copy"] = transform.best_s / copy.best_s;
  state.counters["odt.share_of_opencv12"] = transform.best_s / opencv.best_s;
  state.counters["fast_ms"] = transform.best_s * 1e3;
  state.counters["copy_ms"] = copy.best_s * 1e3;
  state.counters["opencv12_ms"] = opencv.best_s * 1e3;
  state.counters["scanning_ms"] = scanning.best_s * 1e3;
  state.counters["exploring_ms"] = exploring.best_s * 1e3;
  state.counters["edge_share"] = static_cast<double>(edges) / kImages / kSize.area();
}
BENCHMARK(oriented_transform)
    ->Name("odt.times_copy,odt.share_of_opencv12")
    ->Iterations(12)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plaza::edges
