#include "framework/results/track_store.h"

#include <algorithm>
#include <cmath>

#include "plaza/core/error.h"

namespace plaza {
namespace {

bool is_finite(const TrackPoint& point) {
  const bool boxes = std::all_of(point.boxes.begin(), point.boxes.end(), [](const ViewBox& view) {
    const Box& b = view.box;
    return std::isfinite(b.left) && std::isfinite(b.top) && std::isfinite(b.width) &&
           std::isfinite(b.height);
  });
  return boxes && point.position_m.allFinite() && std::isfinite(point.score) &&
         (!point.heading_rad || std::isfinite(*point.heading_rad));
}

}  // namespace

void TrackStore::add(const Tracks& tracks) {
  for (const TrackPoint& point : tracks.points) {
    if (!point.final) continue;
    const auto refuse = [&](const char* why) {
      InternalError error("track point of id " + std::to_string(point.id) + " " + why);
      error.add_context({.component = node_, .frame = point.frame, .camera = {}});
      throw error;
    };
    if (point.frame < first_frame_) refuse("speaks of a frame before the first one");
    if (!is_finite(point)) refuse("has a number that is not finite");
    const auto index = static_cast<std::size_t>(point.frame - first_frame_);
    if (index >= frames_.size()) frames_.resize(index + 1);
    std::vector<TrackPoint>& people = frames_[index];
    const auto place = std::lower_bound(people.begin(), people.end(), point.id,
                                        [](const TrackPoint& p, TrackId id) { return p.id < id; });
    if (place != people.end() && place->id == point.id) refuse("became final twice");
    people.insert(place, point);
  }
}

const std::vector<TrackPoint>& TrackStore::at(std::int64_t frame) const {
  static const std::vector<TrackPoint> kNobody;
  const auto index = static_cast<std::size_t>(frame - first_frame_);
  return frame < first_frame_ || index >= frames_.size() ? kNobody : frames_[index];
}

}  // namespace plaza
