#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "plaza/data/track.h"

namespace plaza::drawing {

struct TrailPoint {
  std::int64_t frame = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
};

/// One person's path on the ground, by rising frame.
using Trail = std::vector<TrailPoint>;

/// Cuts a trail where more than `gap_frames` lie between two points: nobody knows how the person
/// went.
std::vector<std::span<const TrailPoint>> unbroken_pieces(std::span<const TrailPoint> trail,
                                                         std::int64_t gap_frames);

/// Where everybody went in the last frames. Memory is bounded by people times `length_frames`.
class TrailMemory {
 public:
  explicit TrailMemory(std::int64_t length_frames) : length_frames_(length_frames) {}

  /// Frames must rise. People who have left are forgotten when their last point is too old.
  void add(std::int64_t frame, std::span<const TrackPoint> tracks);
  /// By rising id.
  const std::map<TrackId, Trail>& trails() const { return trails_; }

 private:
  std::int64_t length_frames_;
  std::map<TrackId, Trail> trails_;
};

}  // namespace plaza::drawing
