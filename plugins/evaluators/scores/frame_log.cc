#include "frame_log.h"

#include <algorithm>
#include <string>
#include <utility>

#include "plaza/core/error.h"

namespace plaza::scores {

void TruthLog::add(const NodeIo& io, std::size_t input) {
  if (!io.has(input) || io.time_ns() < from_ns_) return;
  auto truth = io.share<GroundTruth>(input);
  if (!truth->annotated) return;
  for (const TruePerson& person : truth->people) {
    has_boxes_ = has_boxes_ || !person.views.empty();
    has_positions_ = has_positions_ || person.position_m.has_value();
  }
  frames_.emplace(io.frame(), std::move(truth));
}

void TrackLog::add(const Tracks& tracks) {
  for (const TrackPoint& point : tracks.points) {
    if (!point.final) continue;
    TrackPoint kept = point;
    if (!frames_[point.frame].emplace(point.id, std::move(kept)).second) {
      throw InternalError("track " + std::to_string(point.id) + " has two final points in frame " +
                          std::to_string(point.frame + 1));
    }
  }
}

std::vector<const TrackPoint*> TrackLog::at(std::int64_t frame) const {
  std::vector<const TrackPoint*> points;
  const auto found = frames_.find(frame);
  if (found == frames_.end()) return points;
  for (const auto& [id, point] : found->second) points.push_back(&point);
  return points;
}

}  // namespace plaza::scores
