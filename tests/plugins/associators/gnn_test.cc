// Algorithm 2 of the thesis, and who is who.
#include "plugins/associators/gnn/gnn.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "plaza/contract/gtest.h"
#include "plaza/core/error.h"
#include "tests/plugins/associators/gnn_script.h"

namespace plaza {
namespace {

using ::testing::ElementsAre;
using testing::GnnScript;

Gnn::Options options() {
  Gnn::Options o;
  o.gate_m = 0.8;
  o.confirm = 3;
  o.max_count = 5;
  return o;
}

TEST(Gnn, ConfirmsAfterConsecutiveDetectionsFromTheFirstOneOn) {
  GnnScript script(options());
  EXPECT_TRUE(script.see({{0, 0}}).points.empty());
  EXPECT_TRUE(script.see({{0, 0}}).points.empty());
  EXPECT_EQ(script.see({{0, 0}}).points.size(), 3U);
  EXPECT_THAT(script.frames_of(1), ElementsAre(0, 1, 2));
  EXPECT_TRUE(script.final_points().at(0).at(1).observed);
}

TEST(Gnn, ConfirmationOfOneTakesEveryObservation) {
  Gnn::Options o = options();
  o.confirm = 1;
  GnnScript script(o);
  EXPECT_EQ(script.see({{0, 0}, {5, 5}}).points.size(), 2U);
  EXPECT_THAT(script.ids(), ElementsAre(1, 2));
}

TEST(Gnn, AMissLowersTheCounterAndAtZeroAnUnconfirmedTargetEnds) {
  GnnScript script(options());
  script.see({{0, 0}});                               // 1
  script.see_nobody();                                // 0: ended
  script.see({{0, 0}});                               // a new target, 1
  script.see({{0, 0}});                               // 2
  script.see_nobody();                                // 1
  EXPECT_TRUE(script.see({{0, 0}}).points.empty());   // 2
  EXPECT_FALSE(script.see({{0, 0}}).points.empty());  // 3: confirmed
  script.flush();
  EXPECT_THAT(script.frames_of(1), ElementsAre(2, 3, 4, 5, 6));
  EXPECT_FALSE(script.final_points().at(4).at(1).observed);
}

TEST(Gnn, LivesThroughMaxCountMinusOneMissesAndEndsAtMaxCount) {
  for (const int misses : {4, 5}) {
    GnnScript script(options());
    for (int i = 0; i < 20; ++i) script.see({{0, 0}});  // the counter stops at 5
    for (int i = 0; i < misses; ++i) script.see_nobody();
    for (int i = 0; i < 3; ++i) script.see({{0, 0}});
    script.flush();
    EXPECT_EQ(script.ids().size(), misses < 5 ? 1U : 2U) << misses;
    EXPECT_EQ(script.id_at(21, {0, 0}), misses < 5 ? 1 : 0);
  }
}

TEST(Gnn, ATargetOutsideTheGateIsANewOne) {
  GnnScript script(options());
  for (int i = 0; i < 5; ++i) script.see({{0, 0}});
  for (int i = 0; i < 5; ++i) script.see({{0.9, 0}});
  script.flush();
  EXPECT_EQ(script.ids().size(), 2U);
  GnnScript near(options());
  for (int i = 0; i < 5; ++i) near.see({{0, 0}});
  for (int i = 0; i < 5; ++i) near.see({{0.7, 0}});
  near.flush();
  EXPECT_EQ(near.ids().size(), 1U);
}

TEST(Gnn, TheMahalanobisGateIsNarrowerThanTheCircle) {
  Gnn::Options o = options();
  o.gate_sigma = 3;
  GnnScript script(o, 0.1);
  for (int i = 0; i < 20; ++i) script.see({{0, 0}});
  for (int i = 0; i < 5; ++i) script.see({{0.7, 0}});  // within the circle, 0.1 m noise
  script.flush();
  EXPECT_EQ(script.ids().size(), 2U);
}

/// Target A could take either observation, B only one: nearest first would leave B without.
TEST(Gnn, MakesAsManyPairsAsPossibleBeforeShortOnes) {
  GnnScript script(options());
  for (int i = 0; i < 10; ++i) script.see({{0, 0}, {1.0, 0}});
  script.see({{-0.7, 0}, {0.35, 0}});  // 0 is nearer to 0.35, which is all that 1.0 can reach
  script.flush();
  EXPECT_EQ(script.id_at(10, {-0.5, 0}), script.id_at(9, {0, 0}));
  EXPECT_EQ(script.id_at(10, {0.5, 0}), script.id_at(9, {1.0, 0}));
}

TEST(Gnn, CrossingPeopleKeepTheirIdentitiesByTheirVelocities) {
  GnnScript script(options(), 0.3);
  const auto a = [](int i) { return Eigen::Vector2d(-3 + 0.12 * i, -0.3 + 0.012 * i); };
  const auto b = [](int i) { return Eigen::Vector2d(3 - 0.12 * i, 0.3 - 0.012 * i); };
  for (int i = 0; i <= 50; ++i) {
    if (i >= 24 && i <= 26) {
      script.see({a(i)});  // they hide each other
    } else {
      i % 2 ? script.see({a(i), b(i)}) : script.see({b(i), a(i)});
    }
  }
  script.flush();
  EXPECT_EQ(script.ids().size(), 2U);
  EXPECT_EQ(script.id_at(0, a(0)), script.id_at(50, a(50)));
  EXPECT_EQ(script.id_at(0, b(0)), script.id_at(50, b(50)));
}

TEST(Gnn, ABurstOfFalseAlarmsIsNobody) {
  GnnScript script(options());
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> place(-9, 9);
  for (int i = 0; i < 30; ++i) {
    std::vector<Eigen::Vector2d> seen = {{0.1 * i - 1.5, 0}};
    if (i == 12) {
      for (int k = 0; k < 40; ++k)
        seen.emplace_back(place(random), 3 + 0.6 * std::abs(place(random)));
    }
    script.see(seen);
  }
  script.flush();
  EXPECT_THAT(script.ids(), ElementsAre(1));
  EXPECT_EQ(script.frames_of(1).size(), 30U);
}

TEST(Gnn, WeakObservationsContinueButDontStart) {
  Gnn::Options o = options();
  o.min_start_probability = 0.5;
  GnnScript script(o);
  for (int i = 0; i < 5; ++i) script.see({{0, 0}}, 0.3);
  for (int i = 0; i < 3; ++i) script.see({{0, 0}}, 0.6);
  for (int i = 0; i < 5; ++i) script.see({{0, 0}}, 0.3);
  script.flush();
  EXPECT_EQ(script.frames_of(1).size(), 8U);
  EXPECT_DOUBLE_EQ(script.final_points().at(12).at(1).score, 0.3);
}

TEST(Gnn, EmptyFramesAreNoTrouble) {
  GnnScript script(options());
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(script.see_nobody().points.empty());
  EXPECT_TRUE(script.flush().points.empty());
  EXPECT_TRUE(script.tracklets().empty());
}

/// Walks out over the border at x = 10, stays away, comes back at the same place.
void walk_out_and_back(GnnScript& script, int frames_away, bool seen_outside) {
  for (int i = 0; i < 20; ++i) script.see({{8.05 + 0.1 * i, 0}});
  for (int i = 0; i < frames_away; ++i) {
    const double x = 10.05 + 0.1 * std::min(i, frames_away - 1 - i);
    seen_outside ? script.see({{x, 0}}) : script.see_nobody();
  }
  for (int i = 0; i < 20; ++i) script.see({{9.95 - 0.1 * i, 0}});
  script.flush();
}

TEST(Gnn, WhoIsAwayLongIsNewOrKeptAsDeclared) {
  for (const bool seen_outside : {true, false}) {
    Gnn::Options o = options();
    o.reentry_s = 1.0;
    o.reentry = Gnn::Identity::kNew;
    GnnScript renewed(o);
    walk_out_and_back(renewed, 30, seen_outside);
    EXPECT_THAT(renewed.ids(), ElementsAre(1, 2)) << seen_outside;
    o.reentry = Gnn::Identity::kKeep;
    GnnScript kept(o);
    walk_out_and_back(kept, 30, seen_outside);
    EXPECT_THAT(kept.ids(), ElementsAre(1)) << seen_outside;
  }
}

TEST(Gnn, WhoIsAwayShortlyIsAlwaysKept) {
  for (const bool seen_outside : {true, false}) {
    for (const auto identity : {Gnn::Identity::kNew, Gnn::Identity::kKeep}) {
      Gnn::Options o = options();
      o.reentry_s = 2.0;
      o.reentry = identity;
      GnnScript script(o);
      walk_out_and_back(script, 12, seen_outside);
      EXPECT_THAT(script.ids(), ElementsAre(1)) << seen_outside;
    }
  }
}

TEST(Gnn, WhoVanishesInTheMiddleIsNotTakenForAReturn) {
  Gnn::Options o = options();
  o.reentry = Gnn::Identity::kKeep;
  GnnScript script(o);
  for (int i = 0; i < 10; ++i) script.see({{0, 0}});
  for (int i = 0; i < 10; ++i) script.see_nobody();
  for (int i = 0; i < 10; ++i) script.see({{0, 0}});
  script.flush();
  EXPECT_EQ(script.ids().size(), 2U);
}

TEST(Gnn, RefusesACounterThatConfirmsNobody) {
  Gnn::Options o = options();
  o.max_count = 2;
  try {
    GnnScript script(o);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    ASSERT_EQ(error.diagnostics().size(), 1U);
    EXPECT_EQ(error.diagnostics()[0].pointer, "/max_count");
    EXPECT_THAT(error.what(), ::testing::HasSubstr("'confirm'"));
  }
}

TEST(Gnn, RandomCrowdsGiveTheSameAnswerTwiceAndBreakNoPromise) {
  const auto play = [] {
    Gnn::Options o = options();
    o.smoothing_s = 0.35;
    o.coast_s = 0.2;
    o.reentry = Gnn::Identity::kKeep;
    GnnScript script(o);  // its checks are the promises
    std::mt19937_64 random(99);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Eigen::Vector2d> people, velocities;
    for (int i = 0; i < 12; ++i) {
      people.emplace_back(22 * unit(random) - 11, 22 * unit(random) - 11);
      velocities.emplace_back(0.3 * unit(random) - 0.15, 0.3 * unit(random) - 0.15);
    }
    for (int frame = 0; frame < 200; ++frame) {
      std::vector<Eigen::Vector2d> seen;
      for (std::size_t i = 0; i < people.size(); ++i) {
        people[i] += velocities[i];
        if (people[i].cwiseAbs().maxCoeff() > 12) velocities[i] = -velocities[i];
        if (unit(random) < 0.7) seen.push_back(people[i] + Eigen::Vector2d(0.1 * unit(random), 0));
      }
      if (unit(random) < 0.5) seen.emplace_back(20 * unit(random) - 10, 20 * unit(random) - 10);
      script.see(seen);
    }
    script.flush();
    std::vector<double> out;
    for (const auto& [frame, points] : script.final_points()) {
      for (const auto& [id, p] : points) {
        out.insert(out.end(), {double(frame), double(id), p.position_m.x(), p.position_m.y()});
      }
    }
    return out;
  };
  const std::vector<double> once = play();
  EXPECT_GT(once.size(), 1000U);
  EXPECT_EQ(once, play());
}

TEST(Gnn, KeepsTheContract) {
  contract::Trial trial;
  trial.finder = [](const std::string& name) -> std::optional<contract::Subject> {
    if (name != "constant-velocity") return std::nullopt;
    return contract::subject_of<ConstantVelocity>();
  };
  contract::expect_kept(contract::subject_of<Gnn>(), trial);
  trial.label = "smoothing, coasting, keeping identities";
  trial.values = {{"smoothing_s", 0.5}, {"coast_s", 0.3}, {"reentry", "keep"}, {"confirm", 1}};
  contract::expect_kept(contract::subject_of<Gnn>(), trial);
}

}  // namespace
}  // namespace plaza
