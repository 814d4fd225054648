#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "plugins/sources/synthetic/render/view_renderer.h"

namespace plaza::synthetic {

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kContactReach = 1.1f;  // metres over which a body darkens what is near
inline constexpr float kMirrorReach = 3.0f;   // metres over which a floor mirrors a body

/// What one picture is drawn on.
struct ViewRenderer::Canvas {
  cv::Mat image;
  std::vector<std::uint32_t>
      shaded;  // per tile: bit l + 1: light l may be kept off, bit 0: ambient
  std::vector<std::uint8_t> mirrors;  // per tile
  std::vector<std::uint8_t> covered;  // per tile
};

/// A point of a body as light sees it.
struct BodyPoint {
  Vec3 place, normal;
  BodySurface surface;
};

BodyPoint body_point(const MovingBody& body, const RayHit& hit, const Vec3& origin,
                     const Vec3& direction);

/// One pixel of each square of 2 x 2, at another place in each of four neighbouring squares: those
/// that look where not all have to.
inline bool is_scout(int x, int y) {
  return (x & 1) == ((y >> 1) & 1) && (y & 1) == ((x >> 1) & 1);
}

/// One scout of each square of 4 x 4: those that look where hardly anything is.
inline bool is_forerunner(int x, int y) { return is_scout(x, y) && is_scout(x >> 1, y >> 1); }

/// Ranks of the pixels of a square of 4 x 4: neighbours' differ much. The four scouts of a square
/// have one of each four that follow each other.
inline int rank_in_square(int x, int y) {
  constexpr std::array<std::uint8_t, 16> kRank = {0, 8,  2, 10, 12, 4, 14, 6,
                                                  3, 11, 1, 9,  15, 7, 13, 5};
  return kRank[static_cast<std::size_t>((y & 3) * 4 + (x & 3))];
}

}  // namespace plaza::synthetic
