#include "plaza/core/parallel.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace plaza {
namespace {

/// Runs in an arena of so many threads, as a run does.
template <class Body>
void with_threads(int threads, const Body& body) {
  tbb::task_arena arena(threads);
  arena.execute(body);
}

class ParallelForTest : public testing::TestWithParam<int> {};

TEST_P(ParallelForTest, CallsEveryIndexOnceAndWaits) {
  with_threads(GetParam(), [] {
    std::vector<std::atomic<int>> calls(1000);
    parallel_for(calls.size(), [&](std::size_t i) { ++calls[i]; });
    for (const auto& c : calls) EXPECT_EQ(c, 1);
  });
}

TEST_P(ParallelForTest, RethrowsTheFaultOfTheLowestIndex) {
  with_threads(GetParam(), [] {
    for (int trial = 0; trial < 20; ++trial) {
      try {
        parallel_for(64, [](std::size_t i) {
          if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
        });
        FAIL() << "nothing thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "7");
      }
    }
  });
}

TEST_P(ParallelForTest, MayBeNested) {
  with_threads(GetParam(), [] {
    std::atomic<int> calls = 0;
    parallel_for(8, [&](std::size_t) { parallel_for(8, [&](std::size_t) { ++calls; }); });
    EXPECT_EQ(calls, 64);
  });
}

TEST_P(ParallelForTest, NothingToDoIsNothing) {
  with_threads(GetParam(), [] { parallel_for(0, [](std::size_t) { FAIL(); }); });
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelForTest, testing::Values(1, 2, 4));

}  // namespace
}  // namespace plaza
