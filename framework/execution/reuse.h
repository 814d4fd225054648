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
#include "framework/results/summary.h"

namespace plaza {

/// What nodes gave in an earlier run with the same content is read instead of computed, and what
/// they give now is kept for later ones.
///
/// A node works only when something that works reads what the cache does not have. An output is
/// kept when computing it took at least `least_gain` times as long as reading it back takes,
/// measured on the first frames of the run; where it did not, an entry says so.
class Reuse {
 public:
  /// All must outlive it. `keys` as stream_keys() gives them.
  Reuse(const NodeCache& cache, double least_gain, StreamKeys keys, const FrameRange& frames);

  /// Decides who works and sets it in the plan; waits while other processes compute what this run
  /// would compute as well, and then takes theirs. Returns false when a stop was requested.
  bool begin(ExecutionPlan& plan, const std::vector<Branch>& branches, bool draw);

  /// The clock does not work: frames end before this one.
  std::optional<std::int64_t> replay_end() const { return replay_end_; }
  /// Puts what is kept of one node into its slots; of all that do not work, in `replay`.
  /// Thread-safe.
  void replay_node(std::size_t node, FrameState& state) const;
  void replay(FrameState& state, std::optional<std::size_t> but = std::nullopt) const;
  void replay_flush(FrameState& state) const;

  /// Keeps what working nodes gave in a frame, in order; `seconds` so far by node. After the last
  /// frame what they gave when flushed.
  void record(const FrameState& state, const std::vector<NodeTiming>& timings);
  void record_flush(const FrameState& state);
  /// Gives the entries of a complete run their names, and makes room.
  void commit(std::int64_t frames, const std::vector<NodeTiming>& timings,
              const std::vector<std::string>& notes);

  /// What all nodes would have taken that the run asked for, had nothing been kept.
  double node_seconds(const std::vector<NodeTiming>& timings) const;
  /// Of an earlier run of the same frames; nothing while the clock works.
  std::vector<std::string> kept_notes() const;
  /// Why something could not be kept.
  const std::vector<std::string>& troubles() const { return troubles_; }

 private:
  using Place = std::pair<std::size_t, std::size_t>;  // node, output
  struct Recording {
    Place place;
    std::unique_ptr<EntryWriter> writer;
    double read_s = 0;  ///< to read back the frames that were measured
    std::int64_t frames = 0;
  };

  std::string key_of(const Place& place) const;
  void look(const ExecutionPlan& plan);
  std::vector<Place> missing(const ExecutionPlan& plan, const Demand& demand) const;
  bool lock(std::vector<Place> places);
  void open_recordings(const std::vector<Place>& places);
  EntryInfo info_of(const Place& place, std::int64_t frames,
                    const std::vector<NodeTiming>& timings) const;
  /// Ends a recording that is not worth it; an entry says so.
  void decline(Recording& recording, const std::vector<NodeTiming>& timings);
  std::optional<std::string> encode(const Place& place, const PayloadPtr& payload) const;
  void give_up(Recording& recording, const std::string& why);

  const NodeCache& cache_;
  const double least_gain_;
  const StreamKeys keys_;
  const FrameRange frames_;
  const ExecutionPlan* plan_ = nullptr;
  Demand demand_, without_cache_;
  std::map<Place, std::unique_ptr<EntryReader>> kept_;  ///< whole entries, declined ones included
  std::map<Place, FileLock> locks_;
  std::vector<Recording> recordings_;
  std::optional<std::int64_t> replay_end_;
  std::vector<std::string> troubles_;
};

}  // namespace plaza
