#include "plugins/associators/gnn/target.h"

#include <algorithm>
#include <cmath>

namespace plaza {
namespace {

SmoothedPoint filtered(const TargetSample& s) {
  return {.position_m = s.position_m, .velocity_mps = s.velocity_mps};
}

SmoothedPoint regression(const std::vector<TargetSample>& samples, std::size_t index,
                         double window_s) {
  const double t0 = samples[index].time_s;
  const double limit_s = window_s * (1 + 1e-9);  // time stamps at the window's end are in it
  double w = 0, wt = 0, wtt = 0;
  Eigen::Vector2d wx = Eigen::Vector2d::Zero(), wtx = Eigen::Vector2d::Zero();
  int used = 0;
  const auto add = [&](const TargetSample& s) {
    if (!s.observed) return;
    const double t = s.time_s - t0;
    const double spread = t / (0.5 * window_s);
    const double k = s.weight * std::exp(-0.5 * spread * spread);
    w += k;
    wt += k * t;
    wtt += k * t * t;
    wx += k * s.measured_m;
    wtx += k * t * s.measured_m;
    ++used;
  };
  for (std::size_t i = index + 1; i-- > 0 && t0 - samples[i].time_s <= limit_s;) add(samples[i]);
  for (std::size_t i = index + 1; i < samples.size() && samples[i].time_s - t0 <= limit_s; ++i) {
    add(samples[i]);
  }
  const double determinant = w * wtt - wt * wt;
  if (used < 3 || !(determinant > 1e-12 * w * w)) return filtered(samples[index]);
  return {.position_m = (wtt * wx - wt * wtx) / determinant,
          .velocity_mps = (w * wtx - wt * wx) / determinant};
}

}  // namespace

SmoothedPoint smoothed(const std::vector<TargetSample>& samples, std::size_t index,
                       double window_s) {
  const TargetSample& sample = samples[index];
  const auto at = [&](std::size_t i) {
    return window_s > 0 ? regression(samples, i, window_s) : filtered(samples[i]);
  };
  if (sample.observed) return at(index);
  std::size_t before = index;
  while (before > 0 && !samples[before].observed) --before;
  std::size_t after = index;
  while (after < samples.size() && !samples[after].observed) ++after;
  if (!samples[before].observed || after == samples.size()) return filtered(sample);
  const SmoothedPoint a = at(before);
  const SmoothedPoint b = at(after);
  const double span_s = samples[after].time_s - samples[before].time_s;
  const double t = (sample.time_s - samples[before].time_s) / span_s;
  return {.position_m = (1 - t) * a.position_m + t * b.position_m,
          .velocity_mps = (b.position_m - a.position_m) / span_s};
}

}  // namespace plaza
