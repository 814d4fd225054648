// How the director lets people meet: gathering, phases, parting.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plaza/geometry/angle.h"
#include "plugins/sources/synthetic/world/director.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;

constexpr double kPatienceS = 14;  // how long people wait for someone who doesn't come

Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

ActKind resting_posture(Random& random) {
  constexpr ActKind kPostures[] = {ActKind::kArmsCrossed, ActKind::kHandsOnHips,
                                   ActKind::kHandsInPockets, ActKind::kHandsBehind,
                                   ActKind::kPhone};
  return kPostures[random.index(std::size(kPostures))];
}

void Director::meet(Meeting plan) {
  Running meeting;
  meeting.group = static_cast<int>(meetings_.size());
  meeting.called_s = now_s_;
  for (const std::size_t who : plan.who) {
    drop_orders(who);
    Order order;
    order.kind = Order::Kind::kMeet;
    order.meeting = meetings_.size();
    order.facing = {Facing::Mode::kMotion, 0, plan.center_m, 0};
    orders_[who].push_back(order);
  }
  meeting.plan = std::move(plan);
  meetings_.push_back(std::move(meeting));
}

/// Between opposite members (pairs: between the two).
double Director::distance_of(const Running& meeting) const {
  if (meeting.plan.who.size() > 2) {
    // neighbours in the circle stand 1.05 m apart
    return 1.05 / std::sin(std::numbers::pi / static_cast<double>(meeting.plan.who.size()));
  }
  if (!meeting.begun) {
    return 0.92;  // whatever they are going to do, first they stand before each other
  }
  switch (meeting.plan.phases[meeting.phase].kind) {
    case Phase::Kind::kHug:
      return 0.36;
    case Phase::Kind::kHandshake:
      return 0.66;
    case Phase::Kind::kTalk:
    case Phase::Kind::kRest:
      return 0.92;
  }
  return 0.92;
}

void Director::place_members(Running& meeting) {
  const auto count = static_cast<double>(meeting.plan.who.size());
  if (!meeting.begun && meeting.plan.who.size() == 2) {
    // two who are about to meet do so where they are, not around each other
    const Vector2d first = crowd_.walkers[meeting.plan.who[0]].position;
    const Vector2d second = crowd_.walkers[meeting.plan.who[1]].position;
    const Vector2d apart = first - second;
    if (apart.norm() < 1.6) {
      meeting.plan.center_m = free_near((first + second) / 2);
      meeting.plan.angle_rad = std::atan2(apart.y(), apart.x());
    }
  }
  const double radius = distance_of(meeting) / 2;
  for (std::size_t k = 0; k < meeting.plan.who.size(); ++k) {
    const std::size_t who = meeting.plan.who[k];
    Walker& walker = crowd_.walkers[who];
    const double angle = meeting.plan.angle_rad + meeting.turned_rad +
                         2 * std::numbers::pi * static_cast<double>(k) / count;
    const Vector2d place = meeting.plan.center_m + radius * direction(angle);
    if (!meeting.begun && (place - walker.position).norm() > 0.8) {
      if (walker.way.empty() || (walker.way.back() - place).norm() > 0.2) {
        walker.way = routes_.find(walker.position, place);
      }
    } else {
      walker.way = {place};
    }
    const bool near = (meeting.plan.center_m - walker.position).norm() < radius + 0.7;
    walker.speed = !meeting.begun ? (near ? 0.7 : meeting.plan.approach_mps) : 0.45;
    walker.facing = {near ? Facing::Mode::kPoint : Facing::Mode::kMotion, 0, meeting.plan.center_m,
                     0};
    if (near && meeting.plan.who.size() == 2) {
      walker.facing.mode = Facing::Mode::kPerson;
      walker.facing.person = meeting.plan.who[1 - k];
    }
    walker.group = meeting.group;
    walker.group_distance_m = std::min(0.6, 2 * radius);
    walker.settled = near;
  }
}

void Director::advance_meeting(Running& meeting) {
  const auto& members = meeting.plan.who;
  if (std::any_of(members.begin(), members.end(),
                  [&](std::size_t who) { return !is_present(who) || !is_meeting(who); })) {
    end_meeting(meeting);
    return;
  }
  place_members(meeting);
  if (!meeting.begun) {
    const bool gathered = std::all_of(members.begin(), members.end(), [&](std::size_t who) {
      const Walker& walker = crowd_.walkers[who];
      const Vector2d to = meeting.plan.center_m - walker.position;
      const double off = angle_difference(std::atan2(to.y(), to.x()), walker.heading);
      return walker.way.size() == 1 && (walker.way.back() - walker.position).norm() < 0.16 &&
             std::abs(off) < 0.35;
    });
    if (gathered) {
      meeting.begun = true;
      meeting.begun_s = meeting.phase_begun_s = now_s_;
      begin_phase(meeting);
    } else if (now_s_ - meeting.called_s > kPatienceS) {
      end_meeting(meeting);
    }
    return;
  }
  double total = 0;
  for (const Phase& phase : meeting.plan.phases) {
    total += phase.seconds;
  }
  meeting.turned_rad = meeting.plan.circle_rad * std::min(1.0, (now_s_ - meeting.begun_s) / total);
  if (now_s_ - meeting.phase_begun_s < meeting.plan.phases[meeting.phase].seconds) {
    return;
  }
  if (meeting.phase + 1 == meeting.plan.phases.size()) {
    end_meeting(meeting);
    return;
  }
  ++meeting.phase;
  meeting.phase_begun_s = now_s_;
  begin_phase(meeting);
}

void Director::begin_phase(Running& meeting) {
  const Phase& phase = meeting.plan.phases[meeting.phase];
  const auto& members = meeting.plan.who;
  const double begin = now_s_ + 0.1;
  const double end = now_s_ + phase.seconds;
  const auto add = [&](std::size_t who, ActKind kind, double from, double to, std::uint64_t seed,
                       std::size_t partner) {
    open_.at(who).acts.push_back({kind, from, to, seed, partner});
  };
  switch (phase.kind) {
    case Phase::Kind::kHandshake:
    case Phase::Kind::kHug: {
      const ActKind kind = phase.kind == Phase::Kind::kHug ? ActKind::kHug : ActKind::kHandshake;
      const std::uint64_t seed = random_.next();
      add(members[0], kind, begin, end, seed, members[1]);
      add(members[1], kind, begin, end, seed, members[0]);
      break;
    }
    case Phase::Kind::kTalk:
      // speakers take turns; listeners hold their arms somehow
      for (double t = begin; t < end - 1.0;) {
        const double turn_s = std::min(end - t, random_.uniform(2.0, 4.5));
        const std::size_t speaker = random_.index(members.size());
        add(members[speaker], ActKind::kGesture, t, t + turn_s, random_.next(), members[speaker]);
        t += turn_s;
      }
      break;
    case Phase::Kind::kRest:
      for (const std::size_t who : members) {
        if (random_.chance(0.6)) {
          add(who, resting_posture(random_), begin, end, random_.next(), who);
        }
      }
      break;
  }
}

void Director::break_off_acts(std::size_t who) {
  const auto stay = open_.find(who);
  if (stay == open_.end()) {
    return;
  }
  constexpr double kLettingGoS = 0.6;  // the time in which an act is blended out
  std::erase_if(stay->second.acts, [&](const Stay::StayAct& act) { return act.begin_s >= now_s_; });
  for (Stay::StayAct& act : stay->second.acts) {
    act.end_s = std::min(act.end_s, std::max(now_s_, act.begin_s + kLettingGoS) + kLettingGoS);
  }
}

void Director::end_meeting(Running& meeting) {
  meeting.over = true;
  for (const std::size_t who : meeting.plan.who) {
    Walker& walker = crowd_.walkers[who];
    if (walker.group == meeting.group) {
      walker.group = -1;
      walker.settled = false;
    }
    break_off_acts(who);
  }
}

}  // namespace plaza::synthetic
