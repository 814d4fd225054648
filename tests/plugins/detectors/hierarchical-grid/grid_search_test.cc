// What the search does with single views: how much each counts, and who hides whom in it.
#include "plugins/detectors/hierarchical-grid/grid_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/plugins/detectors/hierarchical-grid/grid_rig.h"

namespace plaza {
namespace {

using test::Rig;
using test::small_scene;

TEST(ViewTrust, IsWholeUnlessAskedFor) {
  Silhouette silhouette;
  silhouette.box = {0, 0, 2, 5};
  silhouette.inside_share = 0.4;
  EXPECT_EQ(ViewTrust().of(silhouette, {640, 480}), 1);
}

TEST(ViewTrust, FallsWithWhatIsHiddenFarOrBlurred) {
  Silhouette silhouette;
  silhouette.box = {300, 200, 40, 80};  // in the middle
  silhouette.inside_share = 0.4;
  EXPECT_DOUBLE_EQ((ViewTrust{.visible_share = true}.of(silhouette, {640, 480})), 0.4);
  EXPECT_DOUBLE_EQ((ViewTrust{.sharp_px = 160}.of(silhouette, {640, 480})), 0.5);
  EXPECT_DOUBLE_EQ((ViewTrust{.sharp_px = 60}.of(silhouette, {640, 480})), 1);
  EXPECT_DOUBLE_EQ((ViewTrust{.edge_loss = 0.5}.of(silhouette, {640, 480})), 1);
  silhouette.box = {-20, -40, 40, 80};  // in a corner
  EXPECT_DOUBLE_EQ((ViewTrust{.edge_loss = 0.5}.of(silhouette, {640, 480})), 0.5);
  silhouette.box = {-300, -400, 40, 80};  // beyond it
  EXPECT_DOUBLE_EQ((ViewTrust{.edge_loss = 0.5}.of(silhouette, {640, 480})), 0.5);
}

/// Score, as HierarchicalGrid's calibration tells it, of the one person that is found.
double score_of_one(const Rig& rig, const std::vector<cv::Mat>& views) {
  const auto found = rig.run(views).detected.observations.items;
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? 0 : 10 * found[0].probability;
}

TEST(ViewTrust, AViewThatSeesOnlyAFootCountsLess) {
  auto scene = small_scene(3);
  const int width = scene->cameras[0].width(), height = scene->cameras[0].height();
  const Eigen::Vector2d where(0.3, 0.2);
  const Box box = *body_box(scene->cameras[0], where, scene->body);
  const double cut = box.top + 0.55 * box.height;
  scene->occluders.push_back({scene->cameras[0].name(),
                              "board",
                              {{-1, -1}, {width + 1.0, -1}, {width + 1.0, cut}, {-1, cut}}});
  HierarchicalGrid::Options options = Rig::defaults();
  options.probability = {{0, 0.001}, {10, 0.999}};
  options.min_score = 0.5;
  options.separation_m = 4;
  const auto drawn = Rig(scene, options).draw({where}, 0.01, 3);
  auto views = drawn;
  views[0] = cv::Mat(height, width, CV_8UC3, cv::Scalar::all(20));  // the foot can't be seen
  options.visible_share = false;
  const double alike = score_of_one(Rig(scene, options), views);
  options.visible_share = true;
  const double weighed = score_of_one(Rig(scene, options), views);
  EXPECT_GT(weighed, alike + 0.1);
}

TEST(ViewTrust, FallsWithTheShareThatOthersHide) {
  const Box body{100, 100, 50, 100};
  const Box left_half{80, 90, 45, 120}, lower_half{90, 150, 80, 100}, elsewhere{200, 100, 50, 100};
  const auto trust = [&](const std::vector<Box>& others, double loss) {
    return ViewTrust{.hidden_loss = loss}.of_hidden(body, others);
  };
  EXPECT_DOUBLE_EQ(trust({left_half}, 0), 1);
  EXPECT_DOUBLE_EQ(trust({elsewhere}, 1), 1);
  EXPECT_DOUBLE_EQ(trust({left_half}, 1), 0.5);
  EXPECT_DOUBLE_EQ(trust({left_half}, 0.5), 0.75);
  EXPECT_DOUBLE_EQ(trust({left_half, lower_half}, 1), 0.25);
  EXPECT_DOUBLE_EQ(trust({body}, 1), 0);
}

TEST(ViewTrust, WhatOneViewSawIsWorthLessThanWhatSeveralAgreeOn) {
  HierarchicalGrid::Options options = Rig::defaults();
  options.min_score = 1;
  const auto score = [&](int cameras, double empty_views) {
    options.empty_views = empty_views;
    const Rig rig(small_scene(cameras), options);
    return rig.run(rig.draw({{0.33, -1.21}}, 0.01, 3)).detected.observations.items.at(0).score;
  };
  EXPECT_NEAR(score(1, 1), score(1, 0) / 2, 1e-9);
  EXPECT_NEAR(score(4, 1), score(4, 0) * 4 / 5, 1e-9);
}

class Explained : public ::testing::Test {
 protected:
  /// Values of the cells of two people in each view, without what `people` account for.
  LevelLikelihood without(std::span<const PlacedBody> people, std::optional<CellIndex> behind) {
    AllEvidence evidence(1);
    for (std::size_t c = 0; c < views_.size(); ++c) {
      evidence[0].push_back(modality_->prepare(views_[c], c).evidence);
    }
    const SearchResult result = search_.search(evidence);
    LevelLikelihood level = result.levels.back();
    const Remainder whole = search_.nobody(evidence);
    const Remainder rest =
        behind ? search_.explain_to(*behind, whole, people, true) : search_.explain(whole, people);
    search_.judge(rest, result.baselines, 0, ViewCells(views_.size(), both_), level);
    return level;
  }
  CellIndex cell_at(const Eigen::Vector2d& position) const {
    const GroundGrid& g = grid_.finest();
    const Eigen::Vector2d at = (position - g.origin_m).cwiseQuotient(g.step_m);
    return static_cast<CellIndex>(std::lround(at.y()) * g.columns + std::lround(at.x()));
  }

  std::shared_ptr<Scene> scene_ = small_scene(2);
  Rig rig_{scene_};
  StateGrid grid_{scene_->area, 32, 1, 2};
  Cylinder shape_{Cylinder::Options(), BuildContext()};
  std::shared_ptr<test::OverlapModality> modality_ = std::make_shared<test::OverlapModality>(
      test::OverlapModality::Options(), testing::context_of(scene_));
  TemplateHierarchy hierarchy_ = [&] {
    TemplateHierarchy h(grid_, *scene_);
    h.compute(shape_, 0.3, true);
    return h;
  }();
  GridSearch search_{grid_,           hierarchy_,         shape_, {{modality_, 1}},
                     scene_->cameras, {.hidden_loss = 1}, 0,      0};
  Eigen::Vector2d towards_ = scene_->cameras[0].centre().head<2>().normalized();
  Eigen::Vector2d aside_{-towards_.y(),
                         towards_.x()};  ///< so that something of who is behind shows
  CellIndex near_ = cell_at(1.4 * towards_), far_ = cell_at(0.4 * towards_ + 0.3 * aside_);
  std::vector<CellIndex> both_ = {near_, far_};
  std::vector<cv::Mat> views_ =
      rig_.draw({grid_.position(0, near_), grid_.position(0, far_)}, 0, 1);
};

TEST_F(Explained, WhoStandsInFrontLosesNothingToWhoStandsBehind) {
  const PlacedBody far[] = {{far_, 0}};
  const LevelLikelihood all = without({}, {}), order = without(far, near_), any = without(far, {});
  EXPECT_EQ(order.views[0][near_], all.views[0][near_]);
  EXPECT_NE(any.views[0][near_], all.views[0][near_]);
}

TEST_F(Explained, WhoCannotShareEvidenceTakesNoneAway) {
  AllEvidence evidence(1);
  for (std::size_t c = 0; c < views_.size(); ++c) {
    evidence[0].push_back(modality_->prepare(views_[c], c).evidence);
  }
  const Remainder whole = search_.nobody(evidence);
  const ViewCells touching = search_.touching(near_);
  int taken = 0, left = 0;
  for (std::size_t other = 0; other < grid_.size(0); ++other) {
    const PlacedBody people[] = {{static_cast<CellIndex>(other), 0}};
    const Remainder all = search_.explain(whole, people);
    const Remainder rest = search_.explain_to(near_, whole, people, false);
    for (std::size_t c = 0; c < views_.size(); ++c) {
      const bool touches = std::ranges::binary_search(touching[c], people[0].cell);
      EXPECT_EQ(rest.hidden[c].size(), touches ? all.hidden[c].size() : 0);
      EXPECT_EQ(rest.evidence[0][c] != evidence[0][c],
                touches && all.evidence[0][c] != evidence[0][c]);
      ++(rest.hidden[c].empty() ? left : taken);
    }
  }
  EXPECT_GT(taken, 0);
  EXPECT_GT(left, 0);
}

TEST_F(Explained, WhoStandsBehindLosesWhatIsHidden) {
  const PlacedBody near[] = {{near_, 0}};
  const LevelLikelihood order = without(near, far_), any = without(near, {});
  EXPECT_EQ(order.views[0][far_], any.views[0][far_]);
  EXPECT_NE(order.views[0][far_], without({}, {}).views[0][far_]);
}

TEST_F(Explained, AViewInWhichOthersHideSomebodyCountsLessForThemAlone) {
  const PlacedBody near[] = {{near_, 0}};
  const LevelLikelihood level = without(near, {}), all = without({}, {});
  EXPECT_EQ(all.view_trust[0][far_], 1);
  EXPECT_LT(level.view_trust[0][far_], 0.8);
  EXPECT_NEAR(level.trust[far_], level.view_trust[0][far_] + level.view_trust[1][far_], 1e-6);
  const PlacedBody far[] = {{far_, 0}};
  EXPECT_EQ(without(far, near_).view_trust[0][near_], 1);
}

}  // namespace
}  // namespace plaza
