#include "plugins/sources/synthetic/world/crowd.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "plaza/geometry/angle.h"

namespace plaza::synthetic {
namespace {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;

constexpr double kHorizonS = 3.0;         // collisions later than this don't matter yet
constexpr double kReactionS = 0.28;       // time constant with which a velocity is taken up
constexpr double kMaxAcceleration = 2.8;  // m/s^2
constexpr std::size_t kTicksPerDecision = 4;
constexpr double kBodyHalfWidth = 0.26;

/// Seconds until two discs touch; infinity when they don't.
double time_to_contact(const Vector2d& offset, const Vector2d& closing, double radius) {
  const double c = offset.squaredNorm() - radius * radius;
  const double b = offset.dot(closing);
  const double a = closing.squaredNorm();
  const double root = b * b - a * c;
  if (b <= 0 || root < 0 || a < 1e-9) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max(0.0, (b - std::sqrt(root)) / a);
}

/// People walk slower sideways and backwards than forwards.
double speed_limit(double off_heading) {
  const double off = std::abs(off_heading);
  if (off < 0.6) {
    return 10.0;
  }
  return std::max(0.75, 1.5 - 0.6 * (off - 0.6));
}

}  // namespace

Vector2d Crowd::wanted_velocity(const Walker& walker) const {
  if (walker.way.empty()) {
    return Vector2d::Zero();
  }
  const Vector2d to = walker.way.front() - walker.position;
  const double distance = to.norm();
  double speed = walker.speed;
  if (walker.way.size() == 1) {
    speed = distance < 0.04 ? 0.0 : std::min(speed, std::sqrt(2 * 0.7 * distance));
  }
  if (walker.facing.mode != Facing::Mode::kMotion || walker.facing.angle_rad != 0) {
    const double moving = std::atan2(to.y(), to.x());
    speed = std::min(speed, speed_limit(angle_difference(moving, walker.heading)));
  }
  return distance < 1e-6 ? Vector2d(Vector2d::Zero()) : Vector2d(to / distance * speed);
}

double Crowd::obstruction(const Walker& walker, const Vector2d& point) const {
  double depth = 0;
  for (const Furniture& thing : stage_->furniture) {
    depth = std::max(depth, kBodyHalfWidth - thing.footprint.distance(point));
  }
  if (walker.confined) {
    depth = std::max(depth, stage_->area.grown(-0.12).distance(point));
  } else if (stage_->walls) {
    double outside = stage_->walls->grown(-0.28).distance(point);
    for (const Door& door : stage_->doors) {
      const Vector2d from = point - door.center_m;
      const double through = from.dot(door.inward);
      const double aside = std::abs(from.dot(Vector2d(-door.inward.y(), door.inward.x())));
      if (through < -0.5) {
        outside = 0;  // the corridor behind is wide
      } else if (through < 0.5) {
        outside = std::min(outside, std::max(0.0, aside - (door.width_m / 2 - 0.28)));
      }
    }
    depth = std::max(depth, outside);
  }
  return std::max(depth, 0.0);
}

double Crowd::cost(std::size_t who, const Vector2d& velocity, const Vector2d& wanted) const {
  const Walker& self = walkers[who];
  double total = (velocity - wanted).norm() + 0.25 * (velocity - self.velocity).norm();
  // a slight preference for passing on the right hand's side
  const double leftward = wanted.x() * velocity.y() - wanted.y() * velocity.x();
  total += leftward > 1e-6 ? 0.03 : 0.0;
  for (std::size_t j = 0; j < walkers.size(); ++j) {
    const Walker& other = walkers[j];
    if (j == who || !other.present) {
      continue;
    }
    const Vector2d offset = other.position - self.position;
    const double distance = offset.norm();
    const bool together = self.group >= 0 && self.group == other.group;
    const double space = together ? self.group_distance_m - 0.05 : self.space_m + other.space_m;
    if (distance > space + 5.0) {
      continue;
    }
    // who walks shares the avoiding; who stands leaves it to the others
    const Vector2d closing = other.settled || together
                                 ? Vector2d(velocity - other.velocity)
                                 : Vector2d(2 * velocity - self.velocity - other.velocity);
    if (distance < space) {
      const double intrusion = (space - distance) / space;
      total +=
          2.5 * intrusion + 2.5 * std::max(0.0, offset.dot(closing) / std::max(distance, 1e-6));
      continue;
    }
    const double contact = time_to_contact(offset, closing, space);
    if (contact < kHorizonS) {
      total += 0.9 * (1 / (contact + 0.12) - 1 / (kHorizonS + 0.12));
    }
  }
  const double now = obstruction(self, self.position);
  for (const double ahead : {0.25, 0.5, 0.9, 1.4}) {
    const double depth = obstruction(self, self.position + ahead * velocity) - now;
    if (depth > 0) {
      total += std::min(2.0, 0.4 + 6 * depth) / (ahead + 0.1);
    }
  }
  return total;
}

void Crowd::decide(std::size_t who) {
  Walker& self = walkers[who];
  const Vector2d wanted = wanted_velocity(self);
  Vector2d best = wanted;
  double least = cost(who, wanted, wanted);
  const auto consider = [&](const Vector2d& velocity) {
    const double value = cost(who, velocity, wanted);
    if (value < least - 1e-9) {
      least = value;
      best = velocity;
    }
  };
  consider(Vector2d::Zero());
  consider(self.velocity);
  const double speed = std::max(wanted.norm(), self.settled ? 0.25 : 0.5);
  const Vector2d along = wanted.norm() > 1e-6
                             ? Vector2d(wanted.normalized())
                             : Vector2d(std::cos(self.heading), std::sin(self.heading));
  for (const double degrees : {-8.0, 8.0, -18.0, 18.0, -30.0, 30.0, -45.0, 45.0, -65.0, 65.0, -90.0,
                               90.0, -125.0, 125.0, 180.0}) {
    const Vector2d turned = Rotation2Dd(radians_from_degrees(degrees)) * along;
    for (const double share : {1.1, 0.85, 0.6, 0.35}) {
      consider(share * speed * turned);
    }
  }
  consider(0.7 * wanted);
  consider(0.4 * wanted);
  self.wish = best;
}

void Crowd::turn(Walker& walker) const {
  double wanted = walker.heading;
  double urge = 1.0;
  const double speed = walker.velocity.norm();
  switch (walker.facing.mode) {
    case Facing::Mode::kMotion:
      if (speed > 0.12) {
        wanted = std::atan2(walker.velocity.y(), walker.velocity.x()) + walker.facing.angle_rad;
        urge = std::min(1.0, 0.3 + speed);
      }
      break;
    case Facing::Mode::kPoint: {
      const Vector2d to = walker.facing.point_m - walker.position;
      wanted = std::atan2(to.y(), to.x());
      break;
    }
    case Facing::Mode::kPerson: {
      const Vector2d to = walkers[walker.facing.person].position - walker.position;
      wanted = std::atan2(to.y(), to.x());
      break;
    }
    case Facing::Mode::kFixed:
      wanted = walker.facing.angle_rad;
      break;
    case Facing::Mode::kSpin: {
      const double change = 4.0 * (walker.facing.angle_rad - walker.yaw_rate);
      walker.yaw_rate += std::clamp(change, -8.0, 8.0) * kTickS;
      walker.heading += walker.yaw_rate * kTickS;
      return;
    }
  }
  // a damped spring with the limits of a body that turns by steps
  const double error = angle_difference(wanted, walker.heading);
  const double acceleration = urge * 14.0 * error - 6.5 * walker.yaw_rate;
  walker.yaw_rate += std::clamp(acceleration, -12.0, 12.0) * kTickS;
  walker.yaw_rate = std::clamp(walker.yaw_rate, -3.2, 3.2);
  walker.heading += walker.yaw_rate * kTickS;
}

void Crowd::push_apart() {
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    for (std::size_t j = i + 1; j < walkers.size(); ++j) {
      Walker& a = walkers[i];
      Walker& b = walkers[j];
      if (!a.present || !b.present) {
        continue;
      }
      const bool together = a.group >= 0 && a.group == b.group;
      const double least =
          together ? std::min(kBodyDistance, a.group_distance_m - 0.04) : kBodyDistance;
      const Vector2d offset = b.position - a.position;
      const double distance = offset.norm();
      // felt before bodies touch, and stronger the nearer they are
      const double felt = least + 0.07;
      if (distance >= felt) {
        continue;
      }
      const Vector2d normal = distance > 1e-6 ? Vector2d(offset / distance) : Vector2d(1, 0);
      const double closing = (a.velocity - b.velocity).dot(normal);
      const double push = 40.0 * (felt - distance) + 8.0 * std::max(0.0, closing);
      a.velocity -= 0.5 * push * kTickS * normal;
      b.velocity += 0.5 * push * kTickS * normal;
      if (distance < least) {
        const double step = std::min(0.25 * (least - distance), 0.004);
        a.position -= step * normal;
        b.position += step * normal;
      }
    }
  }
}

void Crowd::tick() {
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    Walker& walker = walkers[i];
    if (!walker.present) {
      continue;
    }
    while (walker.way.size() > 1 && (walker.way.front() - walker.position).norm() < 0.35) {
      walker.way.erase(walker.way.begin());
    }
    // not all at the same moment
    if ((ticks_ + i) % kTicksPerDecision == 0) {
      decide(i);
    }
  }
  for (Walker& walker : walkers) {
    if (!walker.present) {
      continue;
    }
    Vector2d change = (walker.wish - walker.velocity) / kReactionS;
    if (change.norm() > kMaxAcceleration) {
      change *= kMaxAcceleration / change.norm();
    }
    walker.velocity += change * kTickS;
  }
  push_apart();
  for (Walker& walker : walkers) {
    if (!walker.present) {
      continue;
    }
    walker.position += walker.velocity * kTickS;
    turn(walker);
  }
  ++ticks_;
}

}  // namespace plaza::synthetic
