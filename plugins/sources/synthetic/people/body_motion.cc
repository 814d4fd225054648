#include "plugins/sources/synthetic/people/body_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plaza/geometry/angle.h"
#include "plugins/sources/synthetic/people/random.h"
#include "plugins/sources/synthetic/people/skeleton.h"

namespace plaza::synthetic {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

Quaterniond about_x(double radians) { return Quaterniond(AngleAxisd(radians, Vector3d::UnitX())); }
Quaterniond about_y(double radians) { return Quaterniond(AngleAxisd(radians, Vector3d::UnitY())); }

double ramp(double value, double low, double high) {
  const double x = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// The smallest turn of a hanging bone that makes it point along `direction`.
Quaterniond turned_to(const Quaterniond& hanging, const Vector3d& direction) {
  return Quaterniond::FromTwoVectors(hanging * Vector3d(0, 0, -1), direction) * hanging;
}

}  // namespace

/// What the trunk and the arms take from the feet and the ground motion.
struct BodyMotion::Gait {
  std::array<FootState, 2> feet;
  Vector2d position;   // of the pelvis, sway included
  double heading = 0;  // of the ground motion
  double forward = 0;  // speed in the direction of the heading
  double acceleration = 0;
  double running = 0;
  double standing = 0;
  double opposition = 0;         // how far the right foot is ahead of the left one, metres
  double tilt = 0;               // 1 in the middle of the right foot's swing, -1 of the left one's
  double turn = 0;               // of the pelvis to the leg behind, radians
  double roll = 0;               // of the pelvis to the leg that swings
  std::array<Vector3d, 2> hips;  // from the middle of the pelvis to the hip joints
};

Manner Manner::draw(std::uint64_t seed) {
  Random random(mix(seed, 0x6d616e6e));
  Manner manner;
  manner.arm_swing = random.uniform(0.55, 1.25);
  manner.elbow_rad = random.uniform(0.15, 0.45);
  manner.arms_out_rad = random.uniform(0.07, 0.16);
  manner.lean_rad = random.uniform(-0.01, 0.08);
  manner.sway = random.uniform(0.7, 1.3);
  manner.bounce = random.uniform(0.6, 1.4);
  return manner;
}

BodyMotion::BodyMotion(const Proportions& proportions, const GroundMotion& motion,
                       std::vector<Act> acts, std::uint64_t seed)
    : proportions_(proportions),
      motion_(&motion),
      acts_(std::move(acts)),
      seed_(seed),
      manner_(Manner::draw(seed)),
      footsteps_(motion, proportions, seed) {
  const auto count = static_cast<std::size_t>((end_s() - start_s()) * GroundMotion::kRateHz) + 2;
  std::vector<double> highest(count);
  for (std::size_t i = 0; i < count; ++i) {
    highest[i] = highest_pelvis(start_s() + static_cast<double>(i) / GroundMotion::kRateHz);
  }
  // The least of a neighbourhood, averaged over the same neighbourhood, is smooth and nowhere
  // above what the legs reach.
  constexpr std::size_t kReach = 4;
  const auto over_neighbours = [&](const std::vector<double>& values, auto&& combine) {
    std::vector<double> result(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t from = i < kReach ? 0 : i - kReach;
      result[i] = combine(
          values.begin() + static_cast<std::ptrdiff_t>(from),
          values.begin() + static_cast<std::ptrdiff_t>(std::min(i + kReach, count - 1)) + 1);
    }
    return result;
  };
  const std::vector<double> least =
      over_neighbours(highest, [](auto from, auto to) { return *std::min_element(from, to); });
  pelvis_height_ = over_neighbours(least, [](auto from, auto to) {
    double sum = 0;
    for (auto at = from; at != to; ++at) {
      sum += *at;
    }
    return sum / static_cast<double>(to - from);
  });
}

BodyMotion::Gait BodyMotion::gait_at(double t) const {
  Gait gait;
  for (std::size_t side = 0; side < 2; ++side) {
    gait.feet[side] = footsteps_.foot(side, t);
  }
  const Vector2d velocity = motion_->velocity(t);
  const double speed = velocity.norm();
  gait.heading = motion_->heading(t);
  const Vector2d ahead(std::cos(gait.heading), std::sin(gait.heading));
  const Vector2d left(-ahead.y(), ahead.x());
  gait.forward = velocity.dot(ahead);
  gait.acceleration = (motion_->velocity(t + 0.15) - motion_->velocity(t - 0.15)).dot(ahead) / 0.3;
  gait.running = ramp(speed, 1.9, 2.6);
  gait.standing = 1 - ramp(speed, 0.05, 0.5);
  const Vector3d apart = gait.feet[1].ankle_m - gait.feet[0].ankle_m;
  gait.opposition = apart.head<2>().dot(ahead);
  gait.tilt = gait.feet[1].swing - gait.feet[0].swing;
  // over the leg that carries; a standing person shifts weight from one leg to the other
  const double aside = manner_.sway * (0.020 * gait.tilt * (1 - 0.5 * gait.running) +
                                       gait.standing * 0.035 * slow_wave(seed_, t, 6.0));
  const double along = gait.standing * 0.012 * slow_wave(mix(seed_, 1), t, 4.0);
  gait.position = motion_->position(t) + aside * left + along * ahead;
  gait.turn = std::clamp(0.13 * gait.opposition, -0.14, 0.14) * manner_.sway;
  gait.roll = 0.055 * manner_.sway * gait.tilt * (1 - gait.standing) +
              0.03 * gait.standing * slow_wave(seed_, t, 6.0);
  for (std::size_t side = 0; side < 2; ++side) {
    const double half = (side == 0 ? 0.5 : -0.5) * proportions_.hip_width_m;
    gait.hips[side] =
        yaw_rotation(gait.heading + gait.turn) * about_x(-gait.roll) * Vector3d(0, half, 0);
  }
  return gait;
}

double BodyMotion::highest_pelvis(double t) const {
  const Gait gait = gait_at(t);
  const double leg_m = proportions_.thigh_m + proportions_.shin_m;
  // knees are never quite straight, and bend more while running
  const double length =
      leg_m * (0.998 - 0.006 * manner_.bounce * (1 - gait.standing) - 0.045 * gait.running);
  double highest = length + proportions_.ankle_m;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vector3d& ankle = gait.feet[side].ankle_m;
    const Vector3d& hip = gait.hips[side];
    const double apart = (ankle.head<2>() - gait.position - hip.head<2>()).squaredNorm();
    const double up = std::sqrt(std::max(length * length - apart, 0.25 * length * length));
    highest = std::min(highest, ankle.z() + up - hip.z());
  }
  return highest;
}

double BodyMotion::pelvis_height(double t) const {
  const double at = std::clamp((t - start_s()) * GroundMotion::kRateHz, 0.0,
                               static_cast<double>(pelvis_height_.size() - 1) - 1e-9);
  const auto from = static_cast<std::size_t>(at);
  const double share = at - static_cast<double>(from);
  return pelvis_height_[from] + share * (pelvis_height_[from + 1] - pelvis_height_[from]);
}

PersonState BodyMotion::at(double t) const {
  const Gait gait = gait_at(t);
  const Proportions& p = proportions_;
  JointRotations joints;
  joints.pelvis_m = {gait.position.x(), gait.position.y(), pelvis_height(t)};

  double lean = 0, head_down = 0;
  std::vector<ActGoals> goals;
  for (const Act& act : acts_) {
    if (t > act.begin_s && t < act.end_s) {
      goals.push_back(act_goals(act, p, gait.position, gait.heading, t));
      lean += goals.back().lean_rad;
      head_down += goals.back().head_down_rad;
    }
  }

  // trunk
  const double walking = 1 - gait.standing;
  const double turn = std::clamp(0.13 * gait.opposition, -0.14, 0.14) * manner_.sway;
  const double roll =
      0.055 * manner_.sway * gait.tilt * walking + 0.03 * gait.standing * slow_wave(seed_, t, 6.0);
  lean += manner_.lean_rad * (0.5 + 0.5 * walking) + 0.035 * std::clamp(gait.forward, -1.0, 2.0) +
          0.10 * gait.running + std::clamp(0.03 * gait.acceleration, -0.06, 0.08) +
          0.02 * slow_wave(mix(seed_, 2), t, 5.0);
  joints.pelvis = yaw_rotation(gait.heading + turn) * about_x(-roll) * about_y(0.35 * lean);
  joints.lumbar = yaw_rotation(-turn) * about_x(0.75 * roll) * about_y(0.35 * lean);
  joints.thoracic = yaw_rotation(-0.9 * turn) * about_x(0.5 * roll) * about_y(0.30 * lean);
  // the head keeps its direction while the chest turns, and looks around
  const double look = 0.30 * slow_wave(mix(seed_, 3), t, 4.5) * (1 - 0.5 * gait.running);
  const double nod = 0.06 * slow_wave(mix(seed_, 4), t, 2.2) + head_down - 0.6 * lean;
  joints.neck = yaw_rotation(0.45 * turn + 0.4 * look) * about_y(0.4 * nod);
  joints.head = yaw_rotation(0.45 * turn + 0.6 * look) * about_y(0.6 * nod);

  // legs
  for (std::size_t side = 0; side < 2; ++side) {
    const FootState& foot = gait.feet[side];
    const Vector3d hip = joints.pelvis_m + gait.hips[side];
    const double knee_yaw = gait.heading + 0.5 * angle_difference(foot.yaw_rad, gait.heading);
    const Vector3d pole(std::cos(knee_yaw), std::sin(knee_yaw), 0.05);
    const TwoBones leg = reach(hip, foot.ankle_m, p.thigh_m, p.shin_m, pole);
    joints.legs[side].thigh = limb_along(leg.upper, pole);
    joints.legs[side].shin = limb_along(leg.lower, pole);
    joints.legs[side].foot = yaw_rotation(foot.yaw_rad) * about_y(foot.pitch_rad);
  }

  // arms: with the opposite leg, unless an act wants them
  const Quaterniond chest = joints.pelvis * joints.lumbar * joints.thoracic;
  const Vector3d chest_m = joints.pelvis_m + joints.pelvis * Vector3d(0, 0, p.pelvis_m) +
                           joints.pelvis * joints.lumbar * Vector3d(0, 0, p.abdomen_m);
  // hanging arms follow gravity more than they follow the trunk
  const Quaterniond upright = yaw_rotation(gait.heading - 0.9 * turn);
  for (std::size_t side = 0; side < 2; ++side) {
    const double left = side == 0 ? 1.0 : -1.0;
    const double swing =
        left * std::clamp((0.62 - 0.20 * gait.running) * gait.opposition, -0.75, 0.75) *
            manner_.arm_swing -
        0.04 - 0.15 * gait.running + 0.03 * slow_wave(mix(seed_, 10 + side), t, 3.0);
    const double elbow = manner_.elbow_rad + 0.5 * std::max(0.0, swing) * (1 - gait.running) +
                         gait.running * (1.25 + 0.3 * swing);
    const Quaterniond hanging =
        upright * about_x(left * (manner_.arms_out_rad + 0.05 * (p.girth - 1.0)));
    auto& arm = joints.arms[side];
    arm.upper = hanging * about_y(-swing);
    arm.fore = hanging * about_y(-swing - elbow);
    const Vector3d shoulder = chest_m + chest * shoulder_offset(p, left);
    const Vector3d pole =
        upright * Vector3d(-0.55, left * 0.75, -0.6);  // elbows point back, out and down
    arm.hand = arm.fore * about_y(-0.12);
    for (const ActGoals& goal : goals) {
      const HandGoal& hand = goal.hands[side];
      if (hand.weight <= 0) {
        continue;
      }
      const TwoBones bones = reach(shoulder, hand.wrist_m, p.upper_arm_m, p.forearm_m, pole);
      const Quaterniond upper = turned_to(upright, bones.upper);
      const Quaterniond fore = turned_to(upper, bones.lower);
      arm.upper = arm.upper.slerp(hand.weight, upper);
      arm.fore = arm.fore.slerp(hand.weight, fore);
      const Quaterniond palm =
          hand.pointing.isZero() ? fore * about_y(-0.12) : turned_to(fore, hand.pointing);
      arm.hand = arm.hand.slerp(hand.weight, palm);
    }
  }

  PersonState state;
  state.pose = place_segments(p, joints);
  state.position_m = gait.position;
  const Vector3d facing = state.pose[Segment::kChest].linear().col(0);
  state.heading_rad = std::atan2(facing.y(), facing.x());
  return state;
}

}  // namespace plaza::synthetic
