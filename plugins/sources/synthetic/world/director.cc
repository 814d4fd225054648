#include "plugins/sources/synthetic/world/director.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "plaza/geometry/angle.h"
#include "plugins/sources/synthetic/people/proportions.h"

namespace plaza::synthetic {

using Eigen::Vector2d;

namespace {

Rectangle walkable(const Stage& stage) {
  return stage.walls ? *stage.walls : stage.area.grown(10.0);
}

}  // namespace

Director::Director(const Stage& stage, std::uint64_t seed, double start_s)
    : stage_(stage),
      random_(mix(seed, 0x706c616e)),
      start_s_(start_s),
      now_s_(start_s),
      routes_(stage.furniture, walkable(stage)),
      crowd_(stage_) {}

bool Director::is_meeting(std::size_t who) const {
  return !orders_[who].empty() && orders_[who].front().kind == Order::Kind::kMeet;
}

bool Director::is_leaving(std::size_t who) const {
  return std::any_of(orders_[who].begin(), orders_[who].end(),
                     [](const Order& order) { return order.kind == Order::Kind::kLeave; });
}

std::size_t Director::count_claiming() const {
  std::size_t count = 0;
  for (std::size_t who = 0; who < crowd_.walkers.size(); ++who) {
    const Walker& walker = crowd_.walkers[who];
    const bool gone = is_leaving(who) && stage_.area.distance(walker.position) > 0.1;
    count += walker.present && !gone ? 1 : 0;
  }
  return count;
}

Rectangle Director::floor() const {
  const Vector2d half = stage_.area.size().cwiseMin(Vector2d(12.0, 12.0)) / 2;
  return {stage_.area.center() - half, stage_.area.center() + half};
}

Vector2d Director::free_place(double margin_m, std::size_t except) {
  const Rectangle inside = floor().grown(-margin_m);
  Vector2d best = inside.center();
  double best_room = -1;
  for (int trial = 0; trial < 12; ++trial) {
    const Vector2d place(random_.uniform(inside.low.x(), inside.high.x()),
                         random_.uniform(inside.low.y(), inside.high.y()));
    if (!routes_.is_free(place)) {
      continue;
    }
    double room = 0.9;  // more than this is as good
    for (std::size_t j = 0; j < crowd_.walkers.size(); ++j) {
      if (j != except && crowd_.walkers[j].present) {
        const Walker& other = crowd_.walkers[j];
        const Vector2d at = other.way.empty() ? other.position : other.way.back();
        room = std::min(room, (at - place).norm());
      }
    }
    if (room > best_room) {
      best_room = room;
      best = place;
    }
  }
  return best;
}

Vector2d Director::free_near(const Vector2d& wish) const {
  const Rectangle inside = floor().grown(-0.3);
  const Vector2d wished = wish.cwiseMax(inside.low).cwiseMin(inside.high);
  for (double radius = 0; radius < 3; radius += 0.15) {
    for (int k = 0; k < 12; ++k) {
      const double angle = k * std::numbers::pi / 6;
      const Vector2d place = wished + radius * Vector2d(std::cos(angle), std::sin(angle));
      if (inside.contains(place) && routes_.is_free(place)) {
        return place;
      }
    }
  }
  return wished;
}

std::size_t Director::engage(ClothingStyle style) {
  const std::uint64_t key = random_.next();
  CastMember member;
  member.proportions = draw_proportions(key);
  member.looks_seed = key;
  member.clothing_key = mix(key, 1);
  member.style = style;
  member.bag = random_.chance(0.25);
  cast_.push_back(member);
  Walker walker;
  walker.space_m = random_.uniform(0.27, 0.34);
  crowd_.walkers.push_back(walker);
  orders_.emplace_back();
  return cast_.size() - 1;
}

void Director::appear(std::size_t who, const Vector2d& position_m, double heading_rad) {
  Walker& walker = crowd_.walkers[who];
  walker.present = true;
  walker.position = position_m;
  walker.velocity = walker.wish = Vector2d::Zero();
  walker.heading = heading_rad;
  walker.yaw_rate = 0;
  walker.way.clear();
  walker.confined = stage_.area.contains(position_m);
  Stay stay;
  stay.person = who;
  stay.start_s = now_s_;
  open_.insert_or_assign(who, std::move(stay));
}

void Director::enter(std::size_t who, std::size_t door, double speed_mps) {
  const Door& from = stage_.doors[door];
  const Vector2d place = from.hidden_place();
  const Vector2d first = stage_.walls ? Vector2d(from.center_m - 0.9 * from.inward) : from.center_m;
  const Vector2d to = first - place;
  const Vector2d facing = to.norm() > 0.1 ? to : from.inward;
  appear(who, place, std::atan2(facing.y(), facing.x()));
  if (stage_.walls) {
    go(who, first, speed_mps);
    orders_[who].back().exact = false;
    go(who, from.center_m + 0.5 * from.inward, speed_mps);
    orders_[who].back().exact = false;
  }
  // well into the area, where it is confined from then on
  const double depth = (stage_.walls ? 1.5 : stage_.area.distance(from.center_m) + 1.0);
  go(who, free_near(from.center_m + depth * from.inward), speed_mps);
  orders_[who].back().exact = false;
}

void Director::leave(std::size_t who, std::size_t door, double speed_mps) {
  const Door& to = stage_.doors[door];
  if (stage_.walls) {
    go(who, to.center_m + 0.6 * to.inward, speed_mps);
    orders_[who].back().exact = false;
    orders_[who].back().door = door + 1;
    go(who, to.center_m - 0.9 * to.inward, speed_mps);
    orders_[who].back().exact = false;
    orders_[who].back().door = door + 1;
  }
  Order order;
  order.kind = Order::Kind::kLeave;
  order.to_m = to.hidden_place();
  order.speed_mps = speed_mps;
  order.door = door + 1;
  orders_[who].push_back(order);
}

void Director::go(std::size_t who, const Vector2d& to_m, double speed_mps, Facing facing) {
  Order order;
  order.kind = Order::Kind::kGo;
  order.to_m = to_m;
  order.speed_mps = speed_mps;
  order.facing = std::move(facing);
  orders_[who].push_back(order);
}

void Director::stand(std::size_t who, double seconds, Facing facing) {
  Order order;
  order.kind = Order::Kind::kStand;
  order.seconds = seconds;
  order.facing = std::move(facing);
  orders_[who].push_back(order);
}

void Director::act(std::size_t who, ActKind kind, double seconds) {
  const auto stay = open_.find(who);
  if (stay != open_.end()) {
    stay->second.acts.push_back({kind, now_s_, now_s_ + seconds, random_.next(), who});
  }
}

void Director::later(double at_s, std::function<void()> what) {
  appointments_.emplace(at_s, std::move(what));
}

void Director::drop_orders(std::size_t who) {
  orders_[who].clear();
  break_off_acts(who);
}

void Director::begin_order(std::size_t who, Order& order) {
  order.begun_s = now_s_;
  Walker& walker = crowd_.walkers[who];
  walker.facing = order.facing;
  walker.settled = order.kind == Order::Kind::kStand;
  switch (order.kind) {
    case Order::Kind::kGo:
    case Order::Kind::kLeave:
      walker.speed = order.speed_mps;
      if (order.door > 0) {
        walker.confined = false;
      }
      walker.way = routes_.find(walker.position, order.to_m);
      break;
    case Order::Kind::kStand:
      walker.way = {walker.position};
      if (order.seconds > 1.2 && random_.chance(0.4)) {
        act(who, resting_posture(random_), order.seconds);
      }
      break;
    case Order::Kind::kMeet:
      break;  // advance_meeting() moves it
  }
}

bool Director::is_done(std::size_t who, const Order& order) const {
  const Walker& walker = crowd_.walkers[who];
  const double since = now_s_ - order.begun_s;
  switch (order.kind) {
    case Order::Kind::kGo: {
      const double distance = (order.to_m - walker.position).norm();
      const bool last = walker.way.size() <= 1;
      // who can't get there for a long time gives up
      return (last && distance < (order.exact ? 0.12 : 0.45)) ||
             since > 3 + 3 * distance / order.speed_mps + 6;
    }
    case Order::Kind::kStand:
      return since > order.seconds;
    case Order::Kind::kLeave:
      return (order.to_m - walker.position).norm() < 0.3;
    case Order::Kind::kMeet:
      return meetings_[order.meeting].over;
  }
  return true;
}

void Director::vanish(std::size_t who) {
  crowd_.walkers[who].present = false;
  orders_[who].clear();
  const auto stay = open_.find(who);
  finished_.push_back(std::move(stay->second));
  open_.erase(stay);
}

void Director::record() {
  for (auto& [who, stay] : open_) {
    stay.position_m.push_back(crowd_.walkers[who].position);
    stay.heading_rad.push_back(crowd_.walkers[who].heading);
  }
}

void Director::run(Scenario& scenario, double until_s) {
  scenario.begin(*this);
  record();
  while (now_s_ < until_s) {
    while (!appointments_.empty() && appointments_.begin()->first <= now_s_) {
      const std::function<void()> what = std::move(appointments_.begin()->second);
      appointments_.erase(appointments_.begin());
      what();
    }
    for (Running& meeting : meetings_) {
      if (!meeting.over) {
        advance_meeting(meeting);
      }
    }
    for (std::size_t who = 0; who < orders_.size(); ++who) {
      if (!crowd_.walkers[who].present) {
        continue;
      }
      auto& orders = orders_[who];
      if (!orders.empty() && orders.front().begun_s < -1e8) {
        begin_order(who, orders.front());
      }
      if (!orders.empty() && is_done(who, orders.front())) {
        if (orders.front().kind == Order::Kind::kLeave) {
          vanish(who);
          continue;
        }
        orders.pop_front();
      }
      Walker& walker = crowd_.walkers[who];
      if (!walker.confined && !is_leaving(who) &&
          stage_.area.grown(-0.25).contains(walker.position)) {
        walker.confined = true;
      }
      if (orders.empty()) {
        scenario.idle(*this, who);
      }
    }
    crowd_.tick();
    ++ticks_;
    now_s_ = start_s_ + static_cast<double>(ticks_) * Crowd::kTickS;
    record();
  }
}

std::vector<Stay> Director::take_stays() {
  for (auto& [who, stay] : open_) {
    finished_.push_back(std::move(stay));
  }
  open_.clear();
  std::stable_sort(finished_.begin(), finished_.end(), [](const Stay& a, const Stay& b) {
    return a.start_s < b.start_s || (a.start_s == b.start_s && a.person < b.person);
  });
  return std::move(finished_);
}

}  // namespace plaza::synthetic
