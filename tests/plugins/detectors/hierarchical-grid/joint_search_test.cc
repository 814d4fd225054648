// People inferred together, by what the others don't account for.
#include "plugins/detectors/hierarchical-grid/joint_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/plugins/detectors/hierarchical-grid/grid_rig.h"

namespace plaza {
namespace {

using test::Rig;
using test::small_scene;
using Inference = HierarchicalGrid::Inference;

HierarchicalGrid::Options options_of(Inference inference, int rounds = 3) {
  HierarchicalGrid::Options o = Rig::defaults();
  o.inference = inference;
  o.rounds = rounds;
  o.refine_above = 0;
  o.separation_m = 0.5;
  o.smoothing_m = 0.1;
  return o;
}

struct Errors {
  int missed = 0, invented = 0;
  double distance_m = 0;  ///< sum over those found
  int all() const { return missed + invented; }
};

/// Whoever is found within 0.4 m, nearest first.
Errors errors_of(const std::vector<Observation>& found, const std::vector<Eigen::Vector2d>& truth) {
  struct Pair {
    double distance_m;
    std::size_t observation, person;
  };
  std::vector<Pair> pairs;
  for (std::size_t o = 0; o < found.size(); ++o) {
    for (std::size_t p = 0; p < truth.size(); ++p) {
      pairs.push_back({(found[o].position_m - truth[p]).norm(), o, p});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.distance_m < b.distance_m; });
  std::vector<char> used(found.size(), 0), met(truth.size(), 0);
  Errors errors;
  for (const Pair& pair : pairs) {
    if (pair.distance_m > 0.4 || used[pair.observation] != 0 || met[pair.person] != 0) continue;
    used[pair.observation] = met[pair.person] = 1;
    errors.distance_m += pair.distance_m;
  }
  errors.missed = static_cast<int>(std::count(met.begin(), met.end(), 0));
  errors.invented = static_cast<int>(std::count(used.begin(), used.end(), 0));
  return errors;
}

/// Five people at least 0.7 m apart.
std::vector<Eigen::Vector2d> crowd(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1.8, 1.8);
  std::vector<Eigen::Vector2d> people;
  while (people.size() < 5) {
    const Eigen::Vector2d next(place(random), place(random));
    const bool free = std::all_of(people.begin(), people.end(), [&](const Eigen::Vector2d& p) {
      return (p - next).norm() > 0.7;
    });
    if (free) people.push_back(next);
  }
  return people;
}

/// The same crowds of five each time.
Errors errors_in_crowds(const HierarchicalGrid::Options& options, int cameras) {
  const Rig rig(small_scene(cameras), options);
  std::mt19937 random(7);
  Errors sum;
  for (unsigned trial = 0; trial < 12; ++trial) {
    const std::vector<Eigen::Vector2d> people = crowd(random);
    const Errors e =
        errors_of(rig.run(rig.draw(people, 0.02, trial)).detected.observations.items, people);
    sum.missed += e.missed;
    sum.invented += e.invented;
    sum.distance_m += e.distance_m;
  }
  return sum;
}

TEST(JointSearch, ACrowdIsFoundWhereEachAloneIsNot) {
  const Errors independent = errors_in_crowds(options_of(Inference::kIndependent), 2);
  const Errors greedy = errors_in_crowds(options_of(Inference::kGreedy), 2);
  EXPECT_LT(2 * greedy.all(), independent.all())
      << greedy.missed << " missed and " << greedy.invented << " invented instead of "
      << independent.missed << " and " << independent.invented << ", of 60";
}

TEST(JointSearch, JudgingAgainMendsWhatWasAcceptedTooSoon) {
  const Errors once = errors_in_crowds(options_of(Inference::kGreedy, 0), 3);
  const Errors again = errors_in_crowds(options_of(Inference::kGreedy, 3), 3);
  EXPECT_LT(again.all(), once.all());
}

/// Circles of four people, who hide each other in every view.
Errors errors_in_circles(const HierarchicalGrid::Options& options) {
  const Rig rig(small_scene(4), options);
  Errors sum;
  for (const double radius_m : {0.5, 0.6, 0.7, 0.8}) {
    for (int turn = 0; turn < 6; ++turn) {
      std::vector<Eigen::Vector2d> people;
      for (int i = 0; i < 4; ++i) {
        const double angle = M_PI / 2 * i + 0.25 * turn;
        people.push_back(radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      }
      const auto seen = rig.draw(people, 0.02, static_cast<unsigned>(turn));
      const Errors e = errors_of(rig.run(seen).detected.observations.items, people);
      sum.missed += e.missed;
      sum.invented += e.invented;
      sum.distance_m += e.distance_m;
    }
  }
  return sum;
}

TEST(JointSearch, WhoeverIsDoubtedMayBeTwo) {
  HierarchicalGrid::Options o = options_of(Inference::kGreedy);
  const Errors believed = errors_in_circles(o);
  o.doubt_score = 100;
  const Errors doubted = errors_in_circles(o);
  EXPECT_LT(doubted.missed, believed.missed);
  EXPECT_LT(doubted.all(), believed.all())
      << doubted.missed << " missed and " << doubted.invented << " invented instead of "
      << believed.missed << " and " << believed.invented << ", of 96";
  o.doubt_score = -100;  // nobody scores so little
  const Errors never = errors_in_circles(o);
  EXPECT_EQ(never.all(), believed.all());
  EXPECT_EQ(never.distance_m, believed.distance_m);
}

TEST(JointSearch, MoreOfTheWeakAndMorePlacesMayBeTried) {
  const auto errors = [](int people, int starts, int cameras) {
    HierarchicalGrid::Options o = options_of(Inference::kGreedy);
    o.doubt_score = 100;
    o.doubt_people = people;
    o.doubt_starts = starts;
    return errors_in_crowds(o, cameras);
  };
  EXPECT_NE(errors(4, 1, 1).distance_m, errors(1, 1, 1).distance_m);
  EXPECT_NE(errors(1, 4, 1).distance_m, errors(1, 1, 1).distance_m);
  EXPECT_LT(errors(4, 4, 2).missed, errors(1, 1, 2).missed);
}

TEST(JointSearch, PlacesThatNothingSpeaksForNeedNotBeWatched) {
  const Errors all = errors_in_crowds(options_of(Inference::kGreedy), 3);
  HierarchicalGrid::Options o = options_of(Inference::kGreedy);
  o.watch_score = 0.25 * o.min_score;
  const Errors promising = errors_in_crowds(o, 3);
  EXPECT_LE(promising.all(), all.all() + 1);
  // with no place watched, nobody is found who is somebody only by what the others leave
  o = options_of(Inference::kGreedy, 0);
  const Errors once = errors_in_crowds(o, 3);
  o.watch_score = 1e6;
  const Errors never = errors_in_crowds(o, 3);
  EXPECT_GT(never.missed, once.missed) << never.invented << ' ' << once.invented;
}

TEST(JointSearch, NobodyIsNobody) {
  for (const Inference inference : {Inference::kGreedy, Inference::kMeanField}) {
    const Rig rig(small_scene(3), options_of(inference));
    EXPECT_TRUE(rig.run(rig.draw({}, 0.02, 1)).detected.observations.items.empty());
    EXPECT_TRUE(rig.run(std::vector<cv::Mat>(3)).detected.observations.items.empty());
  }
}

/// Of the rig's own scores: half of those with the threshold's score are somebody.
HierarchicalGrid::Options mean_field_options() {
  HierarchicalGrid::Options o = options_of(Inference::kMeanField);
  o.probability = {{0.5 * o.min_score, 0.01}, {o.min_score, 0.5}, {1.5 * o.min_score, 0.99}};
  return o;
}

TEST(JointSearch, InAMeanFieldACrowdIsFoundAsWell) {
  const Errors independent = errors_in_crowds(options_of(Inference::kIndependent), 2);
  const Errors field = errors_in_crowds(mean_field_options(), 2);
  EXPECT_LT(2 * field.all(), independent.all())
      << field.missed << " missed and " << field.invented << " invented instead of "
      << independent.missed << " and " << independent.invented << ", of 60";
}

TEST(JointSearch, InAMeanFieldWhoStandsAloneHasTheirOwnScore) {
  HierarchicalGrid::Options greedy = mean_field_options();
  greedy.accept_score = greedy.min_score;  // no ghosts, who would claim a part
  const Rig field(small_scene(4), greedy);
  greedy.inference = Inference::kGreedy;
  const Rig plain(small_scene(4), greedy);
  const auto views = field.draw({{0.33, -1.21}}, 0.02, 3);
  const auto one = field.run(views).detected.observations.items;
  const auto same = plain.run(views).detected.observations.items;
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(same.size(), 1U);
  EXPECT_NEAR(one[0].score, same[0].score, 1e-9);
}

TEST(JointSearch, InAMeanFieldUncertainNeighboursTakeAwayInPart) {
  // two who hide each other in one view: the score of each is between those with the other present
  // for certain and absent for certain
  const std::vector<Eigen::Vector2d> two = {{0, 0.35}, {0, -0.35}};
  const auto score_with = [&](double presence) {
    HierarchicalGrid::Options o = mean_field_options();
    o.probability = {{0, presence}};
    const Rig rig(small_scene(2), o);
    const auto found = rig.run(rig.draw(two, 0.03, 9)).detected.observations.items;
    EXPECT_EQ(found.size(), 2U) << presence;
    double sum = 0;
    for (const Observation& o2 : found) sum += o2.score;
    return sum;
  };
  const double present = score_with(0.995), half = score_with(0.6), rather = score_with(0.8);
  EXPECT_NE(half, present);
  EXPECT_TRUE(std::min(half, present) < rather && rather < std::max(half, present))
      << half << ' ' << rather << ' ' << present;
}

TEST(JointSearch, OnePersonIsFoundOnceAndWhereTheOthersWouldBeFoundAlone) {
  const Rig greedy(small_scene(4), options_of(Inference::kGreedy));
  const Rig independent(small_scene(4), options_of(Inference::kIndependent));
  const auto views = greedy.draw({{0.33, -1.21}}, 0.02, 3);
  const auto one = greedy.run(views).detected.observations.items;
  const auto same = independent.run(views).detected.observations.items;
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(same.size(), 1U);
  EXPECT_LT((one[0].position_m - same[0].position_m).norm(), 1e-9);
  EXPECT_NEAR(one[0].probability, same[0].probability, 1e-9);
  EXPECT_EQ(one[0].boxes.size(), 4U);
}

TEST(JointSearch, TakesNoMoreThanMost) {
  HierarchicalGrid::Options options = options_of(Inference::kGreedy);
  options.most = 2;
  const Rig rig(small_scene(4), options);
  const auto views = rig.draw({{-2, -2}, {2, 2}, {-2, 2}, {2, -2}}, 0.02, 3);
  EXPECT_EQ(rig.run(views).detected.observations.items.size(), 2U);
}

TEST(JointSearch, SmallPeopleGetSmallBoxes) {
  HierarchicalGrid::Options options = options_of(Inference::kGreedy);
  options.sizes = {0.85};
  options.size_sigma = 0.3;
  const Rig rig(small_scene(3), options);
  const auto height = [&](double scale) {
    const auto found = rig.run(rig.draw({{0.4, 0.8}}, 0.01, 5, scale)).detected.observations.items;
    EXPECT_EQ(found.size(), 1U);
    return found.at(0).boxes.at(0).box.height;
  };
  const double own = height(1), small = height(0.85);
  EXPECT_NEAR(small / own, 0.85, 0.03);
}

TEST(JointSearch, AnUnlikelySizeNeedsEvidence) {
  HierarchicalGrid::Options options = options_of(Inference::kGreedy);
  options.sizes = {0.97};
  options.size_sigma = 0.001;  // so narrow that nothing speaks for another size
  const Rig rig(small_scene(2), options), plain(small_scene(2), options_of(Inference::kGreedy));
  const auto views = rig.draw({{0.4, 0.8}}, 0.01, 5, 0.97);
  const auto a = rig.run(views).detected.observations.items;
  const auto b = plain.run(views).detected.observations.items;
  ASSERT_EQ(a.size(), 1U);
  ASSERT_EQ(b.size(), 1U);
  EXPECT_EQ(a[0].boxes.at(0).box.height, b[0].boxes.at(0).box.height);
}

}  // namespace
}  // namespace plaza
