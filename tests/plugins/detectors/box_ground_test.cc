#include "plugins/detectors/common/box_ground.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "plaza/core/error.h"
#include "tests/plugins/detectors/simulated_scene.h"

namespace plaza {
namespace {

using testing::cut_at_border;
using testing::looking_camera;
using testing::person_box;
using testing::round_scene;

double distance(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return (a - b).norm(); }

TEST(BoxGround, FindsWhereARenderedPersonStandsInEveryView) {
  const auto scene = round_scene(4);
  const BoxGround ground(BoxGroundOptions{}, scene);
  for (std::size_t camera = 0; camera < scene->cameras.size(); ++camera) {
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 0), Eigen::Vector2d(2, -1.5),
                                     Eigen::Vector2d(-2.5, 1), Eigen::Vector2d(-1, -2)}) {
      const Box box = person_box(scene->cameras[camera], p, scene->body.height_m);
      const auto standing = ground.locate(camera, box);
      ASSERT_TRUE(standing);
      EXPECT_TRUE(standing->feet);
      EXPECT_LT(distance(standing->position_m, p), 1e-3);
    }
  }
}

TEST(BoxGround, UndoesDeclaredOffsetsOfLooseBoxes) {
  const auto scene = round_scene(1);
  BoxGroundOptions options;
  options.foot_offset = 0.05;
  options.foot_offset_px = 3;
  options.head_offset = 0.04;
  const BoxGround ground(options, scene);
  const Eigen::Vector2d p(1, 0.5);
  const Box tight = person_box(scene->cameras[0], p, scene->body.height_m);
  // loose.height * (1 - 0.05 - 0.04) - 3 = tight.height
  Box loose = tight;
  loose.height = (tight.height + 3) / 0.91;
  loose.top = tight.top - 0.04 * loose.height;
  const auto standing = ground.locate(0, loose);
  ASSERT_TRUE(standing);
  EXPECT_LT(distance(standing->position_m, p), 1e-3);
}

/// Boxes with declared noise; the normalised error must have the spread that the covariance claims.
TEST(BoxGround, CovarianceIsThatOfTheErrors) {
  const auto scene = round_scene(2);
  for (const bool use_head : {false, true}) {
    BoxGroundOptions options;
    options.use_head = use_head;
    options.ground_sigma_m = 0;
    options.height_gate = 100;
    options.foot_sigma = 0.02;
    options.head_sigma = 0.03;
    options.centre_sigma = 0.025;
    const BoxGround ground(options, scene);
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> place(-2.5, 2.5);
    double nees = 0;
    constexpr int kRuns = 2000;
    for (int i = 0; i < kRuns; ++i) {
      const Eigen::Vector2d p(place(random), place(random));
      const double height_m = scene->body.height_m + options.body_height_sigma_m * normal(random);
      Box box = person_box(scene->cameras[1], p, height_m);
      const double h = box.height;
      const auto noise = [&](double share) {
        return std::hypot(share * h, options.pixel_sigma_px) * normal(random);
      };
      box.left += noise(options.centre_sigma);
      const double foot = box.bottom() + noise(options.foot_sigma);
      box.top += noise(options.head_sigma);
      box.height = foot - box.top;
      const auto standing = ground.locate(1, box);
      ASSERT_TRUE(standing);
      const Eigen::Vector2d error = standing->position_m - p;
      nees += error.dot(standing->covariance_m2.inverse() * error) / kRuns;
    }
    // 2 degrees of freedom: mean 2, standard deviation of the mean 2 / sqrt(2000)
    EXPECT_NEAR(nees, 2.0, 0.25) << "use_head " << use_head;
  }
}

TEST(BoxGround, HeadMakesTheDepthMoreCertain) {
  const auto scene = round_scene(1);
  BoxGroundOptions options;
  const Box box = person_box(scene->cameras[0], {1, 1}, scene->body.height_m);
  const auto both = BoxGround(options, scene).locate(0, box);
  options.use_head = false;
  const auto feet = BoxGround(options, scene).locate(0, box);
  ASSERT_TRUE(both && feet);
  EXPECT_LT(both->covariance_m2.determinant(), 0.9 * feet->covariance_m2.determinant());
}

TEST(BoxGround, LocatesPeopleWithHiddenFeetByTheirHeads) {
  const auto scene = round_scene(1);
  const BoxGround ground(BoxGroundOptions{}, scene);
  const Eigen::Vector2d p(0.5, -1);
  Box box = person_box(scene->cameras[0], p, scene->body.height_m);
  const double certain = ground.locate(0, box)->covariance_m2.trace();
  box.height *= 0.55;  // somebody stands before the legs
  const auto standing = ground.locate(0, box);
  ASSERT_TRUE(standing);
  EXPECT_FALSE(standing->feet);
  EXPECT_LT(distance(standing->position_m, p), 0.05);
  EXPECT_GT(standing->covariance_m2.trace(), certain);
}

TEST(BoxGround, LocatesPeopleCutByTheLowerBorderByTheirHeads) {
  auto scene = round_scene(1);
  scene->cameras[0] = looking_camera("near", {0, -3, 3}, {0, 3, 1.5});
  scene->area = {.min_m = {-9, -9}, .max_m = {9, 9}};
  const BoxGround ground(BoxGroundOptions{}, scene);
  const Eigen::Vector2d p(0.2, 0.0);
  const Box whole = person_box(scene->cameras[0], p, scene->body.height_m);
  ASSERT_GT(whole.bottom(), 500);
  const auto standing = ground.locate(0, cut_at_border(whole, scene->cameras[0]));
  ASSERT_TRUE(standing);
  EXPECT_FALSE(standing->feet);
  EXPECT_LT(distance(standing->position_m, p), 0.05);
}

TEST(BoxGround, LocatesPeopleCutByTheUpperBorderByTheirFeet) {
  auto scene = round_scene(1);
  scene->cameras[0] = looking_camera("down", {0, -6, 4}, {0, -2.5, 0});
  const BoxGround ground(BoxGroundOptions{}, scene);
  const Eigen::Vector2d p(0, 3);
  const Box whole = person_box(scene->cameras[0], p, scene->body.height_m);
  ASSERT_LT(whole.top, -5);
  const auto standing = ground.locate(0, cut_at_border(whole, scene->cameras[0]));
  ASSERT_TRUE(standing);
  EXPECT_TRUE(standing->feet);
  EXPECT_LT(distance(standing->position_m, p), 1e-3);
}

TEST(BoxGround, SideBordersWidenTheUncertaintyAndKeepTheVisibleEdge) {
  auto scene = round_scene(1);
  const BoxGround ground(BoxGroundOptions{}, scene);
  const Camera& camera = scene->cameras[0];
  // a person whose middle is at the left border
  const auto p = camera.to_plane({4, 250});
  ASSERT_TRUE(p);
  const Box whole = person_box(camera, *p, scene->body.height_m, 0.343);  // 2 * 0.30 / 1.75
  const Box cut = cut_at_border(whole, camera);
  const auto standing = ground.locate(0, cut);
  ASSERT_TRUE(standing);
  EXPECT_LT(distance(standing->position_m, *p), 0.1);
  // half a body's width is not seen, so the middle is less certain than that of a box seen wholly
  const auto whole_inside = ground.locate(
      0, {.left = 200, .top = whole.top, .width = whole.width, .height = whole.height});
  ASSERT_TRUE(whole_inside);
  EXPECT_GT(standing->covariance_m2.trace(), 1.05 * whole_inside->covariance_m2.trace());
}

TEST(BoxGround, NothingAboveTheHorizonOrCutOnBothEnds) {
  const auto scene = round_scene(1);
  const BoxGround ground(BoxGroundOptions{}, scene);
  EXPECT_FALSE(ground.locate(0, {.left = 300, .top = 10, .width = 20, .height = 30}));
  EXPECT_FALSE(ground.locate(0, {.left = 300, .top = 0, .width = 200, .height = 480}));
}

TEST(BoxGround, ObservesOnlyPlausiblePeopleInsideTheArea) {
  const auto scene = round_scene(1);
  BoxGroundOptions options;
  options.min_score = 0.4;
  const Camera& camera = scene->cameras[0];
  const double h = scene->body.height_m;
  const Box person = person_box(camera, {1, 1}, h);
  Box giant = person_box(camera, {-1, 1}, 2.2 * h);
  Box dwarf = person_box(camera, {0, -2}, 0.25 * h);
  const Box outside = person_box(camera, {-5, 0}, h);
  const Box weak = person_box(camera, {2, -2}, h);
  const std::vector<ImageDetection> boxes = {
      {person, 0.5}, {giant, 0.9}, {dwarf, 0.9}, {outside, 0.9}, {weak, 0.39}};
  const auto seen = BoxGround(options, scene).observe(0, boxes);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_LT(distance(seen[0].position_m, {1, 1}), 1e-3);
  EXPECT_DOUBLE_EQ(seen[0].probability, 0.5);
  ASSERT_EQ(seen[0].boxes.size(), 1U);
  EXPECT_EQ(seen[0].boxes[0].box, person);
  EXPECT_DOUBLE_EQ(seen[0].boxes[0].score, 0.5);

  options.margin_m = 1.5;
  EXPECT_EQ(BoxGround(options, scene).observe(0, boxes).size(), 2U);
}

TEST(BoxGround, AnImplausibleBoxSuppressesNoPerson) {
  const auto scene = round_scene(1);
  const Box person = person_box(scene->cameras[0], {0, 0}, scene->body.height_m);
  Box better = person;
  better.top -= 0.75 * person.height;
  better.height *= 1.75;
  BoxGroundOptions options;
  options.nms_overlap = 0.3;
  const auto seen = BoxGround(options, scene)
                        .observe(0, std::vector<ImageDetection>{{better, 0.9}, {person, 0.6}});
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].boxes[0].box, person);
}

TEST(BoxGround, RefusesContradictoryOptions) {
  const auto scene = round_scene(1);
  BoxGroundOptions ratios;
  ratios.min_height_ratio = 2;
  EXPECT_THROW(BoxGround(ratios, scene), UserError);
  BoxGroundOptions margin;
  margin.margin_m = -4.5;
  EXPECT_THROW(BoxGround(margin, scene), UserError);
}

TEST(SuppressOverlapping, KeepsTheBestAndTheFirstOfEqualOnes) {
  const Box a{.left = 0, .top = 0, .width = 10, .height = 20};
  const Box b{.left = 1, .top = 0, .width = 10, .height = 20};
  const Box c{.left = 8, .top = 0, .width = 10, .height = 20};
  const std::vector<ImageDetection> boxes = {{a, 0.5}, {b, 0.9}, {c, 0.5}, {b, 0.9}};
  EXPECT_EQ(suppress_overlapping(boxes, 0.5), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(suppress_overlapping(boxes, 1.0), (std::vector<std::size_t>{1, 3, 0, 2}));
  EXPECT_TRUE(suppress_overlapping({}, 0.5).empty());
}

}  // namespace
}  // namespace plaza
