// What makes a motion believable, measured on every scenario.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plaza/geometry/angle.h"
#include "tests/plugins/sources/synthetic/world/world_support.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint64_t kSeeds = 4;

/// Least distance between two line segments in space.
double segment_distance(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0,
                        const Vector3d& b1) {
  double least = 1e9;
  // fine enough for bodies: the lines are at most half a metre long
  for (int i = 0; i <= 8; ++i) {
    const Vector3d a = a0 + (a1 - a0) * i / 8.0;
    const Vector3d along = b1 - b0;
    const double share = std::clamp((a - b0).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a - b0 - share * along).norm());
  }
  return least;
}

class EveryScenario : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryScenario, FeetOnTheGroundDoNotSlide) {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const World world(options_of(GetParam(), seed));
    for (const Film& reel : film(world, 20, 50)) {
      const Proportions& p = world.cast()[reel.person].proportions;
      for (const bool left : {true, false}) {
        for (const auto& part : {heel, toes}) {
          std::optional<Vector3d> since;  // where it came to rest
          for (const PersonState& state : reel.states) {
            const Vector3d at = part(state, p, left);
            ASSERT_GT(at.z(), -0.003) << GetParam() << " seed " << seed;
            if (at.z() > 0.002) {
              since.reset();
              continue;
            }
            if (!since) {
              since = at;
            }
            worst = std::max(worst, (at - *since).head<2>().norm());
          }
        }
      }
    }
  }
  EXPECT_LT(worst, 0.005);
}

TEST_P(EveryScenario, SomeoneOnTwoLegsHasAFootOnTheGroundUnlessRunning) {
  std::size_t flying = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const World world(options_of(GetParam(), seed));
    for (const Film& reel : film(world, 20, 25)) {
      const Proportions& p = world.cast()[reel.person].proportions;
      for (std::size_t k = 1; k < reel.states.size(); ++k) {
        const double speed = 25 * between(reel.states[k], reel.states[k - 1]);
        if (speed > 1.8) {
          continue;
        }
        double lowest = 1;
        for (const bool left : {true, false}) {
          lowest = std::min(
              {lowest, heel(reel.states[k], p, left).z(), toes(reel.states[k], p, left).z()});
        }
        ++all;
        flying += lowest > 0.01 ? 1 : 0;
      }
    }
  }
  ASSERT_GT(all, 1000U);
  EXPECT_LT(static_cast<double>(flying), 0.002 * static_cast<double>(all));
}

TEST_P(EveryScenario, BodiesDoNotPassThroughEachOther) {
  double nearest_trunks = 1e9;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const World world(options_of(GetParam(), seed));
    for (double t = 0; t <= 20; t += 0.1) {
      const std::vector<PersonState> all = world.at(t);
      for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 1; j < all.size(); ++j) {
          const auto shoulders = [&](const PersonState& s, double side) -> Vector3d {
            // the middle of the shoulder's flesh: the joints' line ends inside of it
            return s.pose[Segment::kChest] *
                   shoulder_offset(world.cast()[s.person].proportions, 0.8 * side);
          };
          const auto hips = [&](const PersonState& s, double side) -> Vector3d {
            return s.pose[Segment::kPelvis] *
                   Vector3d(0, side * world.cast()[s.person].proportions.hip_width_m / 2, 0);
          };
          nearest_trunks = std::min({nearest_trunks,
                                     segment_distance(shoulders(all[i], 1), shoulders(all[i], -1),
                                                      shoulders(all[j], 1), shoulders(all[j], -1)),
                                     segment_distance(hips(all[i], 1), hips(all[i], -1),
                                                      hips(all[j], 1), hips(all[j], -1))});
        }
      }
    }
  }
  // a chest is 0.2 m deep or more, half of it on either side of the line between the shoulders
  EXPECT_GT(nearest_trunks, 0.18);
}

TEST_P(EveryScenario, SpeedsAndAccelerationsArePeoples) {
  const bool runs = GetParam() == "campus";
  double fastest = 0, hardest = 0, quickest_turn = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const World world(options_of(GetParam(), seed));
    for (const Film& reel : film(world, 20, 25)) {
      for (std::size_t k = 5; k + 5 < reel.states.size(); ++k) {
        // over 0.4 s, so that the sway of each step isn't taken for walking
        const Vector2d before = (reel.states[k].position_m - reel.states[k - 5].position_m) / 0.2;
        const Vector2d after = (reel.states[k + 5].position_m - reel.states[k].position_m) / 0.2;
        fastest = std::max(fastest, ((before + after) / 2).norm());
        hardest = std::max(hardest, (after - before).norm() / 0.2);
        quickest_turn = std::max(quickest_turn,
                                 25 * std::abs(angle_difference(reel.states[k].heading_rad,
                                                                reel.states[k - 1].heading_rad)));
      }
    }
  }
  EXPECT_LT(fastest, runs ? 5.0 : 1.8);
  EXPECT_LT(hardest, runs ? 5.0 : 4.0);
  EXPECT_LT(quickest_turn, 4.5);  // radians per second: 10 degrees per frame
}

TEST_P(EveryScenario, LimbsStayWholeAndJointsWithinTheirLimits) {
  double straightest = 0, most_bent = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const World world(options_of(GetParam(), seed));
    for (double t = 0.02; t <= 20; t += 0.1) {
      for (const PersonState& s : world.at(t)) {
        const Proportions& p = world.cast()[s.person].proportions;
        const auto length = [&](Segment from, Segment to) {
          return (s.pose[to].translation() - s.pose[from].translation()).norm();
        };
        ASSERT_NEAR(length(Segment::kLeftThigh, Segment::kLeftShin), p.thigh_m, 1e-9);
        ASSERT_NEAR(length(Segment::kRightShin, Segment::kRightFoot), p.shin_m, 1e-9);
        ASSERT_NEAR(length(Segment::kLeftUpperArm, Segment::kLeftForearm), p.upper_arm_m, 1e-9);
        ASSERT_NEAR(length(Segment::kRightForearm, Segment::kRightHand), p.forearm_m, 1e-9);
        for (const auto& [thigh, shin] : {std::pair(Segment::kLeftThigh, Segment::kLeftShin),
                                          std::pair(Segment::kRightThigh, Segment::kRightShin)}) {
          // the knee bends backwards only: in the thigh's frame the shin turns about +y
          const Eigen::Matrix3d bend = s.pose[thigh].linear().transpose() * s.pose[shin].linear();
          const double angle = std::atan2(bend(0, 2), bend(2, 2));
          straightest = std::min(straightest, angle);
          most_bent = std::max(most_bent, angle);
        }
        for (const Eigen::Isometry3d& segment : s.pose.world_from_segment) {
          ASSERT_NEAR(segment.linear().determinant(), 1.0, 1e-9);
          ASSERT_TRUE(segment.translation().allFinite());
        }
      }
    }
  }
  EXPECT_GT(straightest, -0.01);
  EXPECT_LT(most_bent, 2.4);
}

TEST_P(EveryScenario, LimbsMoveWithoutJumps) {
  double quickest = 0;  // against the pelvis, metres per second
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const World world(options_of(GetParam(), seed));
    for (const Film& reel : film(world, 20, 50)) {
      for (std::size_t k = 1; k < reel.states.size(); ++k) {
        const BodyPose& now = reel.states[k].pose;
        const BodyPose& before = reel.states[k - 1].pose;
        const Vector3d moved =
            now[Segment::kPelvis].translation() - before[Segment::kPelvis].translation();
        for (std::size_t s = 0; s < kSegmentCount; ++s) {
          const Vector3d change = now.world_from_segment[s].translation() -
                                  before.world_from_segment[s].translation() - moved;
          quickest = std::max(quickest, 50 * change.norm());
        }
      }
    }
  }
  EXPECT_LT(quickest, GetParam() == "campus" ? 8.0 : 4.5);
}

TEST_P(EveryScenario, PositionIsThePelvisAndHeadingTheChest) {
  const World world(options_of(GetParam(), 1));
  for (double t = 0; t <= 20; t += 0.5) {
    for (const PersonState& s : world.at(t)) {
      const Vector3d pelvis = s.pose[Segment::kPelvis].translation();
      EXPECT_LT((pelvis.head<2>() - s.position_m).norm(), 1e-9);
      const Vector3d facing = s.pose[Segment::kChest].linear().col(0);
      EXPECT_LT(std::abs(angle_difference(std::atan2(facing.y(), facing.x()), s.heading_rad)),
                1e-9);
      const double upright = s.pose[Segment::kHead].translation().z();
      EXPECT_GT(upright, 0.78 * world.cast()[s.person].proportions.stature_m);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, EveryScenario, ::testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const ScenarioInfo& info : World::scenarios()) {
                             names.push_back(info.name);
                           }
                           return names;
                         }()),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace plaza::synthetic
