#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace plaza {

/// The middle of some figures and how far they spread.
struct Spread {
  std::size_t count = 0;
  double median = 0;
  double low = 0, high = 0;  ///< quartiles
  double least = 0, most = 0;
};

/// Quantile `p` in [0, 1] of at least one value, interpolated between the two nearest (Hyndman and
/// Fan's type 7, as numpy and R do by default).
double quantile(std::vector<double> values, double p);

/// Nothing for no values.
std::optional<Spread> spread_of(const std::vector<double>& values);

/// A mean with the interval that it lies in with 95 % confidence.
struct Estimate {
  std::size_t count = 0;
  double mean = 0;
  /// Bounds of the interval; nothing for fewer than kLeastPairs differences, which say too little.
  std::optional<double> low, high;

  /// The interval leaves zero out.
  bool distinct() const { return low && (*low > 0 || *high < 0); }
};

inline constexpr std::size_t kLeastPairs = 3;

/// Percentile bootstrap of the mean (Efron 1979): 10000 resamplings with a generator of our own, so
/// that the same differences give the same interval on every machine. Nothing for no values.
std::optional<Estimate> bootstrap_mean(const std::vector<double>& values, std::uint64_t seed);

}  // namespace plaza
