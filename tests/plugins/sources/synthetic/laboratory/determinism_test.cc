// The renderer's bytes are those of the parameters and the frame: not of threads, nor of order.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "plugins/sources/synthetic/laboratory.h"
#include "tests/plugins/sources/synthetic/laboratory/small_scene.h"

namespace plaza::synthetic {
namespace {

/// FNV-1a of all bytes of all images.
std::uint64_t digest(const std::vector<cv::Mat>& images) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const cv::Mat& image : images) {
    const cv::Mat bytes = image.isContinuous() ? image : image.clone();
    const std::size_t count = bytes.total() * bytes.elemSize();
    for (std::size_t i = 0; i < count; ++i) hash = (hash ^ bytes.data[i]) * 0x100000001b3ULL;
  }
  return hash;
}

using Digests = std::map<std::int64_t, std::uint64_t>;

/// Calls `work` where there are `threads` threads.
void with_threads(int threads, const std::function<void()>& work) {
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena(threads).execute(work);
}

std::unique_ptr<const Laboratory> build(int threads) {
  LaboratoryOptions options = small_options();
  options.scenario = "four-crossing";
  std::unique_ptr<const Laboratory> out;
  with_threads(threads, [&] { out = std::make_unique<Laboratory>(options, small_scene()); });
  return out;
}

Digests one_by_one(const Laboratory& lab, int threads, const std::vector<std::int64_t>& frames) {
  Digests out;
  with_threads(threads, [&] {
    for (const std::int64_t frame : frames) out[frame] = digest(lab.images(frame));
  });
  return out;
}

Digests at_once(const Laboratory& lab, int threads, const std::vector<std::int64_t>& frames) {
  Digests out;
  for (const std::int64_t frame : frames) out[frame] = 0;
  with_threads(threads, [&] {
    tbb::parallel_for(std::size_t{0}, frames.size(),
                      [&](std::size_t i) { out.at(frames[i]) = digest(lab.images(frames[i])); });
  });
  return out;
}

TEST(Determinism, SameBytesOnAnyNumberOfThreadsAndInAnyOrderOfFrames) {
  const auto by_one = build(1), by_four = build(4);
  const Digests reference = one_by_one(*by_one, 1, {10, 40, 70});
  EXPECT_NE(reference.at(10), reference.at(40));
  EXPECT_NE(reference.at(40), reference.at(70));
  EXPECT_EQ(one_by_one(*by_one, 2, {70, 10, 40}), reference);
  EXPECT_EQ(at_once(*by_one, 3, {40, 70, 10}), reference);
  EXPECT_EQ(one_by_one(*by_four, 4, {70, 40, 10}), reference);
  EXPECT_EQ(at_once(*by_four, 4, {10, 40, 70}), reference);
}

}  // namespace
}  // namespace plaza::synthetic
