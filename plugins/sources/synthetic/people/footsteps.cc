#include "plugins/sources/synthetic/people/footsteps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plaza/geometry/angle.h"
#include "plugins/sources/synthetic/people/random.h"
#include "plugins/sources/synthetic/people/skeleton.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d direction(double yaw) { return {std::cos(yaw), std::sin(yaw)}; }

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 + x * (6 * x - 15));
}

/// 0 up to `low`, 1 from `high` on.
double ramp(double value, double low, double high) {
  return std::clamp((value - low) / (high - low), 0.0, 1.0);
}

/// Rhythm of the steps at a speed.
struct Rhythm {
  double step_s;    ///< from lifting one foot to lifting the other
  double swing_s;   ///< a foot is in the air for
  double stance_s;  ///< and then on the ground for
  double running;
};

/// Cadence grows with the square root of speed (Grieve and Gear 1966), and shorter legs step
/// faster; a walking foot is in the air for 40 % of its cycle, a running one for 65 %.
Rhythm rhythm(double speed, double leg_m) {
  const double running = ramp(speed, 2.0, 2.5);
  const double walking_hz = std::clamp(1.66 * std::sqrt(speed * 0.86 / leg_m), 1.5, 2.35);
  const double running_hz = (2.35 + 0.15 * speed) * std::sqrt(0.86 / leg_m);
  const double step_s = 1 / (walking_hz + running * (running_hz - walking_hz));
  const double swing_s = step_s * (0.8 + 0.5 * running);
  return {step_s, swing_s, 2 * step_s - swing_s, running};
}

/// How far the foot pitches when it leaves the ground and when it comes down, for a step that goes
/// `forward_m` in the foot's own direction; backwards the toes come down first.
double lift_pitch(double forward_m, double running) {
  return (0.62 + 0.3 * running) * std::clamp(forward_m / 1.3, -0.15, 1.0);
}
double land_pitch(double forward_m, double running) {
  return -0.30 * (1 - 0.8 * running) * std::clamp(forward_m / 1.2, -0.7, 1.0);
}

double forward_part(const Step& step, double yaw) {
  return (step.to.ankle_m - step.from.ankle_m).dot(direction(yaw));
}

/// A foot that stands on its toes (pitch > 0) or its heel (pitch < 0), which stay where they are
/// when it stands flat on `plant`.
FootState rolled(const Plant& plant, double pitch, const Proportions& p) {
  FootState foot;
  foot.yaw_rad = plant.yaw_rad;
  foot.pitch_rad = pitch;
  const double pivot = p.foot_m * (pitch > 0 ? kToeShare : kHeelShare);
  // from the pivot on the ground back to the ankle, turned about the pivot
  const double back = -pivot * std::cos(pitch) + p.ankle_m * std::sin(pitch);
  const double up = pivot * std::sin(pitch) + p.ankle_m * std::cos(pitch);
  const Vector2d at = plant.ankle_m + (pivot + back) * direction(plant.yaw_rad);
  foot.ankle_m = {at.x(), at.y(), up};
  return foot;
}

}  // namespace

Footsteps::Footsteps(const GroundMotion& motion, const Proportions& proportions, std::uint64_t seed)
    : proportions_(proportions) {
  Random random(mix(seed, 0x666f6f74));
  const double leg_m = proportions.thigh_m + proportions.shin_m;
  const double standing_half_m = proportions.hip_width_m / 2 + random.uniform(0.0, 0.05);
  const double walking_half_m = proportions.hip_width_m / 2 * random.uniform(0.6, 0.8);
  const double toe_out = random.uniform(0.05, 0.2);
  const auto nominal = [&](std::size_t side, double seconds, double speed) {
    const double left = side == 0 ? 1.0 : -1.0;
    const double heading = motion.heading(seconds);
    const double half =
        standing_half_m + ramp(speed, 0.2, 0.8) * (walking_half_m - standing_half_m);
    // ankles lie a little behind the middle of the body
    const Vector2d at = motion.position(seconds) - 0.03 * direction(heading) +
                        left * half * direction(heading + std::numbers::pi / 2);
    return Plant{at, heading + left * toe_out};
  };
  std::array<Plant, 2> plants;
  for (std::size_t side = 0; side < 2; ++side) {
    plants[side] = first_[side] = nominal(side, motion.start_s(), 0);
  }
  std::size_t last = random.index(2);
  double last_lift = -1e9;
  std::array<double, 2> landed = {-1e9, -1e9};
  double t = motion.start_s() + random.uniform(0.0, 0.2);
  while (t < motion.end_s()) {
    // the speed that the step which may begin now has to keep up with
    double speed = 0;
    for (const double ahead : {0.2, 0.45, 0.7}) {
      speed = std::max(speed, motion.velocity(t + ahead).norm());
    }
    Rhythm beat = rhythm(speed, leg_m);
    // no later than the body leaves the other leg's reach is it that leg's turn
    for (int hurry = 0; hurry < 6; ++hurry) {
      const auto left_behind = [&](std::size_t side) {
        return (motion.position(t + beat.step_s) - plants[side].ankle_m).norm();
      };
      const double behind =
          t - last_lift < 1.0 ? left_behind(last) : std::min(left_behind(0), left_behind(1));
      if (behind < 0.62 * leg_m) {
        break;
      }
      beat = {0.87 * beat.step_s, 0.87 * beat.swing_s, 0.87 * beat.stance_s, beat.running};
    }
    const double middle = t + beat.swing_s + beat.stance_s / 2;
    std::array<Plant, 2> wanted;
    std::array<double, 2> error;
    for (std::size_t side = 0; side < 2; ++side) {
      wanted[side] = nominal(side, middle, speed);
      error[side] = (wanted[side].ankle_m - plants[side].ankle_m).norm() +
                    0.25 * std::abs(wanted[side].yaw_rad - plants[side].yaw_rad);
    }
    const bool in_rhythm = t - last_lift < 1.5 * beat.step_s + 0.1;
    const double tolerance = in_rhythm ? 0.045 : 0.07;
    std::size_t side = in_rhythm ? 1 - last : (error[0] > error[1] ? 0 : 1);
    if (error[side] < tolerance && error[1 - side] >= tolerance) {
      side = 1 - side;
    }
    if (error[side] < tolerance || t < landed[side] + 0.12) {
      t += 0.02;
      continue;
    }
    const Step step = {t, t + beat.swing_s, plants[side], wanted[side], beat.running};
    steps_[side].push_back(step);
    plants[side] = step.to;
    landed[side] = step.land_s;
    last = side;
    last_lift = t;
    t += beat.step_s;
  }
}

FootState Footsteps::foot(std::size_t side, double seconds) const {
  const std::vector<Step>& steps = steps_[side];
  // the first step that has not begun
  const auto next = std::upper_bound(steps.begin(), steps.end(), seconds,
                                     [](double t, const Step& step) { return t < step.lift_s; });
  const Step* coming = next == steps.end() ? nullptr : &*next;
  if (next == steps.begin()) {
    return on_ground(first_[side], nullptr, coming, seconds);
  }
  const Step& last = *std::prev(next);
  return seconds < last.land_s ? in_swing(last, seconds)
                               : on_ground(last.to, &last, coming, seconds);
}

FootState Footsteps::on_ground(const Plant& plant, const Step* last, const Step* next,
                               double seconds) const {
  const double stance_s = last != nullptr && next != nullptr ? next->lift_s - last->land_s : 1.0;
  double pitch = 0;
  if (last != nullptr) {
    const double down = smooth_step((seconds - last->land_s) / std::min(0.12, 0.25 * stance_s));
    pitch += (1 - down) * land_pitch(forward_part(*last, plant.yaw_rad), last->running);
  }
  if (next != nullptr) {
    const double rise_s = std::min(0.30, 0.55 * stance_s);
    const double share = std::clamp((seconds - next->lift_s + rise_s) / rise_s, 0.0, 1.0);
    // it leaves the ground in full motion, so it must not come to rest at the end
    pitch += share * share * lift_pitch(forward_part(*next, plant.yaw_rad), next->running);
  }
  return rolled(plant, pitch, proportions_);
}

FootState Footsteps::in_swing(const Step& step, double seconds) const {
  const double share = (seconds - step.lift_s) / (step.land_s - step.lift_s);
  const double lifted = lift_pitch(forward_part(step, step.from.yaw_rad), step.running);
  const double landing = land_pitch(forward_part(step, step.to.yaw_rad), step.running);
  const FootState from = rolled(step.from, lifted, proportions_);
  const FootState to = rolled(step.to, landing, proportions_);
  // a walker's foot starts and stops gently, a runner's is pulled off the ground
  const double gentle = share * share * (3 - 2 * share);
  const double pulled = share * (1 + share - share * share);
  const double moved = gentle + 0.7 * step.running * (pulled - gentle);
  FootState foot;
  foot.swing = std::pow(std::sin(std::numbers::pi * share), 2);
  foot.yaw_rad = step.from.yaw_rad + moved * (step.to.yaw_rad - step.from.yaw_rad);
  // the heel trails for the first third
  const double turned = smooth_step((share - 0.05) / 0.8);
  const double stride = std::min(1.0, (step.to.ankle_m - step.from.ankle_m).norm() / 1.2);
  foot.pitch_rad = lifted + turned * (landing - lifted) +
                   (0.25 + 0.5 * step.running) * stride *
                       std::pow(std::sin(std::numbers::pi * std::min(1.0, share * 1.6)), 2);
  foot.ankle_m = from.ankle_m + moved * (to.ankle_m - from.ankle_m);
  const double heel = -proportions_.foot_m * kHeelShare * std::sin(foot.pitch_rad);
  const double toe = -proportions_.foot_m * kToeShare * std::sin(foot.pitch_rad);
  const double lowest = std::min(heel, toe) - proportions_.ankle_m * std::cos(foot.pitch_rad);
  // off the ground at once, or it would slide
  const double rising = std::sin(std::numbers::pi * share);
  const double clearance = (0.02 + 0.02 * stride) * rising +
                           step.running * (0.16 * foot.swing + 0.03 * std::sqrt(rising));
  foot.ankle_m.z() = clearance - lowest;
  return foot;
}

}  // namespace plaza::synthetic
