#include "plugins/sinks/drawing/trails.h"

#include <algorithm>

namespace plaza::drawing {

std::vector<std::span<const TrailPoint>> unbroken_pieces(std::span<const TrailPoint> trail,
                                                         std::int64_t gap_frames) {
  std::vector<std::span<const TrailPoint>> pieces;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= trail.size(); ++i) {
    if (i == trail.size() || trail[i].frame - trail[i - 1].frame > gap_frames) {
      pieces.push_back(trail.subspan(begin, i - begin));
      begin = i;
    }
  }
  return pieces;
}

void TrailMemory::add(std::int64_t frame, std::span<const TrackPoint> tracks) {
  for (const TrackPoint& t : tracks) trails_[t.id].push_back({frame, t.position_m});
  for (auto it = trails_.begin(); it != trails_.end();) {
    Trail& trail = it->second;
    const auto recent = std::find_if(trail.begin(), trail.end(), [&](const TrailPoint& p) {
      return frame - p.frame <= length_frames_;
    });
    trail.erase(trail.begin(), recent);
    it = trail.empty() ? trails_.erase(it) : std::next(it);
  }
}

}  // namespace plaza::drawing
