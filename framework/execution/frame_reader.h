#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "framework/execution/frame_loop.h"
#include "framework/execution/plan.h"
#include "framework/execution/spool.h"
#include "plaza/geometry/scene.h"

namespace plaza {

/// All sources of a pipeline as one: read in step, and again from the start where a phase of the
/// run needs it. What a live source gave is kept on disk for that.
class FrameReader {
 public:
  /// Both must outlive the reader.
  FrameReader(const ExecutionPlan& plan, const Scene& scene) : plan_(plan), scene_(scene) {}

  /// Opens all sources that work, and the clock in any case where `with_clock` is set.
  void open(bool with_clock = false);
  /// From now on the clock is not read: `fill` puts in what it gave in an earlier run, and frames
  /// end before `end`.
  void replay_clock(std::int64_t end, std::function<void(FrameState&)> fill);
  /// As the clock announces it, for progress and early checks; nothing: known at the end.
  std::optional<std::int64_t> frame_count() const { return info_.frame_count; }
  bool rereadable() const { return info_.rereadable; }
  std::int64_t background_count() const { return info_.background_count; }
  /// From now on, what a live source gives is kept below `folder`; nothing to do for others.
  void keep(const std::filesystem::path& folder);

  /// Makes `frame` the next one.
  void seek(std::int64_t frame);
  std::int64_t next() const { return next_; }
  /// Reads the next frame of all sources into a fresh state; false at the end of the clock.
  bool read(FrameState& state);
  /// The same of the clock alone.
  bool read_clock(FrameState& state);
  /// One of the clock's images of the empty place into a fresh state; what is read next stays.
  void read_background(std::int64_t index, FrameState& state) const;

 private:
  bool read_live(const PlannedNode& clock, FrameState& state);
  bool read_source(const PlannedNode& node, FrameState& state) const;

  const ExecutionPlan& plan_;
  const Scene& scene_;
  SourceInfo info_;
  std::function<void(FrameState&)> fill_;  ///< replaces the clock when set
  std::int64_t next_ = 0;
  // of a live source: how far it was read, its images, and what else it gave by frame
  std::int64_t live_next_ = 0;
  std::int64_t kept_from_ = 0;
  std::unique_ptr<Spool> spool_;
  std::vector<std::vector<PayloadPtr>> kept_;
};

}  // namespace plaza
