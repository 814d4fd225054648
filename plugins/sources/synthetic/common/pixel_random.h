#pragma once

#include <cstdint>

namespace plaza::synthetic {

/// Mixer of 32 bits, for what is drawn per pixel and ray: what comes out depends on the counters
/// alone, so any thread may draw any of it in any order (C. Wellons' lowbias32).
inline std::uint32_t hash32(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

/// In [0, 1), 24 bits.
inline float to_unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

}  // namespace plaza::synthetic
