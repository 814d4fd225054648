// Scenarios of people who walk for the most part.

#include <cmath>
#include <numbers>

#include "plugins/sources/synthetic/world/common_orders.h"
#include "plugins/sources/synthetic/world/scenarios.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;

/// Thesis table 3.1, "Lab 3 Targets - Boxmotion": everyone walks along a rectangle of its own, and
/// on many sides of it doesn't face where it goes: sideways, backwards, or turning around all the
/// while.
class Boxmotion final : public Scenario {
 public:
  void begin(Director& director) override {
    Random& random = director.random();
    const Rectangle floor = director.floor();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t who = director.engage(ClothingStyle::kAny);
      Box& box = boxes_[i];
      // rectangles of different size that overlap
      const Vector2d half = floor.size().cwiseProduct(
          Vector2d(random.uniform(0.24, 0.40), random.uniform(0.22, 0.38)));
      const Vector2d room = (floor.size() / 2 - half - Vector2d(0.3, 0.3)).cwiseMax(0.0);
      const Vector2d center = floor.center() + Vector2d(random.uniform(-1, 1) * room.x(),
                                                        random.uniform(-1, 1) * room.y());
      box.clockwise = random.chance(0.5);
      for (std::size_t k = 0; k < 4; ++k) {
        const Vector2d corner(k == 0 || k == 3 ? -half.x() : half.x(),
                              k < 2 ? -half.y() : half.y());
        box.corners[k] = director.free_near(center + corner);
      }
      box.next = random.index(4);
      const Vector2d to = box.corners[(box.next + 1) % 4] - box.corners[box.next];
      director.appear(who, box.corners[box.next], std::atan2(to.y(), to.x()));
      advance(box);
    }
  }

  void idle(Director& director, std::size_t who) override {
    Random& random = director.random();
    Box& box = boxes_[who];
    const double choice = random.unit();
    const double hand = random.chance(0.5) ? 1.0 : -1.0;
    Facing facing;
    double speed = random.uniform(1.3, 1.6);
    if (choice < 0.45) {
      // as one walks
    } else if (choice < 0.55) {
      facing.mode = Facing::Mode::kFixed;
      facing.angle_rad = director.walker(who).heading;  // keeps it around the corner
    } else if (choice < 0.65) {
      facing.angle_rad = std::numbers::pi;
      speed = 0.8;
    } else if (choice < 0.80) {
      facing.angle_rad = hand * random.uniform(0.5, 0.9);
    } else {
      facing.mode = Facing::Mode::kSpin;
      facing.angle_rad = hand * random.uniform(1.6, 2.4);
    }
    director.go(who, box.corners[box.next], speed, facing);
    if (random.chance(0.2)) {
      // turns on the spot before it goes on
      Facing turn;
      turn.mode = Facing::Mode::kSpin;
      turn.angle_rad = hand * random.uniform(1.8, 2.6);
      director.stand(who, random.uniform(0.8, 2.2), turn);
    }
    advance(box);
  }

 private:
  struct Box {
    std::array<Vector2d, 4> corners;
    std::size_t next = 0;
    bool clockwise = false;
  };
  static void advance(Box& box) { box.next = (box.next + (box.clockwise ? 3 : 1)) % 4; }
  std::array<Box, 3> boxes_;
};

/// Thesis table 3.1, "Lab 3 Targets": people cross each other's ways all the time; every now and
/// then two stop and interact, while the third one walks around them.
class ThreeTargets final : public Scenario {
 public:
  void begin(Director& director) override { spread(director, 3, ClothingStyle::kAny); }

  void idle(Director& director, std::size_t who) override {
    if (director.now_s() > next_meeting_s_ && meet_someone(director, who, 2.5, 5.0)) {
      next_meeting_s_ = director.now_s() + director.random().uniform(6.0, 9.0);
      return;
    }
    cross(director, who, 1.0, 1.4, 0.5);
    if (director.random().chance(0.25)) {
      director.stand(who, director.random().uniform(0.3, 1.5));
    }
  }

 private:
  double next_meeting_s_ = 1.0;
};

/// Thesis table 3.1, "Lab 4 Targets - Crossing": most of them in very dark clothes, all of them on
/// ways that cross near the middle of the area.
class FourCrossing final : public Scenario {
 public:
  void begin(Director& director) override {
    spread(director, 4, ClothingStyle::kDark);
    for (std::size_t who = 0; who < 4; ++who) {
      director.set_space(who, director.random().uniform(0.20, 0.26));  // they almost touch
    }
    if (director.random().chance(0.5)) {
      director.member(director.random().index(4)).style = ClothingStyle::kAny;
    }
  }

  void idle(Director& director, std::size_t who) override {
    Random& random = director.random();
    if (random.chance(0.06) && meet_someone(director, who, 1.0, 2.0)) {
      return;
    }
    cross(director, who, 0.9, 1.45, 0.2);
    if (random.chance(0.1)) {
      director.stand(who, random.uniform(0.2, 1.0));
    }
  }
};

}  // namespace

std::unique_ptr<Scenario> make_boxmotion(int /*people*/) { return std::make_unique<Boxmotion>(); }
std::unique_ptr<Scenario> make_three_targets(int /*people*/) {
  return std::make_unique<ThreeTargets>();
}
std::unique_ptr<Scenario> make_crossing(int /*people*/) { return std::make_unique<FourCrossing>(); }

}  // namespace plaza::synthetic
