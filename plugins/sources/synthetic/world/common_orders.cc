#include "plugins/sources/synthetic/world/common_orders.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plaza::synthetic {

using Eigen::Vector2d;

void spread(Director& director, int count, ClothingStyle style) {
  Random& random = director.random();
  const Rectangle floor = director.floor();
  const double first = random.uniform(0, 2 * std::numbers::pi);
  for (int i = 0; i < count; ++i) {
    const std::size_t who = director.engage(style);
    // on an ellipse, with some freedom
    const double angle = first + 2 * std::numbers::pi * (i + random.uniform(-0.2, 0.2)) / count;
    const double share = random.uniform(0.30, 0.40);
    const Vector2d place =
        director.free_near(floor.center() + share * Vector2d(floor.size().x() * std::cos(angle),
                                                             floor.size().y() * std::sin(angle)));
    director.appear(who, place, random.uniform(-std::numbers::pi, std::numbers::pi));
  }
}

void cross(Director& director, std::size_t who, double slowest_mps, double fastest_mps,
           double scatter_m) {
  Random& random = director.random();
  const Rectangle floor = director.floor();
  const Vector2d through = floor.center() + Vector2d(random.uniform(-scatter_m, scatter_m),
                                                     random.uniform(-scatter_m, scatter_m));
  Vector2d along = through - director.walker(who).position;
  if (along.norm() < 0.3) {
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
    along = Vector2d(std::cos(angle), std::sin(angle));
  }
  // as far on the other side as the floor allows, turned a little
  const double bend = random.uniform(-0.6, 0.6);
  const Vector2d onward = Eigen::Rotation2Dd(bend) * along.normalized();
  const double reach = random.uniform(0.34, 0.46);
  const Vector2d target = through + onward.cwiseProduct(reach * floor.size());
  director.go(who, director.free_near(target), random.uniform(slowest_mps, fastest_mps));
}

std::vector<Phase> greeting(Random& random, double seconds) {
  const double choice = random.unit();
  const double first = std::max(1.5, seconds * random.uniform(0.4, 0.6));
  const double rest = std::max(1.2, seconds - first);
  if (choice < 0.40) {
    return {{Phase::Kind::kHandshake, first}, {Phase::Kind::kTalk, rest}};
  }
  if (choice < 0.70 && seconds > 3) {  // an embrace takes its time
    return {{Phase::Kind::kHug, first}, {Phase::Kind::kTalk, rest}};
  }
  return {{Phase::Kind::kTalk, first + rest}};
}

bool meet_someone(Director& director, std::size_t who, double shortest_s, double longest_s) {
  Random& random = director.random();
  const Vector2d here = director.walker(who).position;
  std::size_t nearest = director.people();
  double least = 1e9;
  for (std::size_t other = 0; other < director.people(); ++other) {
    if (other == who || !director.is_present(other) || director.is_meeting(other) ||
        director.is_leaving(other) || !director.walker(other).confined) {
      continue;
    }
    const double distance =
        (director.walker(other).position - here).norm() * random.uniform(0.7, 1.3);
    if (distance < least) {
      least = distance;
      nearest = other;
    }
  }
  if (nearest == director.people()) {
    return false;
  }
  const Vector2d there = director.walker(nearest).position;
  Meeting meeting;
  meeting.who = {who, nearest};
  const Rectangle inner = director.floor().grown(-0.7);
  meeting.center_m =
      director.free_near(((here + there) / 2).cwiseMax(inner.low).cwiseMin(inner.high));
  meeting.angle_rad = std::atan2((here - there).y(), (here - there).x());
  meeting.circle_rad = random.uniform(-0.5, 0.5);
  meeting.approach_mps = random.uniform(1.0, 1.3);
  meeting.phases = greeting(random, random.uniform(shortest_s, longest_s));
  director.meet(std::move(meeting));
  return true;
}

void roam(Director& director, std::size_t who, double slowest_mps, double fastest_mps,
          double longest_stand_s) {
  Random& random = director.random();
  director.go(who, director.free_place(0.4, who), random.uniform(slowest_mps, fastest_mps));
  if (!random.chance(0.6)) {
    return;
  }
  const double seconds = random.uniform(0.3, longest_stand_s);
  Facing facing;
  if (random.chance(0.5)) {
    // turns to something of interest
    facing.mode = Facing::Mode::kPoint;
    facing.point_m = director.free_place(0.0, who);
  }
  director.stand(who, seconds, facing);
}

}  // namespace plaza::synthetic
