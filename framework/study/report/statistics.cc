#include "framework/study/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plaza {
namespace {

constexpr int kResamplings = 10000;
constexpr double kTail = 0.025;  // on each side of 95 %

/// Steele, Lea, Flood: Fast splittable pseudorandom number generators (2014). The standard
/// library's distributions differ between implementations.
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : state_(seed) {}
  /// One of 0 to count - 1; the bias of the product is below 2^-32 for any count there is here.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(((next() >> 32U) * static_cast<std::uint64_t>(count)) >> 32U);
  }

 private:
  std::uint64_t next() {
    std::uint64_t x = (state_ += 0x9E3779B97F4A7C15U);
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
    return x ^ (x >> 31U);
  }
  std::uint64_t state_;
};

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(at));
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - std::floor(at)) * (values[above] - values[below]);
}

std::optional<Spread> spread_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return Spread{.count = values.size(),
                .median = quantile(values, 0.5),
                .low = quantile(values, 0.25),
                .high = quantile(values, 0.75),
                .least = *least,
                .most = *most};
}

std::optional<Estimate> bootstrap_mean(const std::vector<double>& values, std::uint64_t seed) {
  if (values.empty()) return std::nullopt;
  Estimate estimate;
  estimate.count = values.size();
  estimate.mean = mean_of(values);
  if (values.size() < kLeastPairs) return estimate;
  Generator generator(seed);
  std::vector<double> means;
  means.reserve(kResamplings);
  std::vector<double> sample(values.size());
  for (int i = 0; i < kResamplings; ++i) {
    for (double& value : sample) value = values[generator.below(values.size())];
    means.push_back(mean_of(sample));
  }
  estimate.low = quantile(means, kTail);
  estimate.high = quantile(means, 1 - kTail);
  return estimate;
}

}  // namespace plaza
