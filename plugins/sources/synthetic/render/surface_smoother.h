#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "plugins/sources/synthetic/render/tile_grid.h"

namespace plaza::synthetic {

class StaticView;

/// Red, green, blue and a number of its own, in one register.
using Rgbw = Eigen::Vector4f;

/// Averages what is known of pixels over their neighbours on the same smooth surface: first along
/// rows, then along columns. Which neighbours these are is found out once.
class SurfaceSmoother {
 public:
  static constexpr int kMaxRadius = 6;

  /// Takes points, normals and parts from a view; works when these are known.
  explicit SurfaceSmoother(const StaticView& view);

  /// Replaces each value of `field` (by pixel) by the mean over a window of (2 radius + 1)^2
  /// pixels, of those on the same surface; radius <= kMaxRadius. The sky keeps its values.
  void smooth(int radius, std::vector<Rgbw>& field) const;
  /// The same for a field that is zero outside of the tiles given (those that are not zero).
  /// Returns the tiles outside of which the result is zero.
  std::vector<std::uint8_t> smooth(int radius, const std::vector<std::uint8_t>& tiles,
                                   std::vector<Rgbw>& field) const;

  const TileGrid& grid() const { return grid_; }

 private:
  TileGrid grid_;
  // bit k - 1: the pixel k before this one is on its surface; bit kMaxRadius + k - 1: k after
  std::vector<std::uint16_t> across_, down_;
};

}  // namespace plaza::synthetic
