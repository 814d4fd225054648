#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace plaza::synthetic {

/// An axis-parallel rectangle on the ground, metres.
struct Rectangle {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();

  Eigen::Vector2d center() const { return (low + high) / 2; }
  Eigen::Vector2d size() const { return high - low; }
  bool contains(const Eigen::Vector2d& point) const {
    return (point.array() >= low.array()).all() && (point.array() <= high.array()).all();
  }
  /// The same rectangle with every side moved outwards (inwards when negative).
  Rectangle grown(double by_m) const { return {low.array() - by_m, high.array() + by_m}; }
  /// Distance of a point outside; inside, minus the distance to the nearest side.
  double distance(const Eigen::Vector2d& point) const;
};

/// An opening through which people come and go: in a wall of a room, or, outdoors, a place beyond
/// the observed area where they appear.
struct Door {
  Eigen::Vector2d center_m;  ///< on the wall's inner side
  Eigen::Vector2d inward;    ///< unit vector into the room
  /// Unit vector along the wall, to which people go when they are through; zero outdoors.
  Eigen::Vector2d aside = Eigen::Vector2d::Zero();
  double width_m = 1.1;
  double height_m = 2.1;

  /// Where people appear and vanish: 1.1 m behind the wall and 1.6 m to the side.
  Eigen::Vector2d hidden_place() const;
};

enum class FurnitureKind { kTable, kCabinet, kCouch, kPlant, kBox };

/// A thing that stands on the floor, at least as wide and as high as what is drawn.
struct Furniture {
  FurnitureKind kind = FurnitureKind::kTable;
  Rectangle footprint;
  double height_m = 0.75;
};

/// What the people move in. Coordinates are those of the scene's ground.
struct Stage {
  Rectangle area;                  ///< the observed area, the scene's
  std::optional<Rectangle> walls;  ///< inner sides of a room's walls; none outdoors
  double wall_height_m = 3.0;
  std::vector<Door> doors;  ///< at least one
  std::vector<Furniture> furniture;
};

/// A room around the observed area: walls 0.8 m outside of it, two doors in opposite corners, and
/// furniture along the edges of the area, some of it inside. Behind each door people come from
/// and vanish to the side, out of sight of cameras in the room.
Stage indoor_stage(const Rectangle& area);

/// The stage after somebody has shoved furniture about: the first table 0.6 m and the first plant
/// 1.1 m towards the area's middle, everything else where it was. Nothing changes where neither is.
Stage with_moved_furniture(const Stage& stage);

/// Open ground: people come from and go to places 7 m beyond the middle thirds of the area's
/// sides, where no camera at the area's corners looks.
Stage outdoor_stage(const Rectangle& area);

}  // namespace plaza::synthetic
