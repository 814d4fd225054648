#include "plugins/sources/synthetic/people/acts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plugins/sources/synthetic/people/random.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// The body's own directions on the ground, and points given by them.
struct Frame {
  Vector2d origin;
  Vector2d forward;
  Vector2d left;

  Frame(const Vector2d& at, double heading)
      : origin(at),
        forward(std::cos(heading), std::sin(heading)),
        left(-std::sin(heading), std::cos(heading)) {}
  Vector3d point(double ahead, double aside, double up) const {
    const Vector2d at = origin + ahead * forward + aside * left;
    return {at.x(), at.y(), up};
  }
};

void shake_hands(const Act& act, const Proportions& p, const Frame& own, double t,
                 ActGoals& goals) {
  const Vector2d other = act.partner.motion->position(t);
  const Vector2d towards = (other - own.origin).normalized();
  const Vector2d middle = (own.origin + other) / 2;
  const double height = 0.29 * (p.stature_m + act.partner.stature_m);
  // a few firm shakes, then hands rest in each other and move now and then
  const double since = t - act.begin_s - act.ramp_s;
  const double pumping =
      std::exp(-std::max(since, 0.0) / 1.5) + 0.5 * std::max(0.0, slow_wave(act.seed, t, 4.0));
  const double shake = 0.028 * pumping * std::sin(2 * std::numbers::pi * 2.1 * since);
  // palm to palm, each hand on its owner's right side
  const Vector2d right(towards.y(), -towards.x());
  const Vector2d wrist = middle - 0.5 * p.hand_m * towards + 0.015 * right;
  goals.hands[1].wrist_m = {wrist.x(), wrist.y(), height + shake};
  goals.hands[1].pointing = {towards.x(), towards.y(), 0};
  goals.hands[1].weight = 1;
  goals.lean_rad = 0.06;
}

void hug(const Act& act, const Proportions& p, const Frame& own, double t, ActGoals& goals) {
  const Vector2d other = act.partner.motion->position(t);
  const Vector2d towards = (other - own.origin).normalized();
  const Vector2d left(-towards.y(), towards.x());
  const double other_m = act.partner.stature_m;
  // the left arm goes over the shoulder, the right one around the ribs
  const Vector2d over = other + 0.13 * towards + 0.02 * left;
  const Vector2d around = other + 0.13 * towards - 0.06 * left;
  const double pat =
      0.02 * std::sin(2 * std::numbers::pi * 1.8 * t) * std::max(0.0, slow_wave(act.seed, t, 2.0));
  goals.hands[0] = {{over.x(), over.y(), 0.77 * other_m + pat}, Vector3d::Zero(), 1};
  goals.hands[1] = {
      {around.x(), around.y(), 0.66 * std::min(other_m, p.stature_m)}, Vector3d::Zero(), 1};
  goals.lean_rad = 0.10;
}

void gesture(const Act& act, const Proportions& p, const Frame& own, double t, ActGoals& goals) {
  const double h = p.stature_m;
  for (std::size_t side = 0; side < 2; ++side) {
    const double left = side == 0 ? 1.0 : -1.0;
    const std::uint64_t seed = mix(act.seed, side);
    // most talkers move one hand more than the other, and rest both now and then
    const double liveliness = side == act.seed % 2 ? 1.0 : 0.6;
    const double raised = smooth_step(0.5 + 1.6 * liveliness * slow_wave(mix(seed, 7), t, 3.5));
    goals.hands[side].wrist_m = own.point(0.27 + 0.08 * slow_wave(mix(seed, 1), t, 0.9),
                                          left * (0.18 + 0.10 * slow_wave(mix(seed, 2), t, 1.1)),
                                          h * (0.61 + 0.06 * slow_wave(mix(seed, 3), t, 0.8)));
    goals.hands[side].weight = raised;
  }
}

/// Both hands at mirrored places of the own body.
void hold(const Frame& own, double ahead, double aside, double up, ActGoals& goals) {
  goals.hands[0] = {own.point(ahead, aside, up), Vector3d::Zero(), 1};
  goals.hands[1] = {own.point(ahead, -aside, up), Vector3d::Zero(), 1};
}

}  // namespace

double slow_wave(std::uint64_t seed, double seconds, double period_s) {
  Random random(mix(seed, 0x77617665));
  double sum = 0;
  // three incommensurable periods; the weights add up to one
  constexpr double kWeights[] = {0.5, 0.3, 0.2};
  constexpr double kRatios[] = {1.0, 0.618, 0.414};
  for (int i = 0; i < 3; ++i) {
    const double period = period_s * kRatios[i] * random.uniform(0.85, 1.15);
    sum += kWeights[i] * std::sin(2 * std::numbers::pi * (seconds / period + random.unit()));
  }
  return sum;
}

ActGoals act_goals(const Act& act, const Proportions& p, const Vector2d& position_m,
                   double heading_rad, double seconds) {
  ActGoals goals;
  const double ramp_s = std::min(act.ramp_s, (act.end_s - act.begin_s) / 2);
  const double presence =
      smooth_step((seconds - act.begin_s) / ramp_s) * smooth_step((act.end_s - seconds) / ramp_s);
  if (presence <= 0) {
    return goals;
  }
  const Frame own(position_m, heading_rad);
  const double h = p.stature_m;
  const double wide = p.shoulder_width_m / 2;
  switch (act.kind) {
    case ActKind::kHandshake:
      shake_hands(act, p, own, seconds, goals);
      break;
    case ActKind::kHug:
      hug(act, p, own, seconds, goals);
      break;
    case ActKind::kGesture:
      gesture(act, p, own, seconds, goals);
      break;
    case ActKind::kArmsCrossed:
      goals.hands[0] = {own.point(0.19 * p.girth, -0.09, 0.655 * h), Vector3d::Zero(), 1};
      goals.hands[1] = {own.point(0.22 * p.girth, 0.10, 0.675 * h), Vector3d::Zero(), 1};
      break;
    case ActKind::kHandsOnHips:
      hold(own, 0.05, p.hip_width_m / 2 + 0.13 * p.girth, 0.57 * h, goals);
      break;
    case ActKind::kHandsInPockets:
      hold(own, 0.10 * p.girth, wide * 0.98, 0.535 * h, goals);
      break;
    case ActKind::kHandsBehind:
      hold(own, -0.17 * p.girth, 0.05, 0.52 * h, goals);
      break;
    case ActKind::kPhone:
      goals.hands[1] = {own.point(0.27, -0.06, 0.68 * h), Vector3d::Zero(), 1};
      goals.head_down_rad = 0.45;
      break;
  }
  for (HandGoal& hand : goals.hands) {
    hand.weight *= presence;
  }
  goals.lean_rad *= presence;
  goals.head_down_rad *= presence;
  return goals;
}

}  // namespace plaza::synthetic
