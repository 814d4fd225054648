#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plaza::synthetic {

inline constexpr int kTile = 8;
inline constexpr std::size_t kTilePixels = kTile * kTile;

/// An image cut into squares of kTile pixels, row by row; the last ones may be cut off.
struct TileGrid {
  TileGrid(int image_width, int image_height)
      : width(image_width),
        height(image_height),
        across((image_width + kTile - 1) / kTile),
        down((image_height + kTile - 1) / kTile) {}

  std::size_t count() const {
    return static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
  }

  /// Calls body(x, y, pixel) for the pixels of one tile, row by row.
  template <class Body>
  void each_pixel(std::size_t tile, const Body& body) const {
    const int ty = static_cast<int>(tile) / across, tx = static_cast<int>(tile) % across;
    for (int y = ty * kTile; y < std::min(height, (ty + 1) * kTile); ++y) {
      for (int x = tx * kTile; x < std::min(width, (tx + 1) * kTile); ++x) {
        body(x, y,
             static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x));
      }
    }
  }

  /// The chosen tiles (those that are not zero) and the eight around each of them.
  std::vector<std::uint8_t> with_neighbours(const std::vector<std::uint8_t>& chosen) const {
    std::vector<std::uint8_t> out(chosen.size(), 0);
    for (int y = 0; y < down; ++y) {
      for (int x = 0; x < across; ++x) {
        if (chosen[static_cast<std::size_t>(y * across + x)] == 0) continue;
        for (int ny = std::max(0, y - 1); ny <= std::min(down - 1, y + 1); ++ny) {
          for (int nx = std::max(0, x - 1); nx <= std::min(across - 1, x + 1); ++nx) {
            out[static_cast<std::size_t>(ny * across + nx)] = 1;
          }
        }
      }
    }
    return out;
  }

  int width, height;  ///< px
  int across, down;   ///< tiles
};

}  // namespace plaza::synthetic
