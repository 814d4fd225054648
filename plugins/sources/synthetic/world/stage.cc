#include "plugins/sources/synthetic/world/stage.h"

#include <algorithm>
#include <cmath>

namespace plaza::synthetic {

using Eigen::Vector2d;

double Rectangle::distance(const Vector2d& point) const {
  const Vector2d outside = (low - point).cwiseMax(point - high);
  return outside.maxCoeff() <= 0 ? outside.maxCoeff() : outside.cwiseMax(0.0).norm();
}

Vector2d Door::hidden_place() const {
  return aside.isZero() ? center_m : Vector2d(center_m - 1.1 * inward + 1.6 * aside);
}

Stage indoor_stage(const Rectangle& area) {
  Stage stage;
  stage.area = area;
  stage.walls = area.grown(0.8);
  const Rectangle& room = *stage.walls;
  // across the longer side's ends, so that ways from door to door cross the whole area
  stage.doors.push_back({{room.low.x(), area.low.y() + 0.9}, {1, 0}, {0, 1}});
  stage.doors.push_back({{area.high.x() - 0.9, room.high.y()}, {0, -1}, {-1, 0}});
  const Vector2d low = area.low;
  const Vector2d high = area.high;
  const Vector2d center = area.center();
  stage.furniture.push_back(
      {FurnitureKind::kTable,
       {{center.x() - 1.1, high.y() - 0.45}, {center.x() + 0.4, high.y() + 0.3}},
       0.74});
  stage.furniture.push_back(
      {FurnitureKind::kCouch,
       {{center.x() - 0.2, low.y() - 0.75}, {center.x() + 1.5, low.y() + 0.05}},
       0.7});
  stage.furniture.push_back({FurnitureKind::kCabinet,
                             {{low.x() - 0.8, high.y() - 0.9}, {low.x() - 0.3, high.y() + 0.3}},
                             1.3});
  stage.furniture.push_back(
      {FurnitureKind::kBox,
       {{high.x() - 0.35, center.y() - 0.9}, {high.x() + 0.15, center.y() - 0.3}},
       0.5});
  stage.furniture.push_back({FurnitureKind::kPlant,
                             {{high.x() + 0.2, low.y() - 0.6}, {high.x() + 0.65, low.y() - 0.15}},
                             1.4});
  return stage;
}

Stage with_moved_furniture(const Stage& stage) {
  Stage moved = stage;
  const auto shove = [&](FurnitureKind kind, const auto& way) {
    for (Furniture& thing : moved.furniture) {
      if (thing.kind != kind) continue;
      const Vector2d by = way(stage.area.center() - thing.footprint.center());
      thing.footprint = {thing.footprint.low + by, thing.footprint.high + by};
      return;
    }
  };
  // a table stands along a wall and comes straight away from it, a plant stands in a corner
  shove(FurnitureKind::kTable,
        [](const Vector2d& inwards) { return Vector2d(0, std::copysign(0.6, inwards.y())); });
  shove(FurnitureKind::kPlant,
        [](const Vector2d& inwards) { return Vector2d(1.1 * inwards.normalized()); });
  return moved;
}

Stage outdoor_stage(const Rectangle& area) {
  Stage stage;
  stage.area = area;
  const Vector2d center = area.center();
  const Vector2d sixth = area.size() / 6;
  const double beyond = 7.0;
  for (const double share : {-1.0, 1.0}) {
    stage.doors.push_back({{area.low.x() - beyond, center.y() + share * sixth.y()}, {1, 0}});
    stage.doors.push_back({{area.high.x() + beyond, center.y() - share * sixth.y()}, {-1, 0}});
    stage.doors.push_back({{center.x() + share * sixth.x(), area.low.y() - beyond}, {0, 1}});
    stage.doors.push_back({{center.x() - share * sixth.x(), area.high.y() + beyond}, {0, -1}});
  }
  return stage;
}

}  // namespace plaza::synthetic
