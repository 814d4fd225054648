#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/cache/node_cache.h"
#include "framework/cache/stream_keys.h"
#include "framework/execution/demand.h"
#include "framework/execution/frame_loop.h"
#include "framework/execution/recordings.h"
#include "framework/execution/run.h"
#include "framework/results/summary.h"

namespace plaza {

/// What nodes gave in an earlier run with the same content is read instead of computed, and what
/// they give now is kept for later ones.
///
/// A node works only when something that works reads what the cache does not have. An output is
/// kept when computing it took at least `least_gain` times as long as reading it back takes,
/// measured on the first frames of the run; where it did not, an entry says so.
///
/// With RunOptions::reuse unset it only sees to it that nobody works whom nobody needs; nothing is
/// read or kept then.
class Reuse {
 public:
  /// All must outlive it.
  Reuse(const NodeCache& cache, const RunOptions& options);

  /// Decides who works and sets it in the plan; waits while other processes compute what this run
  /// would compute as well, and then takes theirs. Returns false when a stop was requested. Once.
  bool begin(ExecutionPlan& plan, const std::vector<Branch>& branches,
             const ResolvedPipeline& pipeline, const Scene& scene);

  /// The clock does not work: frames end before this one.
  std::optional<std::int64_t> replay_end() const { return replay_end_; }
  /// Puts what is kept of one node into its slots; of all that do not work, in `replay`.
  /// Thread-safe.
  void replay_node(std::size_t node, FrameState& state) const;
  void replay(FrameState& state, std::optional<std::size_t> but = std::nullopt) const;
  void replay_flush(FrameState& state) const;

  /// What is to be kept of this run. Nothing where RunOptions::reuse is unset.
  Recordings& recordings() { return recordings_; }

  /// What all nodes would have taken that somebody reads, had nothing been kept: the same whoever
  /// worked in this run.
  double node_seconds(const std::vector<NodeTiming>& timings) const;
  /// Of an earlier run of the same frames; nothing while the clock works.
  std::vector<std::string> kept_notes() const;

 private:
  /// Takes the right to compute what the cache does not have; false when a stop was requested.
  bool settle(const ExecutionPlan& plan, const std::vector<Branch>& branches);
  std::string key_of(const Place& place) const;
  void look(const ExecutionPlan& plan);
  std::vector<Place> missing(const ExecutionPlan& plan, const Demand& demand) const;
  bool lock(std::vector<Place> places);
  Recordings::Seconds known_seconds() const;

  const NodeCache& cache_;
  const RunOptions& options_;
  const FrameRange frames_;
  StreamKeys keys_;
  const ExecutionPlan* plan_ = nullptr;
  Demand demand_, without_cache_;
  std::map<Place, std::unique_ptr<EntryReader>> kept_;  ///< whole entries, declined ones included
  std::map<Place, FileLock> locks_;
  Recordings recordings_;
  std::optional<std::int64_t> replay_end_;
};

}  // namespace plaza
