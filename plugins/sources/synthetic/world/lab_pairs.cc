// Scenarios of people who meet in pairs.

#include <cmath>
#include <numbers>

#include "plugins/sources/synthetic/world/scenarios.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;

Vector2d longer_axis(const Rectangle& floor) {
  return floor.size().x() > floor.size().y() ? Vector2d(1, 0) : Vector2d(0, 1);
}

/// Thesis table 3.1, "Lab 2 Targets": two people shake hands and talk, part for a moment, and meet
/// again.
class TwoTargets final : public Scenario {
 public:
  void begin(Director& director) override {
    const Rectangle floor = director.floor();
    const Vector2d along = longer_axis(floor);
    const Vector2d across(-along.y(), along.x());
    for (int i = 0; i < 2; ++i) {
      const double side = i == 0 ? -1.0 : 1.0;
      const std::size_t who = director.engage(ClothingStyle::kAny);
      const Vector2d place = director.free_near(
          floor.center() + side * 0.36 * floor.size().maxCoeff() * along +
          director.random().uniform(-0.3, 0.3) * floor.size().minCoeff() * across);
      director.appear(who, place, std::atan2(-side * along.y(), -side * along.x()));
    }
    // the first frames show them come
    for (std::size_t who = 0; who < 2; ++who) {
      director.stand(who, 10);
    }
    director.later(-0.3, [this, &director] { come_together(director); });
  }

  void idle(Director& director, std::size_t who) override {
    if (!director.is_meeting(1 - who) && apart_ > 0) {
      if (--apart_ == 0) {
        come_together(director);
        return;
      }
    }
    // each to a place of its own, until both have been there
    director.go(who, director.free_place(0.5, who), director.random().uniform(0.9, 1.3));
    director.stand(who, director.random().uniform(0.3, 1.0));
  }

 private:
  void come_together(Director& director) {
    Random& random = director.random();
    const Rectangle floor = director.floor();
    Meeting meeting;
    meeting.who = {0, 1};
    meeting.center_m = director.free_near(floor.center() +
                                          Vector2d(random.uniform(-0.15, 0.15) * floor.size().x(),
                                                   random.uniform(-0.15, 0.1) * floor.size().y()));
    const Vector2d from = director.walker(0).position - meeting.center_m;
    meeting.angle_rad = std::atan2(from.y(), from.x());
    meeting.circle_rad = random.uniform(-0.9, 0.9);
    meeting.phases = {{Phase::Kind::kHandshake, random.uniform(4.5, 6.0)},
                      {Phase::Kind::kTalk, random.uniform(2.5, 3.5)},
                      {Phase::Kind::kHandshake, random.uniform(2.5, 4.0)},
                      {Phase::Kind::kTalk, random.uniform(1.2, 2.0)}};
    apart_ = 3;
    director.meet(std::move(meeting));
  }

  int apart_ = 0;  // how many times someone has to be idle before they meet again
};

/// Two pairs in the same clothing: the two of a pair meet, embrace, talk and circle around each
/// other by about a quarter turn, then either goes on to where the other one came from, or back.
/// Neither place nor looks tell which.
class Twins final : public Scenario {
 public:
  void begin(Director& director) override {
    const Rectangle floor = director.floor();
    for (std::size_t pair = 0; pair < 2; ++pair) {
      const double side = pair == 0 ? -1.0 : 1.0;
      Pair& two = pairs_[pair];
      const Vector2d along = longer_axis(floor);
      two.center = floor.center() + side * 0.24 * floor.size().maxCoeff() * along +
                   director.random().uniform(-0.3, 0.3) * Vector2d(-along.y(), along.x());
      const double angle = std::atan2(along.y(), along.x()) +
                           director.random().uniform(0.25, 0.75) * std::numbers::pi;
      const Vector2d offset = 1.25 * Vector2d(std::cos(angle), std::sin(angle));
      two.homes = {director.free_near(two.center - offset),
                   director.free_near(two.center + offset)};
      for (std::size_t k = 0; k < 2; ++k) {
        const std::size_t who = director.engage(ClothingStyle::kAny);
        director.appear(who, two.homes[k], k == 0 ? angle : angle + std::numbers::pi);
        director.member(who).bag = false;
      }
      // alike in all that can be seen from the ceiling
      director.member(2 * pair + 1) = director.member(2 * pair);
      director.stand(2 * pair, 2.1 + 0.6 * static_cast<double>(pair));
      director.stand(2 * pair + 1, 2.1 + 0.6 * static_cast<double>(pair));
    }
  }

  void idle(Director& director, std::size_t who) override {
    Pair& two = pairs_[who / 2];
    Random& random = director.random();
    if (two.met) {
      // the meeting is over: both leave it
      two.met = false;
      const bool swap = random.chance(0.5);
      if (swap) {
        std::swap(two.homes[0], two.homes[1]);
      }
      for (std::size_t k = 0; k < 2; ++k) {
        director.go(2 * (who / 2) + k, two.homes[k], random.uniform(0.9, 1.2));
        director.stand(2 * (who / 2) + k, random.uniform(0.6, 1.2));
      }
      return;
    }
    if (++two.waiting < 2) {
      director.stand(who, 30.0);  // until the other one is back
      return;
    }
    two.waiting = 0;
    two.met = true;
    Meeting meeting;
    meeting.who = {2 * (who / 2), 2 * (who / 2) + 1};
    meeting.center_m = two.center;
    const Vector2d from = two.homes[0] - two.center;
    meeting.angle_rad = std::atan2(from.y(), from.x());
    meeting.circle_rad = (random.chance(0.5) ? 1 : -1) * random.uniform(1.3, 1.8);
    meeting.approach_mps = 1.1;
    meeting.phases = {{Phase::Kind::kHug, random.uniform(3.0, 4.5)},
                      {Phase::Kind::kHandshake, random.uniform(2.0, 3.0)},
                      {Phase::Kind::kTalk, random.uniform(1.0, 2.0)}};
    director.meet(std::move(meeting));
  }

 private:
  struct Pair {
    Vector2d center = Vector2d::Zero();
    std::array<Vector2d, 2> homes;
    bool met = false;
    int waiting = 0;
  };
  std::array<Pair, 2> pairs_;
};

}  // namespace

std::unique_ptr<Scenario> make_two_targets(int /*people*/) {
  return std::make_unique<TwoTargets>();
}
std::unique_ptr<Scenario> make_twins(int /*people*/) { return std::make_unique<Twins>(); }

}  // namespace plaza::synthetic
