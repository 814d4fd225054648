#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "framework/execution/frame_loop.h"
#include "framework/execution/plan.h"
#include "framework/results/branches.h"
#include "framework/results/result_files.h"
#include "framework/results/track_store.h"

namespace plaza {

/// Collects the answers of all branches while frames are done, and writes the contract's files.
class Recorder {
 public:
  /// Creates the folders of the other branches and opens their files.
  Recorder(const std::vector<Branch>& branches, const ExecutionPlan& plan, const Scene& scene,
           const std::filesystem::path& folder, std::int64_t first_frame);

  /// Takes what a frame's slots hold; frames come in order.
  void add_frame(const FrameState& state);
  /// Takes, of a frame that was not done, the tracks: what they say of earlier frames is final.
  void add_rest(const FrameState& state);
  /// Takes the tracks that were emitted while flushing.
  void add_flushed(const FrameState& state);
  /// Gives every file its name. `end_frame`: one past the last frame that was done.
  std::vector<Artifact> write(std::int64_t end_frame);

  /// Tracks that stand in `slot`, or null.
  const TrackStore* tracks_in(int slot) const;

 private:
  struct BranchFiles {
    std::filesystem::path folder;
    int tracks_slot = -1;
    int observations_slot = -1;
    std::unique_ptr<TrackStore> tracks;
    std::int64_t tracks_end = 0;  ///< one past the last frame whose tracks were taken
    std::unique_ptr<ObservationsFile> observations;
  };
  void add_tracks(BranchFiles& branch, const FrameState& state);
  /// Makes all up to `end_frame` survive the end of this process, in parts.
  void flush(std::int64_t end_frame);

  const Scene& scene_;
  std::vector<BranchFiles> branches_;
  std::chrono::steady_clock::time_point next_flush_;
};

}  // namespace plaza
