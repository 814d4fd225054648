#include "plugins/sources/synthetic/world/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "plaza/core/error.h"
#include "tests/plugins/sources/synthetic/world/world_support.h"

namespace plaza::synthetic {
namespace {

using ::testing::HasSubstr;

bool same(const std::vector<PersonState>& a, const std::vector<PersonState>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const PersonState& x, const PersonState& y) {
        if (x.person != y.person || x.position_m != y.position_m ||
            x.heading_rad != y.heading_rad) {
          return false;
        }
        for (std::size_t s = 0; s < kSegmentCount; ++s) {
          if (x.pose.world_from_segment[s].matrix() != y.pose.world_from_segment[s].matrix()) {
            return false;
          }
        }
        return true;
      });
}

TEST(World, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const World first(options_of("six-targets", 5));
  const World again(options_of("six-targets", 5));
  const World other(options_of("six-targets", 6));
  for (double t = 0; t <= 20; t += 1.7) {
    EXPECT_TRUE(same(first.at(t), again.at(t))) << t;
    EXPECT_FALSE(same(first.at(t), other.at(t))) << t;
  }
}

TEST(World, AnswersInAnyOrderFromAnyThread) {
  const World world(options_of("four-crossing", 2, 8));
  std::vector<std::vector<PersonState>> forward, backward(200);
  for (int k = 0; k < 200; ++k) {
    forward.push_back(world.at(0.04 * k));
  }
  std::vector<std::thread> threads;
  for (int part = 0; part < 4; ++part) {
    threads.emplace_back([&, part] {
      for (int k = 199 - part; k >= 0; k -= 4) {
        backward[static_cast<std::size_t>(k)] = world.at(0.04 * k);
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (std::size_t k = 0; k < 200; ++k) {
    EXPECT_TRUE(same(forward[k], backward[k])) << k;
  }
}

TEST(World, ALongerOneContinuesAShorterOne) {
  for (const ScenarioInfo& info : World::scenarios()) {
    const World brief(options_of(info.name, 3, 6));
    const World lengthy(options_of(info.name, 3, 30));
    for (double t = 0; t <= 6.4; t += 0.4) {
      EXPECT_TRUE(same(brief.at(t), lengthy.at(t))) << info.name << " at " << t;
      for (const PersonState& state : brief.at(t)) {
        EXPECT_EQ(brief.identity(state.person, t), lengthy.identity(state.person, t)) << info.name;
      }
    }
  }
}

TEST(World, GoesOnForTwoMinutesWithPeopleWhoMove) {
  for (const ScenarioInfo& info : World::scenarios()) {
    const World world(options_of(info.name, 1, 120));
    for (double t = 0; t < 120; t += 20) {
      double moved = 0;
      const std::vector<PersonState> before = world.at(t);
      EXPECT_GE(before.size(), 1U) << info.name << " at " << t;
      for (double later = t; later < t + 20; later += 1) {
        for (const PersonState& state : world.at(later)) {
          for (const PersonState& start : before) {
            moved = state.person == start.person ? std::max(moved, between(state, start)) : moved;
          }
        }
      }
      EXPECT_GT(moved, 0.25) << info.name << " at " << t;
    }
  }
}

TEST(World, GivesOneIdentityPerStayInTheArea) {
  bool someone_returned = false;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const World world(options_of("six-targets", seed, 100));
    std::map<std::size_t, std::size_t> person_of;           // by identity
    std::map<std::size_t, std::set<std::size_t>> stays_of;  // by person
    std::map<std::size_t, double> last_seen;                // by identity
    for (double t = 0; t <= 100; t += 0.2) {
      for (const PersonState& state : world.at(t)) {
        const auto identity = world.identity(state.person, t);
        EXPECT_EQ(identity.has_value(), world.stage().area.contains(state.position_m)) << t;
        if (!identity) {
          continue;
        }
        const auto known = person_of.emplace(*identity, state.person).first;
        EXPECT_EQ(known->second, state.person) << "an identity belongs to one person";
        if (last_seen.contains(*identity)) {
          EXPECT_LT(t - last_seen[*identity], 1.3) << "an identity ends with the stay";
        }
        last_seen[*identity] = t;
        stays_of[state.person].insert(*identity);
      }
    }
    for (const auto& [person, stays] : stays_of) {
      someone_returned = someone_returned || stays.size() > 1;
    }
    EXPECT_FALSE(world.identity(0, 50).has_value() && world.identity(999, 50).has_value());
  }
  EXPECT_TRUE(someone_returned);
}

TEST(World, ReachesHalfASecondBeyondBothEnds) {
  const World world(options_of("two-targets", 1, 4));
  EXPECT_FALSE(same(world.at(-0.3), world.at(0)));
  EXPECT_TRUE(same(world.at(-0.5), world.at(-7)));
  EXPECT_TRUE(same(world.at(4.5), world.at(100)));
}

TEST(World, HasAsManyPeopleAsAskedFor) {
  for (int people = 2; people <= 10; ++people) {
    WorldOptions options = options_of("crowd", 1, 10);
    options.people = people;
    const World world(options);
    EXPECT_EQ(world.at(5).size(), static_cast<std::size_t>(people));
  }
}

template <typename Change>
std::string refusal(Change change) {
  WorldOptions options = options_of("crowd", 1, 1);
  change(options);
  try {
    const World world(options);
  } catch (const UserError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(World, RefusesWhatCantBe) {
  EXPECT_THAT(refusal([](auto& o) { o.scenario = "three-crossing"; }),
              AllOf(HasSubstr("no scenario \"three-crossing\""), HasSubstr("four-crossing, six-")));
  EXPECT_THAT(refusal([](auto& o) { o.people = 11; }), HasSubstr("2 to 10"));
  EXPECT_THAT(refusal([](auto& o) { o.people = 1; }), HasSubstr("2 to 10"));
  EXPECT_THAT(refusal([](auto& o) {
                o.scenario = "twins";
                o.people = 6;
              }),
              AllOf(HasSubstr("its own number of people, 4"), HasSubstr("\"crowd\"")));
  EXPECT_THAT(refusal([](auto& o) {
                o.stage = indoor_stage({{0, 0}, {2.5, 6}});
              }),
              HasSubstr("3 m x 3 m"));
  EXPECT_THAT(refusal([](auto& o) { o.duration_s = -1; }), HasSubstr("lasts between"));
}

}  // namespace
}  // namespace plaza::synthetic
