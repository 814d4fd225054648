#include "plaza/scoring/detection_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "plaza/core/error.h"
#include "plaza/scoring/people.h"
#include "tests/sdk/geometry/test_cameras.h"

namespace plaza {
namespace {

using testing::HasSubstr;

/// A place of 20 m x 20 m, seen from 20 m south of its middle and 6 m above the ground; with a
/// second camera from the east.
std::shared_ptr<Scene> place(int cameras = 1) {
  auto scene = std::make_shared<Scene>();
  scene->area = {{-10, -10}, {10, 10}};
  scene->frame_rate_hz = 10;
  const PinholeIntrinsics k{700, 700, 319.5, 239.5, {}};
  scene->cameras.push_back(
      Camera::pinhole("south", {640, 480}, k, test::look_at({0, -20, 6}, {0, 0, 0.8})));
  if (cameras > 1) {
    scene->cameras.push_back(
        Camera::pinhole("east", {640, 480}, k, test::look_at({20, 0, 6}, {0, 0, 0.8})));
  }
  return scene;
}

TruePerson standing_at(const Scene& scene, std::int64_t id, double x, double y) {
  TruePerson person;
  person.id = id;
  person.position_m = Eigen::Vector2d(x, y);
  for (std::size_t camera = 0; camera < scene.cameras.size(); ++camera) {
    const auto box = body_box(scene.cameras[camera], *person.position_m, scene.body);
    if (box) person.views.push_back({camera, *box, 1.0});
  }
  return person;
}

Observation seen_at(double x, double y) {
  Observation o;
  o.position_m = {x, y};
  o.probability = 0.9;
  return o;
}

struct Case {
  std::shared_ptr<Scene> scene = place();
  ErrorRules rules;
  GroundTruth truth;
  Observations observations;

  void person(double x, double y) {
    truth.people.push_back(
        standing_at(*scene, static_cast<std::int64_t>(truth.people.size()) + 1, x, y));
  }
  void found(double x, double y) { observations.items.push_back(seen_at(x, y)); }
  FrameErrors sorted() const { return ErrorSorter(scene, rules).sort(truth, observations); }
};

TEST(DetectionErrors, APerfectResultHasNone) {
  Case c;
  c.person(0, 0);
  c.person(3, 2);
  c.found(0, 0);
  c.found(3, 2);
  const FrameErrors errors = c.sorted();
  EXPECT_EQ(errors.people.size(), 2U);
  EXPECT_TRUE(errors.misses.empty());
  EXPECT_TRUE(errors.alarms.empty());
}

TEST(DetectionErrors, WhoIsInSightAndNotFoundIsUnexplained) {
  Case c;
  c.person(0, 0);
  const FrameErrors errors = c.sorted();
  ASSERT_EQ(errors.misses.size(), 1U);
  EXPECT_EQ(errors.misses[0].kind, MissKind::kUnexplained);
  EXPECT_EQ(errors.misses[0].sight.standing, Standing::kInSight);
  EXPECT_DOUBLE_EQ(errors.misses[0].sight.border_m, 10);
}

TEST(DetectionErrors, BehindAnOccluderOfTheSceneOrOfTheRules) {
  Case c;
  c.person(0, 0);
  const Box box = c.truth.people[0].views[0].box;
  const Eigen::Vector2d a(box.left, box.top), b(box.right(), box.top + 0.4 * box.height);
  const std::vector<Eigen::Vector2d> upper = {a, {b.x(), a.y()}, b, {a.x(), b.y()}};
  c.scene->occluders.push_back({"south", "plate", upper});
  EXPECT_EQ(c.sorted().misses.at(0).kind, MissKind::kBehindOccluder);
  EXPECT_NEAR(c.sorted().misses.at(0).sight.behind_occluder, 0.4, 0.02);
  c.rules.hidden_share = 0.5;
  EXPECT_EQ(c.sorted().misses.at(0).kind, MissKind::kUnexplained) << "not covered enough";

  c.rules = {};
  c.rules.occluders = {{"south", {{{0, 0}, {10, 0}, {10, 10}}}}};
  EXPECT_EQ(c.sorted().misses.at(0).kind, MissKind::kUnexplained) << "instead of the scene's";
  c.scene->occluders.clear();
  c.rules.occluders["south"] = {{{a.x(), a.y()}, {b.x(), a.y()}, {b.x(), b.y()}, {a.x(), b.y()}}};
  EXPECT_EQ(c.sorted().misses.at(0).kind, MissKind::kBehindOccluder);
}

TEST(DetectionErrors, BehindPeopleOnlyWhereTheyAreNearer) {
  Case c;
  c.person(0, 2);
  c.person(0.1, -2);
  const FrameErrors errors = c.sorted();
  ASSERT_EQ(errors.misses.size(), 2U);
  EXPECT_EQ(errors.misses[0].kind, MissKind::kBehindPeople);
  EXPECT_GT(errors.misses[0].sight.behind_people, 0.3);
  EXPECT_EQ(errors.misses[1].kind, MissKind::kUnexplained);
  EXPECT_EQ(errors.misses[1].sight.behind_people, 0);
}

TEST(DetectionErrors, SeveralViewsAreTakenInTheMean) {
  Case c;
  c.scene = place(2);
  c.person(0, 2);
  c.person(0.1, -2);
  const FrameErrors errors = c.sorted();
  ASSERT_EQ(errors.misses.size(), 2U);
  const double one_view = [] {
    Case single;
    single.person(0, 2);
    single.person(0.1, -2);
    return single.sorted().misses[0].sight.behind_people;
  }();
  EXPECT_NEAR(errors.misses[0].sight.behind_people, one_view / 2, 1e-12)
      << "the eastern camera sees both apart";
}

TEST(DetectionErrors, AtTheBorderOfTheAreaAndOfTheImage) {
  Case c;
  c.person(9.8, 0);
  EXPECT_EQ(c.sorted().misses.at(0).kind, MissKind::kAtBorder);
  c.truth.people[0] = standing_at(*c.scene, 1, 0, 0);
  c.truth.people[0].views[0].box = {-30, 100, 60, 100};
  EXPECT_EQ(c.sorted().misses.at(0).kind, MissKind::kAtBorder);
  EXPECT_NEAR(c.sorted().misses.at(0).sight.cut, 29.5 / 60, 1e-12);
  c.truth.people[0].views[0].box.left = -5;
  EXPECT_EQ(c.sorted().misses.at(0).kind, MissKind::kUnexplained);
}

TEST(DetectionErrors, NearAnother) {
  Case c;
  c.person(0, 0);
  c.person(0.5, 0);
  c.found(0.5, 0);
  const FrameErrors errors = c.sorted();
  ASSERT_EQ(errors.misses.size(), 1U);
  EXPECT_EQ(errors.misses[0].sight.person, 0U);
  EXPECT_EQ(errors.misses[0].kind, MissKind::kNearAnother);
}

TEST(DetectionErrors, HiddenByWhatNobodyDescribed) {
  Case c;
  c.person(0, 0);
  c.truth.people[0].views[0].visibility = 0.5;
  EXPECT_EQ(c.sorted().misses.at(0).kind, MissKind::kHidden);
  c.truth.people[0].views[0].visibility = 0.1;
  EXPECT_TRUE(c.sorted().people.empty()) << "who counts in no view is no miss";
}

TEST(DetectionErrors, AMissAndTheAlarmBesideItAreOneDisplacement) {
  Case c;
  c.person(0, 0);
  c.found(0.9, 0);
  const FrameErrors errors = c.sorted();
  ASSERT_EQ(errors.misses.size(), 1U);
  ASSERT_EQ(errors.alarms.size(), 1U);
  EXPECT_EQ(errors.misses[0].kind, MissKind::kDisplaced);
  EXPECT_EQ(errors.misses[0].alarm, 0U);
  EXPECT_EQ(errors.alarms[0].kind, AlarmKind::kDisplaced);
  EXPECT_EQ(errors.alarms[0].person, 0U);
}

TEST(DetectionErrors, OnlyOneAlarmIsPairedWithAMiss) {
  Case c;
  c.person(0, 0);
  c.found(-0.95, 0);
  c.found(0.9, 0);
  const FrameErrors errors = c.sorted();
  ASSERT_EQ(errors.alarms.size(), 2U);
  EXPECT_EQ(errors.alarms[1].kind, AlarmKind::kDisplaced) << "the nearer one";
  EXPECT_EQ(errors.alarms[0].kind, AlarmKind::kUnexplained);
}

TEST(DetectionErrors, FalseAlarmsByKind) {
  Case c;
  c.person(0, -2);
  c.found(0, -2);
  c.found(0.8, -2);  // beside somebody who was found
  c.found(0, 2);     // behind him, in line
  c.found(9.9, 4);   // at the border
  c.found(5, 5);     // for no reason
  const FrameErrors errors = c.sorted();
  ASSERT_EQ(errors.alarms.size(), 4U);
  EXPECT_EQ(errors.alarms[0].kind, AlarmKind::kDuplicate);
  EXPECT_EQ(errors.alarms[0].person, 0U);
  EXPECT_EQ(errors.alarms[1].kind, AlarmKind::kGhost);
  EXPECT_EQ(errors.alarms[1].person, 0U);
  EXPECT_EQ(errors.alarms[2].kind, AlarmKind::kAtBorder);
  EXPECT_EQ(errors.alarms[3].kind, AlarmKind::kUnexplained);
  EXPECT_FALSE(errors.alarms[3].person);
}

TEST(DetectionErrors, AGhostIsInLineInEveryView) {
  Case c;
  c.scene = place(2);
  c.person(0, -2);
  c.found(0, -2);
  c.found(0, 2);
  EXPECT_EQ(c.sorted().alarms.at(0).kind, AlarmKind::kUnexplained)
      << "nobody is in line with it in the eastern view";
  c.person(2, 2.1);
  c.found(2, 2.1);
  EXPECT_EQ(c.sorted().alarms.at(0).kind, AlarmKind::kGhost);
}

TEST(DetectionErrors, WithoutPositionsBoxesStandOnTheGround) {
  Case c;
  c.person(0, 0);
  c.truth.people[0].position_m.reset();
  const FrameErrors errors = c.sorted();
  ASSERT_TRUE(errors.misses.at(0).sight.position_m);
  EXPECT_LT(errors.misses[0].sight.position_m->norm(), 0.5) << "the rim's nearest point";
}

TEST(DetectionErrors, FramesThatNobodyAnnotatedHaveNone) {
  Case c;
  c.person(0, 0);
  c.found(4, 4);
  c.truth.annotated = false;
  EXPECT_TRUE(c.sorted().misses.empty());
  EXPECT_TRUE(c.sorted().alarms.empty());
}

TEST(DetectionErrors, EveryKindHasANameOfItsOwn) {
  EXPECT_EQ(to_string(MissKind::kDisplaced), "displaced");
  EXPECT_EQ(to_string(AlarmKind::kUnexplained), "unexplained");
  for (std::size_t i = 0; i + 1 < kStandings; ++i) {
    EXPECT_EQ(to_string(static_cast<Standing>(i)), to_string(static_cast<MissKind>(i)));
  }
}

TEST(DetectionErrors, OccludersAreChecked) {
  const auto message_of = [](const decltype(ErrorRules::occluders)& occluders) {
    ErrorRules rules;
    rules.occluders = occluders;
    try {
      ErrorSorter(place(), rules);
    } catch (const UserError& error) {
      return std::string(error.diagnostics().at(0).pointer) + ": " + error.what();
    }
    return std::string();
  };
  EXPECT_THAT(message_of({{"north", {}}}), HasSubstr("/occluders/north: "));
  EXPECT_THAT(message_of({{"south", {{{0, 0}, {1, 1}}}}}), HasSubstr("/occluders/south/0: "));
  EXPECT_THAT(message_of({{"south", {{{0, 0}, {1, 1}, {2}}}}}),
              HasSubstr("/occluders/south/0/2: "));
}

TEST(CoveredShare, IsOfTheUnion) {
  const Box box{0, 0, 100, 200};
  const std::vector<std::vector<Eigen::Vector2d>> left = {{{0, 0}, {50, 0}, {50, 200}, {0, 200}}};
  const std::vector<Box> upper = {{-10, -10, 200, 110}, {0, 0, 30, 100}};
  EXPECT_EQ(covered_share(box, {}, {}), 0);
  EXPECT_DOUBLE_EQ(covered_share(box, left, {}), 0.5);
  EXPECT_DOUBLE_EQ(covered_share(box, {}, upper), 0.5);
  EXPECT_DOUBLE_EQ(covered_share(box, left, upper), 0.75);
  // a concave one: an L of three quarters
  const std::vector<std::vector<Eigen::Vector2d>> l = {
      {{0, 0}, {50, 0}, {50, 100}, {100, 100}, {100, 200}, {0, 200}}};
  EXPECT_DOUBLE_EQ(covered_share(box, l, {}), 0.75);
}

}  // namespace
}  // namespace plaza
