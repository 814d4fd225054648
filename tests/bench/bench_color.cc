// Foreground segmentation of one image by one core: criterion and random field with a previous
// mask, and the running counts that silhouettes are matched with. No Lab.
#include <benchmark/benchmark.h>

#include <ctime>
#include <opencv2/core.hpp>
#include <random>

#include "modalities/color/occupancy.h"
#include "modalities/color/segmenter.h"

namespace plaza::color {
namespace {

constexpr int kWidth = 752;
constexpr int kHeight = 480;

cv::Mat noisy(const cv::Mat& scene, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 3);
  cv::Mat image(scene.size(), CV_8UC3);
  for (int y = 0; y < scene.rows; ++y) {
    for (int i = 0; i < 3 * scene.cols; ++i) {
      image.ptr<uchar>(y)[i] = cv::saturate_cast<uchar>(scene.ptr<uchar>(y)[i] + noise(random));
    }
  }
  return image;
}

/// A textured street with five people on it, who take a step from one image to the next.
cv::Mat with_people(const cv::Mat& street, int step) {
  cv::Mat image = noisy(street, static_cast<std::uint32_t>(step));
  for (int person = 0; person < 5; ++person) {
    const cv::Rect body(60 + 130 * person + 4 * step, 150 + 20 * person, 45, 150);
    image(body).setTo(cv::Scalar(30 + 20 * person, 40, 90));
  }
  return image;
}

double processor_seconds() {
  std::timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void segment(benchmark::State& state, const char* figure, const RowKernels& kernels) {
  cv::Mat street(kHeight, kWidth, CV_8UC3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      street.at<cv::Vec3b>(y, x) = {static_cast<uchar>(90 + (x * 7 + y * 3) % 41),
                                    static_cast<uchar>(100 + (x + y) % 29),
                                    static_cast<uchar>(110 + (x * y) % 23)};
    }
  }
  const Background background{street, cv::Mat(street.size(), CV_32FC1, cv::Scalar(3))};
  const auto segmenter = make_cpu_segmenter(Criterion(background, {}), {}, kernels);
  const cv::Mat images[2] = {with_people(street, 0), with_people(street, 1)};
  cv::Mat previous = segmenter->segment(images[0], {}).mask;
  std::int64_t turn = 1;
  // the processor's time, not the wall's: one core's work, whoever else is on the machine
  const double begin = processor_seconds();
  for ([[maybe_unused]] auto _ : state) {
    const Segmentation result = segmenter->segment(images[turn++ % 2], previous);
    previous = result.mask;
    const AreaCounts counts(result.mask);
    benchmark::DoNotOptimize(counts.data()[counts.size() - 1]);
  }
  const double seconds = processor_seconds() - begin;
  state.counters[figure] = 1e3 * seconds / static_cast<double>(state.iterations());
}

void fastest(benchmark::State& s) { segment(s, "color.ms_per_image", fastest_kernels()); }
void scalar(benchmark::State& s) { segment(s, "color.scalar_ms_per_image", kScalarKernels); }

// named after their figures, so that a filter finds them
BENCHMARK(fastest)->Name("color.ms_per_image")->Unit(benchmark::kMillisecond)->MinTime(1);
BENCHMARK(scalar)->Name("color.scalar_ms_per_image")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plaza::color
