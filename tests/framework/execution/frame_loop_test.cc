#include "framework/execution/frame_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "framework/execution/run.h"
#include "framework/execution/stop.h"

namespace plaza {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

/// A loop over `count` frames that notes what happens.
class FrameLoopTest : public ::testing::TestWithParam<int> {
 protected:
  LoopEnd run(std::int64_t count) {
    FrameLoop loop;
    loop.read = [this, count](FrameState& state) {
      if (next_ == count) return false;
      state.reset(next_++, 0, 1, 0);
      if (read_hook_) read_hook_(state.frame);
      return true;
    };
    loop.stages = stages_;
    loop.done = [this](FrameState& state) { done_.push_back(state.frame); };
    tbb::task_arena arena(GetParam());
    return arena.execute([&] { return run_frames(loop, GetParam()); });
  }

  std::int64_t next_ = 0;
  std::function<void(std::int64_t)> read_hook_;
  std::vector<Stage> stages_;
  std::vector<std::int64_t> done_;
};

std::vector<std::int64_t> up_to(std::int64_t count) {
  std::vector<std::int64_t> frames;
  for (std::int64_t i = 0; i < count; ++i) frames.push_back(i);
  return frames;
}

TEST_P(FrameLoopTest, OrderedStagesAndTheEndSeeAllFramesInOrder) {
  std::vector<std::int64_t> seen;
  stages_.push_back({.ordered = false, .work = [](FrameState& s) {
                       std::this_thread::sleep_for(std::chrono::microseconds((s.frame * 37) % 200));
                     }});
  stages_.push_back({.ordered = true, .work = [&](FrameState& s) { seen.push_back(s.frame); }});
  const LoopEnd end = run(200);
  EXPECT_EQ(end.frames, 200);
  EXPECT_FALSE(end.fault);
  EXPECT_FALSE(end.stopped);
  EXPECT_EQ(seen, up_to(200));
  EXPECT_EQ(done_, up_to(200));
}

TEST_P(FrameLoopTest, NoStateServesTwoFramesAtOnce) {
  std::mutex mutex;
  std::vector<const FrameState*> busy;
  std::atomic<int> shared{0};
  const auto enter = [&](FrameState& s) {
    const std::lock_guard lock(mutex);
    for (const FrameState* other : busy) shared += other == &s ? 1 : 0;
    busy.push_back(&s);
  };
  const auto leave = [&](FrameState& s) {
    const std::lock_guard lock(mutex);
    std::erase(busy, &s);
  };
  stages_.push_back({.ordered = false, .work = [&](FrameState& s) {
                       enter(s);
                       std::this_thread::yield();
                       leave(s);
                     }});
  run(500);
  EXPECT_EQ(shared, 0);
}

TEST_P(FrameLoopTest, NothingToReadIsAnEnd) {
  EXPECT_EQ(run(0).frames, 0);
  EXPECT_TRUE(done_.empty());
}

TEST_P(FrameLoopTest, TheEarliestFaultIsTheOneThatCounts) {
  // frame 20 fails late, later frames fail early: whatever comes first in time, 20 is the answer
  stages_.push_back({.ordered = false, .work = [](FrameState& s) {
                       if (s.frame == 20) std::this_thread::sleep_for(std::chrono::milliseconds(5));
                       s.failed_node = static_cast<std::size_t>(s.frame);
                       if (s.frame >= 20)
                         throw std::runtime_error("frame " + std::to_string(s.frame));
                       s.failed_node.reset();
                     }});
  std::vector<std::int64_t> seen;
  stages_.push_back({.ordered = true, .work = [&](FrameState& s) { seen.push_back(s.frame); }});
  const LoopEnd end = run(100);
  ASSERT_TRUE(end.fault);
  EXPECT_THROW(
      try { std::rethrow_exception(end.fault); } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(), "frame 20");
        throw;
      },
      std::runtime_error);
  EXPECT_EQ(end.failed_node, 20u);
  EXPECT_EQ(end.frames, 20);
  EXPECT_EQ(done_, up_to(20));
  EXPECT_EQ(seen, up_to(20));
  EXPECT_LT(next_, 100) << "reading ends soon after a fault";
}

TEST_P(FrameLoopTest, AnOrderedStageIsNotCalledAgainAfterItFailed) {
  std::vector<std::int64_t> seen;
  stages_.push_back({.ordered = true, .work = [&](FrameState& s) {
                       seen.push_back(s.frame);
                       if (s.frame == 7) throw std::runtime_error("7");
                     }});
  const LoopEnd end = run(100);
  EXPECT_TRUE(end.fault);
  EXPECT_EQ(seen, up_to(8));
  EXPECT_EQ(done_, up_to(7));
}

TEST_P(FrameLoopTest, AFaultWhileReadingEndsAfterTheFramesBefore) {
  read_hook_ = [](std::int64_t frame) {
    if (frame == 30) throw std::runtime_error("unreadable");
  };
  const LoopEnd end = run(100);
  EXPECT_TRUE(end.fault);
  EXPECT_EQ(end.frames, 30);
  EXPECT_EQ(done_, up_to(30));
}

TEST_P(FrameLoopTest, AFaultWhileFinishingEnds) {
  FrameLoop loop;
  std::int64_t next = 0;
  loop.read = [&](FrameState& state) {
    state.reset(next++, 0, 0, 0);
    return next <= 1000;
  };
  loop.done = [](FrameState& state) {
    if (state.frame == 5) throw std::runtime_error("disk full");
  };
  tbb::task_arena arena(GetParam());
  const LoopEnd end = arena.execute([&] { return run_frames(loop, GetParam()); });
  EXPECT_TRUE(end.fault);
  EXPECT_FALSE(end.failed_node);
  EXPECT_EQ(end.frames, 5);
  EXPECT_LT(next, 1000);
}

TEST_P(FrameLoopTest, WhatWasOnItsWayBehindAFaultIsHandedOverInOrder) {
  std::vector<std::int64_t> seen, rest;
  FrameLoop loop;
  loop.read = [this](FrameState& state) {
    state.reset(next_++, 0, 1, 0);
    return true;
  };
  loop.stages.push_back({.ordered = true, .work = [&](FrameState& s) { seen.push_back(s.frame); }});
  loop.done = [](FrameState& s) {
    if (s.frame == 20) throw std::runtime_error("full");
  };
  loop.rest = [&](FrameState& s) { rest.push_back(s.frame); };
  tbb::task_arena arena(GetParam());
  const LoopEnd end = arena.execute([&] { return run_frames(loop, GetParam()); });
  EXPECT_TRUE(end.fault);
  EXPECT_EQ(end.frames, 20);
  // nothing that an ordered stage has seen is lost
  EXPECT_EQ(rest, std::vector<std::int64_t>(seen.begin() + 20, seen.end()));
  EXPECT_EQ(rest.front(), 20);
}

TEST_P(FrameLoopTest, AStopFinishesTheFramesInFlight) {
  read_hook_ = [](std::int64_t frame) {
    if (frame == 42) request_stop();
  };
  const LoopEnd end = run(1000);
  clear_stop_request();
  EXPECT_TRUE(end.stopped);
  EXPECT_FALSE(end.fault);
  EXPECT_EQ(end.frames, 43) << "what was read is done, nothing else is read";
  EXPECT_EQ(done_, up_to(43));
}

INSTANTIATE_TEST_SUITE_P(Threads, FrameLoopTest, ::testing::Values(1, 2, 3, 8));

}  // namespace
}  // namespace plaza
