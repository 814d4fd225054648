#include "plugins/sources/synthetic/render/surface_smoother.h"

#include <array>
#include <bit>

#include "plugins/sources/synthetic/render/static_view.h"

namespace plaza::synthetic {
namespace {

constexpr int kReach = SurfaceSmoother::kMaxRadius;

std::uint16_t links_of(const StaticView& view, std::size_t at, int place, int end, int stride) {
  std::uint16_t out = 0;
  if (view.sky(at)) return out;
  for (int k = 1; k <= kReach; ++k) {
    const auto step = static_cast<std::size_t>(k * stride);
    if (place - k >= 0 && view.same_surface(at, at - step)) {
      out = static_cast<std::uint16_t>(out | (1u << (k - 1)));
    }
    if (place + k < end && view.same_surface(at, at + step)) {
      out = static_cast<std::uint16_t>(out | (1u << (kReach + k - 1)));
    }
  }
  return out;
}

std::uint16_t links_within(int radius) {
  const unsigned side = (1u << radius) - 1;
  return static_cast<std::uint16_t>(side | (side << kReach));
}

Rgbw mean_of(const Rgbw* centre, std::ptrdiff_t stride, std::uint16_t links, std::uint16_t window,
             int radius) {
  static constexpr std::array<float, 2 * kReach + 2> kShare = [] {
    std::array<float, 2 * kReach + 2> out{};
    for (std::size_t i = 1; i < out.size(); ++i) out[i] = 1.0f / static_cast<float>(i);
    return out;
  }();
  Rgbw sum = *centre;
  const auto mine = static_cast<std::uint16_t>(links & window);
  if (mine == window) {
    for (std::ptrdiff_t k = 1; k <= radius; ++k) sum += centre[-k * stride] + centre[k * stride];
    return sum * kShare[static_cast<std::size_t>(2 * radius + 1)];
  }
  for (std::ptrdiff_t k = 1; k <= radius; ++k) {
    if ((mine >> (k - 1)) & 1) sum += centre[-k * stride];
    if ((mine >> (kReach + k - 1)) & 1) sum += centre[k * stride];
  }
  return sum * kShare[static_cast<std::size_t>(1 + std::popcount(mine))];
}

}  // namespace

SurfaceSmoother::SurfaceSmoother(const StaticView& view) : grid_(view.width(), view.height()) {
  across_.reserve(view.pixels());
  down_.reserve(view.pixels());
  std::size_t at = 0;
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x, ++at) {
      across_.push_back(links_of(view, at, x, view.width(), 1));
      down_.push_back(links_of(view, at, y, view.height(), view.width()));
    }
  }
}

void SurfaceSmoother::smooth(int radius, std::vector<Rgbw>& field) const {
  smooth(radius, std::vector<std::uint8_t>(grid_.count(), 1), field);
}

std::vector<std::uint8_t> SurfaceSmoother::smooth(int radius,
                                                  const std::vector<std::uint8_t>& tiles,
                                                  std::vector<Rgbw>& field) const {
  const std::vector<std::uint8_t> reached = grid_.with_neighbours(tiles);
  const std::uint16_t window = links_within(radius);
  std::vector<Rgbw> rows(field.size(), Rgbw::Zero());
  for (std::size_t tile = 0; tile < reached.size(); ++tile) {
    if (reached[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int, int, std::size_t at) {
      rows[at] = mean_of(&field[at], 1, across_[at], window, radius);
    });
  }
  for (std::size_t tile = 0; tile < reached.size(); ++tile) {
    if (reached[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int, int, std::size_t at) {
      field[at] = mean_of(&rows[at], grid_.width, down_[at], window, radius);
    });
  }
  return reached;
}

}  // namespace plaza::synthetic
