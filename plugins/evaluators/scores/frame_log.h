#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/component/node.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"

namespace plaza::scores {

/// The parameter by which every evaluator of this library leaves out how a run begins.
template <class Options>
void add_from_s(Parameters<Options>& parameters) {
  parameters.value("from_s", &Options::from_s)
      .unit("s")
      .at_least(0)
      .meaning(
          "frames before this time, which counts from the clip's first frame, count for nothing: "
          "for what happens after something has changed, or has warmed up");
}

/// What was true in the frames that somebody looked at.
class TruthLog {
 public:
  /// Of the frames from that time on; earlier ones are as if nobody had looked.
  explicit TruthLog(double from_s) : from_ns_(std::llround(from_s * 1e9)) {}
  /// Takes the frame's truth from `input`, where there is one (after the last frame there is none).
  void add(const NodeIo& io, std::size_t input);
  const std::map<std::int64_t, std::shared_ptr<const GroundTruth>>& frames() const {
    return frames_;
  }
  bool has_boxes() const { return has_boxes_; }
  bool has_positions() const { return has_positions_; }

 private:
  std::int64_t from_ns_;
  std::map<std::int64_t, std::shared_ptr<const GroundTruth>> frames_;
  bool has_boxes_ = false;
  bool has_positions_ = false;
};

/// The final points of all tracks: an associator may give them long after their frame.
class TrackLog {
 public:
  /// Throws InternalError when a point that was final comes again.
  void add(const Tracks& tracks);
  /// By rising identity; empty where there are none.
  std::vector<const TrackPoint*> at(std::int64_t frame) const;

 private:
  std::map<std::int64_t, std::map<TrackId, TrackPoint>> frames_;
};

}  // namespace plaza::scores
