#pragma once

#include <cstdint>

namespace plaza::synthetic {

/// Mixes two numbers into one that looks independent of both (the finaliser of splitmix64, Steele
/// et al. 2014). The same on every machine.
constexpr std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
  std::uint64_t z = a + 0x9e3779b97f4a7c15ULL * (b + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// A sequence of random numbers that depends on its seed alone. The distributions of the standard
/// library differ between libraries, these don't.
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}

  std::uint64_t next() { return mix(seed_, counter_++); }
  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  /// Mean 0, deviation 1, within +-3.46: the sum of twelve uniform numbers.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      sum += unit();
    }
    return sum;
  }
  bool chance(double probability) { return unit() < probability; }
  /// Uniform in [0, count); count > 0.
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(next() % count); }

 private:
  std::uint64_t seed_;
  std::uint64_t counter_ = 0;
};

}  // namespace plaza::synthetic
