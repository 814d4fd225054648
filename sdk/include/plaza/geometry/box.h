#pragma once

#include "plaza/core/export.h"

namespace plaza {

/// Axis-aligned image box in pixels, continuous coordinates; covers [left, left + width].
struct Box {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
  double area() const { return width * height; }
  bool operator==(const Box&) const = default;
};

/// Intersection over union, in [0, 1]; without the historical "+1" of pixel counting. 0 when the
/// union has no area.
PLAZA_API double intersection_over_union(const Box& a, const Box& b);

}  // namespace plaza
