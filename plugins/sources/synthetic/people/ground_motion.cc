#include "plugins/sources/synthetic/people/ground_motion.h"

#include <algorithm>
#include <cmath>

#include "plaza/core/error.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;

/// The four samples around a moment, and where between the middle two it lies.
struct Place {
  std::size_t before, from, to, after;
  double share;
};

Place locate(double seconds, double start_s, std::size_t count) {
  const double last = static_cast<double>(count - 1);
  const double at = std::clamp((seconds - start_s) * GroundMotion::kRateHz, 0.0, last);
  const auto from = std::min(static_cast<std::size_t>(at), count - 1);
  const std::size_t to = std::min(from + 1, count - 1);
  return {from == 0 ? 0 : from - 1, from, to, std::min(to + 1, count - 1),
          at - static_cast<double>(from)};
}

/// The cubic through the middle two samples whose slopes there are those between their neighbours
/// (E. Catmull and R. Rom, "A class of local interpolating splines", 1974):
/// start + share / 2 * (linear + square * share + cube * share^2).
template <typename T>
struct Cubic {
  T start, linear, square, cube;
};

template <typename T>
Cubic<T> cubic_at(const std::vector<T>& samples, const Place& place) {
  const T& a = samples[place.before];
  const T& b = samples[place.from];
  const T& c = samples[place.to];
  const T& d = samples[place.after];
  return {b, c - a, 2 * a - 5 * b + 4 * c - d, 3 * (b - c) + d - a};
}

template <typename T>
T interpolate(const std::vector<T>& samples, const Place& place) {
  const Cubic<T> p = cubic_at(samples, place);
  const double s = place.share;
  return p.start + 0.5 * s * (p.linear + s * (p.square + s * p.cube));
}

/// Per second.
template <typename T>
T slope(const std::vector<T>& samples, const Place& place) {
  const Cubic<T> p = cubic_at(samples, place);
  const double s = place.share;
  return GroundMotion::kRateHz * 0.5 * (p.linear + s * (2 * p.square + 3 * s * p.cube));
}

template <typename T>
std::vector<T> smooth(const std::vector<T>& samples, const std::vector<double>& weights) {
  const auto reach = static_cast<std::ptrdiff_t>(weights.size()) - 1;
  const auto count = static_cast<std::ptrdiff_t>(samples.size());
  std::vector<T> result(samples.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    T sum = weights[0] * samples[static_cast<std::size_t>(i)];
    double total = weights[0];
    for (std::ptrdiff_t k = 1; k <= reach; ++k) {
      // at the ends the motion is continued along its last direction by point reflection
      const auto at = [&](std::ptrdiff_t j) -> T {
        if (j < 0) {
          return 2 * samples.front() - samples[static_cast<std::size_t>(std::min(-j, count - 1))];
        }
        if (j >= count) {
          return 2 * samples.back() - samples[static_cast<std::size_t>(
                                          std::max<std::ptrdiff_t>(2 * (count - 1) - j, 0))];
        }
        return samples[static_cast<std::size_t>(j)];
      };
      const double weight = weights[static_cast<std::size_t>(k)];
      sum += weight * (at(i - k) + at(i + k));
      total += 2 * weight;
    }
    result[static_cast<std::size_t>(i)] = sum / total;
  }
  return result;
}

}  // namespace

GroundMotion::GroundMotion(double start_s, std::vector<Vector2d> position_m,
                           std::vector<double> heading_rad)
    : start_s_(start_s), position_(std::move(position_m)), heading_(std::move(heading_rad)) {
  if (position_.empty() || position_.size() != heading_.size()) {
    throw InternalError("a ground motion needs as many headings as positions, and at least one");
  }
}

double GroundMotion::end_s() const {
  return start_s_ + static_cast<double>(position_.size() - 1) / kRateHz;
}

Vector2d GroundMotion::position(double seconds) const {
  return interpolate(position_, locate(seconds, start_s_, position_.size()));
}

Vector2d GroundMotion::velocity(double seconds) const {
  return slope(position_, locate(seconds, start_s_, position_.size()));
}

double GroundMotion::heading(double seconds) const {
  return interpolate(heading_, locate(seconds, start_s_, heading_.size()));
}

double GroundMotion::yaw_rate(double seconds) const {
  return slope(heading_, locate(seconds, start_s_, heading_.size()));
}

GroundMotion GroundMotion::smoothed(double sigma_s) const {
  const double sigma = sigma_s * kRateHz;
  std::vector<double> weights;
  for (int k = 0; k <= static_cast<int>(std::ceil(3 * sigma)); ++k) {
    weights.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
  }
  return GroundMotion(start_s_, smooth(position_, weights), smooth(heading_, weights));
}

}  // namespace plaza::synthetic
