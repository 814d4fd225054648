#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/cache/node_cache.h"
#include "framework/execution/frame_loop.h"
#include "framework/execution/plan.h"
#include "framework/results/summary.h"

namespace plaza {

/// An output of a node.
struct Place {
  std::size_t node = 0;
  std::size_t output = 0;
  auto operator<=>(const Place&) const = default;
};

/// What nodes give in a run, on its way into the cache.
///
/// An output is kept when computing it took at least `least_gain` times as long as reading it back
/// takes, measured on the first frames; where it did not, an entry says so. Trouble with the cache
/// ends a recording, never the run.
class Recordings {
 public:
  /// Seconds by node that earlier runs of the same frames took.
  using Seconds = std::map<std::string, double>;

  /// `cache` must outlive it.
  Recordings(const NodeCache& cache, double least_gain, std::int64_t first_frame)
      : cache_(cache), least_gain_(least_gain), first_frame_(first_frame) {}

  /// `plan` must outlive it; `known` is of nodes that do not work in this run.
  void begin(const ExecutionPlan& plan, Seconds known);
  /// Records one output under `key`, which this run alone may compute as long as it holds `lock`.
  void open(const Place& place, const std::string& key, FileLock lock);

  /// What working nodes gave in a frame, in order; after the last frame what they gave when
  /// flushed.
  void add(const FrameState& state, const std::vector<NodeTiming>& timings);
  void add_flush(const FrameState& state);
  /// Gives the entries of a complete run their names, and makes room.
  void commit(std::int64_t frames, const std::vector<NodeTiming>& timings,
              const std::vector<std::string>& notes);

  /// What went wrong; others may add to it.
  std::vector<std::string>& troubles() { return troubles_; }
  const std::vector<std::string>& troubles() const { return troubles_; }

 private:
  struct Recording {
    Place place;
    FileLock lock;
    std::unique_ptr<EntryWriter> writer;  ///< null: it has ended
    double read_s = 0;                    ///< to read back the frames that were measured
    std::int64_t frames = 0;
  };

  const PayloadPtr& payload_of(const Recording& recording, const FrameState& state) const;
  std::optional<std::string> encode(const Place& place, const PayloadPtr& payload) const;
  void add(Recording& recording, const FrameState& state, const std::vector<NodeTiming>& timings);
  void measure(Recording& recording, const Payload& payload, const std::string& bytes) const;
  EntryInfo info_of(const Place& place, std::int64_t frames,
                    const std::vector<NodeTiming>& timings) const;
  /// Ends a recording that is not worth it; an entry says so.
  void decline(Recording& recording, const std::vector<NodeTiming>& timings);
  void give_up(Recording& recording, const std::string& why);
  static void end(Recording& recording);

  const NodeCache& cache_;
  const double least_gain_;
  const std::int64_t first_frame_;
  const ExecutionPlan* plan_ = nullptr;
  Seconds known_;
  std::vector<Recording> recordings_;
  std::vector<std::string> troubles_;
};

}  // namespace plaza
