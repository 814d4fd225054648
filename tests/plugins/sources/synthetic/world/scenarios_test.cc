// What each scenario promises (thesis table 3.1), as numbers over the first 500 frames.

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>

#include "plaza/geometry/angle.h"
#include "tests/plugins/sources/synthetic/world/world_support.h"

namespace plaza::synthetic {
namespace {

constexpr double kStep = 0.1;

/// Calls `visit(world, t, states)` every 0.1 s of the first 20 s of some seeds.
template <typename Visit>
void over_seeds(const std::string& scenario, std::uint64_t seeds, Visit visit) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const World world(options_of(scenario, seed));
    for (int k = 0; k < 200; ++k) {
      visit(world, k * kStep, world.at(k * kStep));
    }
  }
}

/// How many times two people came nearer than `distance_m` after having been farther apart than
/// twice that.
int count_encounters(const World& world, double seconds, double distance_m) {
  int count = 0;
  std::map<std::pair<std::size_t, std::size_t>, bool> close;
  for (double t = 0; t < seconds; t += kStep) {
    const std::vector<PersonState> all = world.at(t);
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = i + 1; j < all.size(); ++j) {
        bool& now = close[{all[i].person, all[j].person}];
        const double distance = between(all[i], all[j]);
        if (!now && distance < distance_m) {
          now = true;
          ++count;
        } else if (distance > 2 * distance_m) {
          now = false;
        }
      }
    }
  }
  return count;
}

TEST(Scenario, TwoTargetsStandFaceToFaceForMoreThanHalfOfTheTime) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const World world(options_of("two-targets", seed));
    int face_to_face = 0;
    double farthest = 0;
    for (int k = 0; k < 200; ++k) {
      const auto all = world.at(k * kStep);
      ASSERT_EQ(all.size(), 2U);
      face_to_face += between(all[0], all[1]) < 1.0 && off_facing(all[0], all[1]) < 0.5 &&
                              off_facing(all[1], all[0]) < 0.5
                          ? 1
                          : 0;
      farthest = std::max(farthest, between(all[0], all[1]));
    }
    EXPECT_GE(face_to_face, 100) << "seed " << seed;
    EXPECT_GT(farthest, 1.2) << "seed " << seed << ": they also come and go";
  }
}

TEST(Scenario, HandsMeetInAHandshake) {
  // somewhere in 20 s the right hands of two-targets are in each other, for seconds
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    int together = 0;
    const World world(options_of("two-targets", seed));
    for (int k = 0; k < 200; ++k) {
      const auto all = world.at(k * kStep);
      const auto palm = [&](const PersonState& s) -> Eigen::Vector3d {
        return s.pose[Segment::kRightHand] *
               Eigen::Vector3d(0, 0, -0.5 * world.cast()[s.person].proportions.hand_m);
      };
      together += (palm(all[0]) - palm(all[1])).norm() < 0.09 ? 1 : 0;
    }
    EXPECT_GT(together, 50) << "seed " << seed;
  }
}

TEST(Scenario, BoxmotionTurnsAwayFromWhereItGoes) {
  double sideways = 0, moving = 0, turned = 0, fast = 0;
  std::map<std::size_t, PersonState> before;
  over_seeds("three-boxmotion", 6, [&](const World&, double t, const auto& all) {
    for (const PersonState& s : all) {
      if (t > 0) {
        const PersonState& last = before[s.person];
        const Eigen::Vector2d way = s.position_m - last.position_m;
        const double speed = way.norm() / kStep;
        turned += std::abs(angle_difference(s.heading_rad, last.heading_rad));
        if (speed > 0.4) {
          moving += 1;
          fast += speed > 1.0 ? 1 : 0;
          sideways += std::abs(angle_difference(std::atan2(way.y(), way.x()), s.heading_rad)) > 0.5;
        }
      }
      before[s.person] = s;
    }
  });
  EXPECT_GT(moving, 0.7 * 6 * 200 * 3);
  EXPECT_GT(fast, 0.3 * moving);
  EXPECT_GT(sideways, 0.25 * moving);
  EXPECT_GT(turned / (6 * 3), 3 * std::numbers::pi) << "radians per person in 20 s";
}

TEST(Scenario, ThreeTargetsAndFourInDarkClothesCrossAllTheTime) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    EXPECT_GE(count_encounters(World(options_of("three-targets", seed)), 20, 0.95), 4)
        << "three-targets, seed " << seed;
    const World dark(options_of("four-crossing", seed));
    EXPECT_GE(count_encounters(dark, 20, 0.95), 8) << "four-crossing, seed " << seed;
    EXPECT_GE(std::count_if(dark.cast().begin(), dark.cast().end(),
                            [](const CastMember& m) { return m.style == ClothingStyle::kDark; }),
              3);
  }
}

TEST(Scenario, FourInteractionIsSlowAndClose) {
  double still = 0, together = 0, all_people = 0;
  std::map<std::size_t, PersonState> before;
  over_seeds("four-interaction", 6, [&](const World&, double t, const auto& all) {
    ASSERT_EQ(all.size(), 4U);
    for (const PersonState& s : all) {
      double nearest = 1e9;
      for (const PersonState& other : all) {
        nearest = other.person == s.person ? nearest : std::min(nearest, between(s, other));
      }
      all_people += 1;
      together += nearest < 1.1 ? 1 : 0;
      still += t > 0 && between(s, before[s.person]) < 0.02 ? 1 : 0;
      before[s.person] = s;
    }
  });
  EXPECT_GT(still, 0.6 * all_people);
  EXPECT_GT(together, 0.7 * all_people);
}

TEST(Scenario, SixTargetsAreNineIdentitiesAndSixAtOnce) {
  std::vector<std::size_t> identities;
  double inside = 0, samples = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const World world(options_of("six-targets", seed));
    std::set<std::size_t> seen;
    std::size_t most = 0;
    for (int k = 0; k < 200; ++k) {
      std::size_t now = 0;
      for (const PersonState& s : world.at(k * kStep)) {
        if (const auto identity = world.identity(s.person, k * kStep)) {
          seen.insert(*identity);
          ++now;
        }
      }
      most = std::max(most, now);
      inside += static_cast<double>(now);
      samples += 1;
    }
    identities.push_back(seen.size());
    EXPECT_LE(most, 6U) << "seed " << seed;
    EXPECT_GE(most, 5U) << "seed " << seed;
    EXPECT_GE(seen.size(), 8U) << "seed " << seed;
    EXPECT_LE(seen.size(), 11U) << "seed " << seed;
  }
  std::sort(identities.begin(), identities.end());
  EXPECT_EQ(identities[5], 9U) << "the median";
  EXPECT_GT(inside / samples, 4.3) << "on 24 m^2";
}

TEST(Scenario, TwinsAreAlikeStayInContactAndSwapHalfOfTheTimes) {
  int swapped = 0, meetings = 0;
  double longest = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world(options_of("twins", seed, 40));
    ASSERT_EQ(world.cast().size(), 4U);
    EXPECT_EQ(world.cast()[0].clothing_key, world.cast()[1].clothing_key);
    EXPECT_EQ(world.cast()[2].clothing_key, world.cast()[3].clothing_key);
    EXPECT_NE(world.cast()[0].clothing_key, world.cast()[2].clothing_key);
    for (const std::size_t first : {std::size_t{0}, std::size_t{2}}) {
      bool contact = false;
      double since = 0;
      Eigen::Vector2d apart_before = Eigen::Vector2d::Zero();
      for (double t = 0; t <= 40; t += kStep) {
        const auto all = world.at(t);
        const Eigen::Vector2d apart = all[first].position_m - all[first + 1].position_m;
        if (!contact && apart.norm() < 0.75) {
          contact = true;
          since = t;
        } else if (contact && apart.norm() > 1.9) {
          contact = false;
          longest = std::max(longest, t - since);
          if (apart_before.norm() > 1.0) {
            ++meetings;
            swapped += apart.dot(apart_before) < 0 ? 1 : 0;
          }
        }
        if (!contact && apart.norm() > 1.9) {
          apart_before = apart;
        }
      }
    }
  }
  ASSERT_GT(meetings, 50);
  EXPECT_GT(longest, 5.0);
  EXPECT_GT(swapped, 0.35 * meetings);
  EXPECT_LT(swapped, 0.65 * meetings);
}

TEST(Scenario, CampusRunsAndTerraceIsCrowded) {
  double running = 0;
  std::size_t most_campus = 0, most_terrace = 0;
  std::map<std::size_t, PersonState> before;
  const auto inside = [](const World& world, const std::vector<PersonState>& all) {
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const auto& s) {
      return world.stage().area.contains(s.position_m);
    }));
  };
  over_seeds("campus", 8, [&](const World& world, double t, const auto& all) {
    most_campus = std::max(most_campus, inside(world, all));
    for (const PersonState& s : all) {
      running += t > 0 && before.contains(s.person) && world.stage().area.contains(s.position_m) &&
                         between(s, before[s.person]) > 0.25 && between(s, before[s.person]) < 0.5
                     ? 1
                     : 0;
      before[s.person] = s;
    }
  });
  over_seeds("terrace", 5, [&](const World& world, double, const auto& all) {
    most_terrace = std::max(most_terrace, inside(world, all));
  });
  EXPECT_EQ(most_campus, 4U);
  EXPECT_GT(running, 40);  // tenths of seconds
  EXPECT_GE(most_terrace, 8U);
  EXPECT_LE(most_terrace, 9U);
}

TEST(Scenario, StandingTwoOfFourStandStillForMoreThanAMinute) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    WorldOptions options = options_of("standing", seed);
    options.duration_s = 80;
    const World world(options);
    std::map<std::size_t, double> farthest_in_a_minute, farthest;
    std::map<std::size_t, Eigen::Vector2d> start;
    for (double t = 0.5; t < 80; t += 0.5) {
      for (const PersonState& s : world.at(t)) {
        const Eigen::Vector2d from = start.emplace(s.person, s.position_m).first->second;
        const double way = (s.position_m - from).norm();
        farthest[s.person] = std::max(farthest[s.person], way);
        if (t < 62) farthest_in_a_minute[s.person] = std::max(farthest_in_a_minute[s.person], way);
      }
    }
    int still = 0;
    for (const auto& [person, way] : farthest_in_a_minute) still += way < 0.3 ? 1 : 0;
    EXPECT_EQ(farthest_in_a_minute.size(), 4U);
    EXPECT_EQ(still, 2) << "seed " << seed;
    for (const auto& [person, way] : farthest) EXPECT_GT(way, 0.5) << "in the end all have moved";
  }
}

TEST(Scenario, NobodyWalksThroughFurnitureOrWalls) {
  for (const ScenarioInfo& info : World::scenarios()) {
    double deepest = 0;
    over_seeds(info.name, 4, [&](const World& world, double, const auto& all) {
      for (const PersonState& s : all) {
        for (const Furniture& thing : world.stage().furniture) {
          deepest = std::max(deepest, 0.18 - thing.footprint.distance(s.position_m));
        }
        if (world.stage().walls) {
          const double outside = world.stage().walls->grown(-0.15).distance(s.position_m);
          bool at_door = false;
          for (const Door& door : world.stage().doors) {
            const Eigen::Vector2d from = s.position_m - door.center_m;
            const double aside =
                std::abs(from.dot(Eigen::Vector2d(-door.inward.y(), door.inward.x())));
            at_door = at_door || from.dot(door.inward) < -0.45 ||
                      (from.dot(door.inward) < 0.5 && aside < door.width_m / 2 - 0.15);
          }
          if (!at_door) {
            deepest = std::max(deepest, outside);
          }
        }
      }
    });
    EXPECT_LE(deepest, 0.0) << info.name;
  }
}

}  // namespace
}  // namespace plaza::synthetic
