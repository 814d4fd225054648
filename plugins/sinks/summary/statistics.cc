#include "plugins/sinks/summary/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace plaza::summary {
namespace {

/// Mean position within half a second before and after a point, without looking beyond [begin,
/// end).
Eigen::Vector2d smoothed(const Trajectory& t, std::size_t i, std::size_t begin, std::size_t end,
                         std::int64_t half_window_frames) {
  // The window shrinks evenly towards the ends, else they would be pulled inwards.
  const auto reach = [&](std::size_t j) { return std::abs(t[j].frame - t[i].frame); };
  const std::int64_t window = std::min({half_window_frames, reach(begin), reach(end - 1)});
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double count = 0;
  for (std::size_t j = i + 1; j-- > begin && reach(j) <= window;) {
    sum += t[j].position_m;
    ++count;
  }
  for (std::size_t j = i + 1; j < end && reach(j) <= window; ++j) {
    sum += t[j].position_m;
    ++count;
  }
  return sum / count;
}

}  // namespace

PersonFigures figures_of(const Trajectory& t, double frame_rate_hz) {
  if (t.empty()) throw std::invalid_argument("a trajectory has at least one point");
  const auto half_window = static_cast<std::int64_t>(std::lround(0.5 * frame_rate_hz));
  const auto longest_gap = std::max<std::int64_t>(1, std::llround(frame_rate_hz));

  PersonFigures f;
  f.id = t.front().id;
  f.first_frame = t.front().frame;
  f.last_frame = t.back().frame;
  f.seconds = static_cast<double>(t.size()) / frame_rate_hz;
  const auto observed =
      std::count_if(t.begin(), t.end(), [](const TrackPoint& p) { return p.observed; });
  f.observed_share = static_cast<double>(observed) / static_cast<double>(t.size());

  double walked_s = 0;
  for (std::size_t begin = 0; begin < t.size();) {
    std::size_t end = begin + 1;
    while (end < t.size() && t[end].frame - t[end - 1].frame <= longest_gap) ++end;
    Eigen::Vector2d before = t[begin].position_m;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const Eigen::Vector2d here = smoothed(t, i, begin, end, half_window);
      f.path_m += (here - before).norm();
      before = here;
    }
    walked_s += static_cast<double>(t[end - 1].frame - t[begin].frame) / frame_rate_hz;
    begin = end;
  }
  f.speed_m_per_s = walked_s > 0 ? f.path_m / walked_s : 0;
  return f;
}

CountFigures figures_of_counts(const std::vector<std::int64_t>& counts) {
  if (counts.empty()) return {};
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  const auto sum = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  return {*least, static_cast<double>(sum) / static_cast<double>(counts.size()), *most};
}

std::vector<std::int64_t> people_per_frame(const Trajectories& people, std::int64_t begin,
                                           std::int64_t end) {
  std::vector<std::int64_t> counts(
      static_cast<std::size_t>(std::max<std::int64_t>(0, end - begin)));
  for (const auto& [id, trajectory] : people) {
    for (const TrackPoint& p : trajectory) {
      if (p.frame >= begin && p.frame < end) ++counts[static_cast<std::size_t>(p.frame - begin)];
    }
  }
  return counts;
}

}  // namespace plaza::summary
