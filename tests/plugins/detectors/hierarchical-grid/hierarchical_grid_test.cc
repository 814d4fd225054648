#include "plugins/detectors/hierarchical-grid/hierarchical_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "plaza/contract/gtest.h"
#include "tests/plugins/detectors/hierarchical-grid/grid_rig.h"

namespace plaza {
namespace {

using test::Rig;
using test::small_scene;

/// The best cell's centre.
Eigen::Vector2d best_of(const GroundLikelihood& likelihood) {
  std::size_t best = 0;
  double value = -1e300;
  for (std::size_t i = 0; i < likelihood.joint.size(); ++i) {
    if (likelihood.joint[i] > value) best = i, value = likelihood.joint[i];
  }
  const auto columns = static_cast<std::size_t>(likelihood.grid.columns);
  return likelihood.grid.origin_m +
         likelihood.grid.step_m.cwiseProduct(Eigen::Vector2d(static_cast<double>(best % columns),
                                                             static_cast<double>(best / columns)));
}

TEST(HierarchicalGrid, PeaksAtTheTrueCellInEveryNumberOfViews) {
  for (int views = 1; views <= 7; ++views) {
    const Rig rig(small_scene(views));
    std::mt19937 random(static_cast<unsigned>(views));
    std::uniform_int_distribution<int> cell(8, 23);
    for (int trial = 0; trial < 4; ++trial) {
      const GroundGrid& grid = rig.detector().grid().finest();
      const Eigen::Vector2d truth =
          grid.origin_m + grid.step_m.cwiseProduct(Eigen::Vector2d(cell(random), cell(random)));
      const auto outcome = rig.run(rig.draw({truth}, 0.05, static_cast<unsigned>(trial)));
      EXPECT_TRUE(best_of(*outcome.detected.likelihood).isApprox(truth, 1e-9))
          << views << " views: " << best_of(*outcome.detected.likelihood).transpose()
          << " instead of " << truth.transpose();
      // one or two views have ghosts, where silhouettes cross or a part looks like a whole
      ASSERT_GE(outcome.detected.observations.items.size(), 1U) << views << " views";
      EXPECT_LE(outcome.detected.observations.items.size(), views > 2 ? 1U : 3U)
          << views << " views";
      const Observation& o = outcome.detected.observations.items[0];
      EXPECT_LT((o.position_m - truth).norm(), 0.2);
      EXPECT_FALSE(o.heading_rad) << "a cylinder has no heading";
      EXPECT_EQ(o.boxes.size(), static_cast<std::size_t>(views));
    }
  }
}

TEST(HierarchicalGrid, FindsSeveralPeople) {
  const Rig rig(small_scene(4));
  const std::vector<Eigen::Vector2d> people = {{-2.1, -1.3}, {1.2, 2.4}, {2.3, -2.2}};
  const auto found = rig.run(rig.draw(people, 0.02, 1)).detected.observations.items;
  ASSERT_EQ(found.size(), people.size());
  for (const Eigen::Vector2d& person : people) {
    double nearest = 1e9;
    for (const Observation& o : found) nearest = std::min(nearest, (o.position_m - person).norm());
    EXPECT_LT(nearest, 0.2);
  }
}

TEST(HierarchicalGrid, CoarseToFineFindsWhatTheExhaustiveSearchFinds) {
  const Rig rig(small_scene(3));
  HierarchicalGrid::Options everywhere = Rig::defaults();
  everywhere.refine_above = 0;
  const auto exhaustive = rig.make(everywhere);
  exhaustive->learner()->finish(0);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-3.5, 3.5);
  std::size_t evaluated = 0, cells = 0;
  for (unsigned trial = 0; trial < 10; ++trial) {
    const auto views =
        rig.draw({{place(random), place(random)}, {place(random), place(random)}}, 0.02, trial);
    const auto fast = rig.run(views), slow = rig.run(*exhaustive, views);
    EXPECT_TRUE(best_of(*fast.detected.likelihood).isApprox(best_of(*slow.detected.likelihood)));
    EXPECT_EQ(fast.detected.observations.items.size(), slow.detected.observations.items.size());
    EXPECT_EQ(slow.search.evaluated - slow.search.exhaustive,
              rig.detector().grid().size(0) + rig.detector().grid().size(1));
    evaluated += fast.search.evaluated;
    cells += fast.search.exhaustive;
  }
  EXPECT_LT(evaluated, cells) << "the hierarchy saves hardly any work";
}

TEST(HierarchicalGrid, CellsBelowTheMeanInheritTheirParentsValue) {
  const Rig rig(small_scene(2));
  const auto result = rig.run(rig.draw({{0.5, 0.5}}, 0.02, 1)).search;
  const StateGrid& grid = rig.detector().grid();
  std::size_t inherited = 0;
  for (std::size_t level = 1; level < grid.levels(); ++level) {
    for (CellIndex cell = 0; cell < grid.size(level); ++cell) {
      if (result.levels[level].evaluated[cell] != 0) continue;
      ++inherited;
      EXPECT_EQ(result.levels[level].joint[cell],
                result.levels[level - 1].joint[grid.parent(level, cell)]);
    }
  }
  EXPECT_GT(inherited, grid.size(1));
}

TEST(HierarchicalGrid, ACellGainsNothingByBeingSeenLess) {
  // the same empty noise everywhere, but the second view sees half of the area only
  auto scene = small_scene(1);
  scene->cameras.push_back(
      testing::looking_camera("aside", {12, -9, 4}, {4.5, 1.5, 0.9}).scaled({213, 160}));
  HierarchicalGrid::Options options = Rig::defaults();
  options.refine_above = 0;
  const Rig rig(scene, options);
  const auto likelihood = rig.run(rig.draw({}, 0.3, 3)).detected.likelihood;
  double seen_by_both = 0, seen_by_one = 0;
  int both = 0, one = 0;
  for (std::size_t i = 0; i < likelihood->joint.size(); ++i) {
    if (std::isnan(likelihood->views[0][i])) continue;
    const bool aside = !std::isnan(likelihood->views[1][i]);
    (aside ? seen_by_both : seen_by_one) += likelihood->joint[i];
    ++(aside ? both : one);
  }
  ASSERT_GT(both, 50);
  ASSERT_GT(one, 50);
  EXPECT_NEAR(seen_by_both / both, seen_by_one / one, 0.1);
}

TEST(HierarchicalGrid, PeopleInTheMarginAreCut) {
  const Rig rig(small_scene(4));
  const auto found = rig.run(rig.draw({{4.6, 0.3}, {3.5, -2}}, 0, 1)).detected.observations.items;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT((found[0].position_m - Eigen::Vector2d(3.5, -2)).norm(), 0.2);
}

TEST(HierarchicalGrid, AllGivesTheBestCellsForNetworksOfCells) {
  HierarchicalGrid::Options options = Rig::defaults();
  options.maxima = HierarchicalGrid::Maxima::kAll;
  options.most = 30;
  options.min_score = 0.1;
  const Rig rig(small_scene(3), options);
  const Observations all = rig.run(rig.draw({{1, 1}, {-2, 0}}, 0.02, 1)).detected.observations;
  ASSERT_TRUE(all.grid);
  EXPECT_EQ(all.items.size(), 30U);
  for (const Observation& o : all.items) {
    const Eigen::Vector2d at = (o.position_m - all.grid->origin_m).cwiseQuotient(all.grid->step_m);
    EXPECT_NEAR(at.x(), std::round(at.x()), 1e-9) << "not on the grid";
    EXPECT_NEAR(at.y(), std::round(at.y()), 1e-9);
  }
}

TEST(HierarchicalGrid, CovariancesAreScaledAndNothingElse) {
  const Rig rig(small_scene(4));
  HierarchicalGrid::Options options = Rig::defaults();
  options.covariance_scale = 0.4;
  const auto scaled = rig.make(options);
  scaled->learner()->finish(0);
  const auto views = rig.draw({{-2.1, -1.3}, {1.2, 2.4}}, 0.02, 1);
  const auto plain = rig.run(views).detected.observations.items;
  const auto other = rig.run(*scaled, views).detected.observations.items;
  ASSERT_EQ(plain.size(), 2U);
  ASSERT_EQ(other.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_TRUE(other[i].covariance_m2.isApprox(0.4 * plain[i].covariance_m2, 1e-12));
    EXPECT_EQ(other[i].position_m, plain[i].position_m);
    EXPECT_EQ(other[i].score, plain[i].score);
  }
}

TEST(HierarchicalGrid, NothingIsFoundWhereNothingCanBeSeen) {
  const Rig rig(small_scene(3));
  for (const int level : {0, 255}) {
    std::vector<cv::Mat> views;
    for (const Camera& c : rig.scene().cameras)
      views.emplace_back(c.height(), c.width(), CV_8UC3, cv::Scalar::all(level));
    const auto outcome = rig.run(views);
    EXPECT_TRUE(outcome.detected.observations.items.empty()) << "images of " << level;
  }
  const auto blind = rig.run(std::vector<cv::Mat>(3)).detected;
  EXPECT_TRUE(blind.observations.items.empty());
  for (const double v : blind.likelihood->joint) EXPECT_TRUE(std::isnan(v)) << "unknown, not zero";
}

TEST(HierarchicalGrid, ACameraThatSeesNothingOfTheAreaSaysNothing) {
  auto scene = small_scene(2);
  auto away = testing::looking_camera("away", {20, 0, 3}, {40, 0, 1}).scaled({213, 160});
  scene->cameras.push_back(away);
  const Rig rig(scene);
  const auto with = rig.run(rig.draw({{1, 1}}, 0.02, 1)).detected;
  const Rig two(small_scene(2));
  const auto without = two.run(two.draw({{1, 1}}, 0.02, 1)).detected;
  ASSERT_EQ(with.observations.items.size(), without.observations.items.size());
  ASSERT_FALSE(with.observations.items.empty());
  for (std::size_t i = 0; i < with.observations.items.size(); ++i) {
    EXPECT_EQ(with.observations.items[i].boxes.size(), 2U);
    EXPECT_EQ(with.observations.items[i].position_m, without.observations.items[i].position_m);
    EXPECT_EQ(with.observations.items[i].probability, without.observations.items[i].probability);
  }
  for (const double v : with.likelihood->views[2]) EXPECT_TRUE(std::isnan(v));
}

TEST(HierarchicalGrid, TinyImagesDoNoHarm) {
  auto scene = testing::round_scene(2);
  for (Camera& camera : scene->cameras) camera = camera.scaled({4, 3});
  const Rig rig(scene);
  EXPECT_NO_THROW(rig.run(rig.draw({{0, 0}}, 0.2, 1)));
}

TEST(HierarchicalGrid, IsTheSameAfterLoadingItsTemplates) {
  const auto scene = small_scene(2);
  Rig rig(scene);
  std::stringstream file;
  rig.detector().learner()->save(file);
  const auto loaded = rig.make(Rig::defaults());
  loaded->learner()->load(file);
  const auto views = rig.draw({{1.1, -0.4}, {-2, 1}}, 0.05, 2);
  const auto a = rig.run(views).detected, b = rig.run(*loaded, views).detected;
  ASSERT_EQ(a.observations.items.size(), b.observations.items.size());
  for (std::size_t i = 0; i < a.observations.items.size(); ++i) {
    EXPECT_EQ(a.observations.items[i].position_m, b.observations.items[i].position_m);
    EXPECT_EQ(a.observations.items[i].probability, b.observations.items[i].probability);
  }
}

TEST(HierarchicalGrid, ContradictionsAreRefused) {
  const Rig rig(small_scene(1));
  HierarchicalGrid::Options options = Rig::defaults();
  options.cells = 30;
  try {
    (void)rig.make(options);
    FAIL() << "30 cells can't be halved twice";
  } catch (const UserError& e) {
    EXPECT_EQ(e.diagnostics().at(0).pointer, "/cells");
  }
  options = Rig::defaults();
  options.inference = HierarchicalGrid::Inference::kGreedy;
  options.maxima = HierarchicalGrid::Maxima::kAll;
  try {
    (void)rig.make(options);
    FAIL() << "all cells aren't people inferred together";
  } catch (const UserError& e) {
    EXPECT_EQ(e.diagnostics().at(0).pointer, "/maxima");
  }
  BuildContext context = testing::context_of(small_scene(1));
  context.part_lists["shape"] = {
      {"shape", std::make_shared<Cylinder>(Cylinder::Options(), BuildContext())}};
  context.input_lists["modalities"] = {};
  EXPECT_THROW(HierarchicalGrid(Rig::defaults(), context), UserError);
  context.input_lists["modalities"] = {{0, "hog", nullptr, {}}};
  EXPECT_THROW(HierarchicalGrid(Rig::defaults(), context), UserError);
}

TEST(HierarchicalGrid, KeepsTheContract) {
  for (const char* inference : {"independent", "greedy", "mean-field"}) {
    contract::Trial trial;
    trial.world = std::make_shared<contract::World>(3, 12);
    trial.finder = [](const std::string& name) -> std::optional<contract::Subject> {
      if (name == "overlap") return contract::subject_of<test::OverlapModality>();
      if (name == "cylinder") return contract::subject_of<Cylinder>();
      return std::nullopt;
    };
    trial.values = {{"modalities", {{{"from", "overlap"}, {"weight", 2.0}}}},
                    {"cells", 12},
                    {"inference", inference}};
    contract::expect_kept(contract::subject_of<HierarchicalGrid>(), trial);
  }
}

TEST(HierarchicalGrid, AsksForTemplatesBeforeItSearches) {
  const Rig rig(small_scene(1));
  const auto untaught = rig.make(Rig::defaults());
  EXPECT_THROW(rig.run(*untaught, rig.draw({}, 0, 1)), InternalError);
}

}  // namespace
}  // namespace plaza
