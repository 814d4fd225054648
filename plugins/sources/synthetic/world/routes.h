#pragma once

#include <Eigen/Core>
#include <vector>

#include "plugins/sources/synthetic/world/stage.h"

namespace plaza::synthetic {

/// Ways around furniture: the shortest path over the corners of footprints, which keeps a body's
/// half width off them (visibility graph; de Berg et al., Computational Geometry, ch. 15).
class Routes {
 public:
  /// Corners outside of `floor` (grown by nothing) are not walked over.
  Routes(const std::vector<Furniture>& furniture, const Rectangle& floor);

  /// Way points from `from` to `to`, without `from`. The straight way when there is no other.
  std::vector<Eigen::Vector2d> find(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  /// Whether a body can stand there.
  bool is_free(const Eigen::Vector2d& point) const;

 private:
  bool is_open(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  std::vector<Rectangle> blocked_;
  std::vector<Eigen::Vector2d> corners_;
};

}  // namespace plaza::synthetic
