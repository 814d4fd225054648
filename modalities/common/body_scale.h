#pragma once

#include <vector>

#include "plaza/geometry/camera.h"
#include "plaza/geometry/scene.h"

namespace plaza {

/// How large the smallest body is that a pixel can belong to: among all bodies that stand in the
/// area, or a little beyond it, and whose boxes contain the pixel, that is the farthest one. So a
/// thing that reaches down to this pixel is at most as large as this says, wherever it is.
class BodyScale {
 public:
  BodyScale(const Camera& camera, const GroundArea& area, const Body& body);

  /// Height of the body, metres.
  double body_m() const { return body_m_; }
  /// Pixels per metre of height; 0 where nobody can be seen.
  float px_per_m(int x, int y) const { return block(px_per_m_, x, y); }
  /// Pixels of the body's box; 0 where nobody can be seen.
  float box_px2(int x, int y) const { return block(box_px2_, x, y); }

 private:
  float block(const std::vector<float>& values, int x, int y) const;

  double body_m_;
  int columns_;
  std::vector<float> px_per_m_, box_px2_;  ///< by blocks of pixels, row by row
};

}  // namespace plaza
