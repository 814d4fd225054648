#include "plaza/scoring/people.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "plaza/scoring/detection.h"

namespace plaza {
namespace {

using ::testing::ElementsAre;

TruePerson person(std::int64_t id, std::vector<TrueView> views) {
  TruePerson p;
  p.id = id;
  p.views = std::move(views);
  return p;
}

const Box kBox{0, 0, 10, 10};
const Box kHalf{0, 0, 10, 5};
const Box kElsewhere{500, 0, 10, 10};

PairedSequence paired(const std::vector<TruePerson>& people,
                      const std::vector<ResultPerson>& results) {
  GroundTruth truth;
  truth.people = people;
  PairedSequenceBuilder builder;
  add_people(builder, 0, truth, results, 0.3);
  return builder.build();
}

TEST(ViewOverlap, IsTheMeanOverTheViewsInWhichAPersonCounts) {
  const TruePerson p = person(1, {{0, kBox, 1.0}, {1, kBox, 0.2}, {2, kBox, 0.19}});
  EXPECT_DOUBLE_EQ(view_overlap(p, {1, {kBox, kHalf, kElsewhere}}), 0.75);
  EXPECT_DOUBLE_EQ(view_overlap(p, {1, {kBox, std::nullopt, kBox}}), 0.5)
      << "no box overlaps nothing";
  EXPECT_DOUBLE_EQ(view_overlap(p, {1, {}}), 0);
  EXPECT_DOUBLE_EQ(view_overlap(person(1, {}), {1, {kBox}}), 0);
}

TEST(AddPeople, PairsEveryoneOverAllViews) {
  const auto s = paired({person(7, {{0, kBox, 1}}), person(3, {{0, kElsewhere, 1}})},
                        {{20, {kElsewhere}}, {10, {kHalf}}, {30, {Box{900, 900, 1, 1}}}});
  ASSERT_EQ(s.frames.size(), 1U);
  EXPECT_THAT(s.frames[0].truth, ElementsAre(1, 0));
  EXPECT_THAT(s.frames[0].result, ElementsAre(1, 0, 2));
  EXPECT_EQ(s.frames[0].values, (Eigen::MatrixXd(2, 3) << 0, 0.5, 0, 1, 0, 0).finished());
}

TEST(AddPeople, HiddenPeopleAreNeitherWantedNorForbidden) {
  const auto s = paired({person(1, {{0, kBox, 1}}), person(2, {{0, kElsewhere, 0.1}})},
                        {{1, {kBox}}, {2, {kElsewhere}}, {3, {Box{900, 900, 1, 1}}}});
  EXPECT_EQ(s.truth_count, 1);
  EXPECT_EQ(s.result_count, 2)
      << "who follows the hidden one is left out, who follows nobody is not";
}

TEST(AddPeople, VisiblePeopleComeFirst) {
  // The result fits the visible person better than the hidden one.
  const auto s = paired({person(1, {{0, kBox, 1}}), person(2, {{0, kHalf, 0.0}})}, {{1, {kBox}}});
  EXPECT_EQ(s.truth_count, 1);
  EXPECT_EQ(s.result_count, 1);
}

TEST(AddPeople, WithoutABoxSomeoneTakesNoPart) {
  EXPECT_EQ(paired({person(1, {})}, {}).truth_count, 0);
}

TEST(BoxesInViews, MeasuredOnesComeFirst) {
  Scene scene;
  // Looks along +y, 2 m above the ground.
  CameraFromWorld pose;
  pose.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  pose.translation = -pose.rotation * Eigen::Vector3d(0, 0, 2);
  PinholeIntrinsics k;
  k.fx_px = k.fy_px = 500;
  k.cx_px = 320;
  k.cy_px = 240;
  scene.cameras.push_back(Camera::pinhole("a", {640, 480}, k, pose));
  scene.cameras.push_back(Camera::pinhole("b", {640, 480}, k, pose));
  const ViewBox measured{.camera = 1, .box = kBox, .score = 1};
  const auto boxes = boxes_in_views(scene, {0, 6}, {&measured, 1});
  ASSERT_EQ(boxes.size(), 2U);
  ASSERT_TRUE(boxes[0]);
  EXPECT_EQ(*boxes[0], *body_box(scene.cameras[0], {0, 6}, scene.body));
  EXPECT_EQ(*boxes[1], kBox);
  EXPECT_FALSE(boxes_in_views(scene, {0, -6}, {})[0]) << "behind the camera";
}

TEST(MatchPeople, CountsAsTheScoresDo) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> place(0, 60), sight(0, 1);
  for (int trial = 0; trial < 300; ++trial) {
    GroundTruth truth;
    std::vector<ResultPerson> results;
    const auto people = random() % 5, found = random() % 6;
    for (unsigned i = 0; i < people; ++i) {
      std::vector<TrueView> views = {{0, {place(random), 0, 20, 40}, sight(random)},
                                     {1, {place(random), 0, 20, 40}, sight(random) - 0.5}};
      views.resize(random() % 3);
      truth.people.push_back(person(i + 1, views));
    }
    for (unsigned j = 0; j < found; ++j) {
      results.push_back({j, {Box{place(random), 0, 20, 40}, Box{place(random), 0, 20, 40}}});
    }
    const PeopleMatch match = match_people(truth, results, 0.3);
    std::int64_t tp = 0, fn = 0, fp = 0;
    for (std::size_t i = 0; i < truth.people.size(); ++i) {
      if (match.counts[i]) ++(match.result_of[i] >= 0 ? tp : fn);
      if (match.result_of[i] >= 0) {
        EXPECT_EQ(match.person_of.at(static_cast<std::size_t>(match.result_of[i])), i);
      }
    }
    for (const int i : match.person_of) fp += i < 0 ? 1 : 0;
    PairedSequenceBuilder builder;
    add_people(builder, 0, truth, results, 0.3);
    const DetectionScores scores = score_overlap_detection(builder.build(), 0.3);
    EXPECT_EQ(tp, scores.tp) << trial;
    EXPECT_EQ(fn, scores.fn) << trial;
    EXPECT_EQ(fp, scores.fp) << trial;
  }
}

}  // namespace
}  // namespace plaza
