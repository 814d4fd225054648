#include "plugins/sources/synthetic/world/routes.h"

#include <algorithm>
#include <limits>

namespace plaza::synthetic {

using Eigen::Vector2d;

namespace {

constexpr double kBodyHalfWidth = 0.30;

/// Whether a line passes through the inside of a rectangle (slab method).
bool crosses(const Rectangle& box, const Vector2d& from, const Vector2d& to) {
  double enter = 0, exit = 1;
  const Vector2d along = to - from;
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(along[axis]) < 1e-12) {
      if (from[axis] <= box.low[axis] || from[axis] >= box.high[axis]) {
        return false;
      }
      continue;
    }
    const double a = (box.low[axis] - from[axis]) / along[axis];
    const double b = (box.high[axis] - from[axis]) / along[axis];
    enter = std::max(enter, std::min(a, b));
    exit = std::min(exit, std::max(a, b));
  }
  return enter + 1e-9 < exit;
}

}  // namespace

Routes::Routes(const std::vector<Furniture>& furniture, const Rectangle& floor) {
  for (const Furniture& thing : furniture) {
    blocked_.push_back(thing.footprint.grown(kBodyHalfWidth));
  }
  const Rectangle walkable = floor.grown(-kBodyHalfWidth);
  for (const Rectangle& box : blocked_) {
    const Rectangle around = box.grown(0.02);
    for (const Vector2d& corner :
         {around.low, around.high, Vector2d(around.low.x(), around.high.y()),
          Vector2d(around.high.x(), around.low.y())}) {
      if (walkable.contains(corner) && is_free(corner)) {
        corners_.push_back(corner);
      }
    }
  }
}

bool Routes::is_free(const Vector2d& point) const {
  return std::none_of(blocked_.begin(), blocked_.end(),
                      [&](const Rectangle& box) { return box.distance(point) < 0; });
}

bool Routes::is_open(const Vector2d& from, const Vector2d& to) const {
  return std::none_of(blocked_.begin(), blocked_.end(), [&](const Rectangle& box) {
    // who stands too close to a thing may walk away from it
    return box.distance(from) >= 0 && crosses(box, from, to);
  });
}

std::vector<Vector2d> Routes::find(const Vector2d& from, const Vector2d& to) const {
  if (is_open(from, to)) {
    return {to};
  }
  // Dijkstra over few nodes: 0 is `from`, 1 is `to`, then the corners
  std::vector<Vector2d> nodes = {from, to};
  nodes.insert(nodes.end(), corners_.begin(), corners_.end());
  std::vector<double> distance(nodes.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> before(nodes.size(), 0);
  std::vector<bool> done(nodes.size(), false);
  distance[0] = 0;
  for (std::size_t round = 0; round < nodes.size(); ++round) {
    std::size_t nearest = nodes.size();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!done[i] && (nearest == nodes.size() || distance[i] < distance[nearest])) {
        nearest = i;
      }
    }
    done[nearest] = true;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double there = distance[nearest] + (nodes[i] - nodes[nearest]).norm();
      if (!done[i] && there < distance[i] && is_open(nodes[nearest], nodes[i])) {
        distance[i] = there;
        before[i] = nearest;
      }
    }
  }
  std::vector<Vector2d> way = {to};
  if (distance[1] < std::numeric_limits<double>::infinity()) {
    for (std::size_t at = before[1]; at != 0; at = before[at]) {
      way.push_back(nodes[at]);
    }
  }
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace plaza::synthetic
