// The parts of a body's motion, each for itself; whole bodies are measured in world/bodies_test.cc.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plaza/core/error.h"
#include "plugins/sources/synthetic/people/acts.h"
#include "plugins/sources/synthetic/people/footsteps.h"
#include "plugins/sources/synthetic/people/ground_motion.h"
#include "plugins/sources/synthetic/people/proportions.h"
#include "plugins/sources/synthetic/people/random.h"
#include "plugins/sources/synthetic/people/skeleton.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

GroundMotion walk(double speed, double seconds) {
  std::vector<Vector2d> position;
  for (int k = 0; k <= static_cast<int>(seconds * GroundMotion::kRateHz); ++k) {
    position.emplace_back(speed * k / GroundMotion::kRateHz, 0.0);
  }
  std::vector<double> heading(position.size(), 0.0);
  return GroundMotion(0, position, heading);
}

GroundMotion turn(double rate, double seconds) {
  std::vector<double> heading;
  for (int k = 0; k <= static_cast<int>(seconds * GroundMotion::kRateHz); ++k) {
    heading.push_back(rate * k / GroundMotion::kRateHz);
  }
  return GroundMotion(0, std::vector<Vector2d>(heading.size(), Vector2d(1, 2)), heading);
}

TEST(Random, DependsOnItsSeedAloneAndCoversItsRange) {
  Random a(7), b(7), c(8);
  double sum = 0, squares = 0;
  for (int i = 0; i < 4000; ++i) {
    const double value = a.normal();
    EXPECT_EQ(value, b.normal());
    sum += value;
    squares += value * value;
  }
  EXPECT_NE(a.next(), c.next());
  EXPECT_NEAR(sum / 4000, 0, 0.06);
  EXPECT_NEAR(squares / 4000, 1, 0.08);
}

TEST(Proportions, AddUpToStaturesOfAdults) {
  double least = 9, most = 0, slimmest = 9, stoutest = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Proportions p = draw_proportions(seed);
    EXPECT_NEAR(p.ankle_m + p.shin_m + p.thigh_m + p.pelvis_m + p.abdomen_m + p.chest_m + p.neck_m +
                    p.head_m,
                p.stature_m, 1e-12);
    EXPECT_GT(p.chest_m, 0.08 * p.stature_m);
    EXPECT_LT(p.chest_m, 0.19 * p.stature_m);
    least = std::min(least, p.stature_m);
    most = std::max(most, p.stature_m);
    slimmest = std::min(slimmest, p.girth);
    stoutest = std::max(stoutest, p.girth);
  }
  EXPECT_GE(least, 1.55);
  EXPECT_LE(most, 1.95);
  EXPECT_GT(most - least, 0.3);
  EXPECT_LT(slimmest, 0.88);
  EXPECT_GT(stoutest, 1.15);
}

TEST(Skeleton, StandsUprightAtItsStature) {
  const Proportions p = draw_proportions(3);
  JointRotations joints;
  joints.pelvis_m = {0, 0, p.ankle_m + p.shin_m + p.thigh_m};
  const BodyPose pose = place_segments(p, joints);
  EXPECT_NEAR((pose[Segment::kHead] * Vector3d(0, 0, p.head_m)).z(), p.stature_m, 1e-12);
  EXPECT_NEAR((pose[Segment::kLeftFoot] * Vector3d(0, 0, -p.ankle_m)).z(), 0, 1e-12);
  EXPECT_GT(pose[Segment::kLeftHand].translation().y(), 0) << "the left is at +y";
}

TEST(Skeleton, ReachesWhatIsInReachWithTheElbowTowardsThePole) {
  const Vector3d root(0.1, 0.2, 1.4);
  for (const Vector3d& target : {Vector3d(0.4, 0.1, 1.1), Vector3d(0.2, 0.3, 1.0)}) {
    const TwoBones bones = reach(root, target, 0.30, 0.26, Vector3d(0, 0, -1));
    const Vector3d elbow = root + 0.30 * bones.upper;
    EXPECT_LT((elbow + 0.26 * bones.lower - target).norm(), 1e-9);
    const Vector3d middle = (root + target) / 2;
    EXPECT_LT(elbow.z(), middle.z());
  }
  const TwoBones far = reach(root, root + Vector3d(5, 0, 0), 0.30, 0.26, Vector3d(0, 0, -1));
  EXPECT_GT(far.upper.x(), 0.99);
  EXPECT_GT(far.lower.x(), 0.99);
}

TEST(GroundMotion, InterpolatesStraightWaysExactlyAndKeepsThemWhenSmoothed) {
  const GroundMotion motion = walk(1.3, 4);
  const GroundMotion smooth = motion.smoothed(0.2);
  for (double t = 0.1; t < 3.9; t += 0.137) {
    EXPECT_NEAR(motion.position(t).x(), 1.3 * t, 1e-9);
    EXPECT_NEAR(motion.velocity(t).x(), 1.3, 1e-9);
    EXPECT_NEAR(smooth.position(t).x(), 1.3 * t, 1e-9);
  }
  EXPECT_EQ(motion.position(-3).x(), 0);
  EXPECT_EQ(motion.position(99), motion.position(4));
  EXPECT_NEAR(turn(0.5, 4).yaw_rate(2), 0.5, 1e-9);
  EXPECT_THROW(GroundMotion(0, {}, {}), InternalError);
}

TEST(Footsteps, WalkInTurnAtTheCadenceOfPeople) {
  const Proportions p = draw_proportions(4);
  const Footsteps steps(walk(1.35, 20), p, 1);
  std::vector<double> lifts;
  for (std::size_t side = 0; side < 2; ++side) {
    for (const Step& step : steps.steps(side)) {
      lifts.push_back(step.lift_s);
      EXPECT_LT((step.to.ankle_m - step.from.ankle_m).norm(), 1.8);
    }
  }
  const std::size_t left = steps.steps(0).size();
  const std::size_t right = steps.steps(1).size();
  EXPECT_LE(left > right ? left - right : right - left, 1U);
  const double cadence_hz = static_cast<double>(lifts.size()) / 20;
  EXPECT_GT(cadence_hz, 1.6);
  EXPECT_LT(cadence_hz, 2.3);
}

TEST(Footsteps, RestWhileStandingAndTurnOnTheSpotInSteps) {
  const Proportions p = draw_proportions(5);
  const Footsteps resting(walk(0, 10), p, 1);
  EXPECT_TRUE(resting.steps(0).empty());
  EXPECT_TRUE(resting.steps(1).empty());
  const Footsteps turning(turn(1.0, 10), p, 1);
  EXPECT_GE(turning.steps(0).size(), 6U);
  EXPECT_GE(turning.steps(1).size(), 6U);
  for (double t = 0; t < 10; t += 0.05) {
    const FootState foot = turning.foot(0, t);
    EXPECT_LT(std::abs(foot.yaw_rad - t), 1.2) << "feet follow the body's turn at " << t;
    EXPECT_LT((foot.ankle_m.head<2>() - Vector2d(1, 2)).norm(), 0.3);
  }
}

TEST(Footsteps, LeaveTheGroundTogetherOnlyInARun) {
  const Proportions p = draw_proportions(6);
  for (const double speed : {1.3, 3.3}) {
    const Footsteps steps(walk(speed, 10), p, 1);
    int flying = 0, all = 0;
    for (double t = 2; t < 9; t += 0.02) {
      flying += steps.foot(0, t).swing > 0 && steps.foot(1, t).swing > 0 ? 1 : 0;
      ++all;
    }
    if (speed > 2) {
      EXPECT_GT(flying, 0.1 * all);
    } else {
      EXPECT_EQ(flying, 0);
    }
  }
}

TEST(Acts, BlendInAndOutAndWantHandsWhereTheyBelong) {
  const Proportions p = draw_proportions(7);
  const GroundMotion partner = GroundMotion(0, {Vector2d(0.7, 0)}, {std::numbers::pi});
  Act act;
  act.kind = ActKind::kHandshake;
  act.begin_s = 1;
  act.end_s = 5;
  act.partner = {&partner, 1.75};
  EXPECT_EQ(act_goals(act, p, Vector2d::Zero(), 0, 0.9).hands[1].weight, 0);
  EXPECT_LT(act_goals(act, p, Vector2d::Zero(), 0, 1.2).hands[1].weight, 0.5);
  const ActGoals firm = act_goals(act, p, Vector2d::Zero(), 0, 3);
  EXPECT_EQ(firm.hands[1].weight, 1);
  EXPECT_EQ(firm.hands[0].weight, 0) << "the left hand is free";
  // the palm is half a hand ahead of the wrist
  EXPECT_NEAR(firm.hands[1].wrist_m.x() + 0.5 * p.hand_m, 0.35, 1e-9);
  EXPECT_EQ(act_goals(act, p, Vector2d::Zero(), 0, 5.1).hands[1].weight, 0);
}

TEST(SlowWave, StaysWithinOneAndDiffersBetweenSeeds) {
  double most = 0, apart = 0;
  for (double t = 0; t < 100; t += 0.1) {
    most = std::max(most, std::abs(slow_wave(1, t, 4)));
    apart = std::max(apart, std::abs(slow_wave(1, t, 4) - slow_wave(2, t, 4)));
    EXPECT_LT(std::abs(slow_wave(1, t + 0.01, 4) - slow_wave(1, t, 4)), 0.05);
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 0.7);
  EXPECT_GT(apart, 0.5);
}

}  // namespace
}  // namespace plaza::synthetic
