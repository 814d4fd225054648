#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plaza/data/track.h"

namespace plaza {

/// The final points of one associator, by frame. Points that never become final are not kept.
class TrackStore {
 public:
  /// `node` is named in errors; no point may lie before `first_frame`.
  TrackStore(std::string node, std::int64_t first_frame)
      : node_(std::move(node)), first_frame_(first_frame) {}

  /// Takes what is final. A point that became final before, or whose numbers are not finite, is an
  /// InternalError naming node, frame and id.
  void add(const Tracks& tracks);

  /// Points of one frame, by rising id.
  const std::vector<TrackPoint>& at(std::int64_t frame) const;
  std::int64_t first_frame() const { return first_frame_; }

 private:
  std::string node_;
  std::int64_t first_frame_ = 0;
  std::vector<std::vector<TrackPoint>> frames_;
};

}  // namespace plaza
