#include "plaza/geometry/box.h"

#include <algorithm>

namespace plaza {

double intersection_over_union(const Box& a, const Box& b) {
  const double w = std::min(a.right(), b.right()) - std::max(a.left, b.left);
  const double h = std::min(a.bottom(), b.bottom()) - std::max(a.top, b.top);
  const double intersection = std::max(w, 0.0) * std::max(h, 0.0);
  const double united = a.area() + b.area() - intersection;
  return united > 0 ? intersection / united : 0;
}

}  // namespace plaza
