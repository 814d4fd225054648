#include "plugins/detectors/ground/ground_fusion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "plaza/core/error.h"
#include "plugins/detectors/ground/boxes.h"
#include "tests/plugins/detectors/simulated_scene.h"

namespace plaza {
namespace {

using testing::context_of;
using testing::detect;
using testing::person_box;
using testing::round_scene;

Observation seen(std::size_t camera, double x, double y, double probability = 0.9,
                 double sigma_m = 0.15) {
  Observation o;
  o.position_m = {x, y};
  o.covariance_m2 = sigma_m * sigma_m * Eigen::Matrix2d::Identity();
  o.probability = probability;
  o.boxes.push_back({.camera = camera,
                     .box = {.left = 1, .top = 1, .width = 1, .height = 1},
                     .score = probability});
  return o;
}

Observations fuse(const std::shared_ptr<Scene>& scene, const GroundFusion::Options& options,
                  std::vector<Observation> items) {
  auto input = std::make_shared<Observations>();
  input->items = std::move(items);
  return detect(GroundFusion(options, context_of(scene)), input);
}

TEST(GroundFusion, JoinsViewsIntoOnePersonWithAllBoxes) {
  const Observations people =
      fuse(round_scene(3), {}, {seen(2, 0.1, 0), seen(0, 0, 0.1), seen(1, 0, 0)});
  ASSERT_EQ(people.items.size(), 1U);
  const Observation& p = people.items[0];
  EXPECT_LT((p.position_m - Eigen::Vector2d(0.0333, 0.0333)).norm(), 1e-3);
  ASSERT_EQ(p.boxes.size(), 3U);
  for (std::size_t camera = 0; camera < 3; ++camera) EXPECT_EQ(p.boxes[camera].camera, camera);
  EXPECT_GT(p.probability, 0.99);
  EXPECT_LT(p.covariance_m2.trace(), seen(0, 0, 0).covariance_m2.trace());
}

TEST(GroundFusion, OneViewCountsOnlyAgainstTheSilenceOfTheOthers) {
  GroundFusion::Options options;
  options.min_probability = 0;
  const auto alone = [&](int cameras, double probability) {
    return fuse(round_scene(cameras), options, {seen(0, 0, 0, probability)})
        .items.at(0)
        .probability;
  };
  EXPECT_NEAR(alone(1, 0.9), 0.9, 1e-12);
  // odds 9 * (1 - 0.6)^3 = 0.576
  EXPECT_NEAR(alone(4, 0.9), 0.576 / 1.576, 1e-9);
  EXPECT_GT(alone(4, 0.99), alone(4, 0.9));
}

TEST(GroundFusion, AViewWhoseSightIsBlockedIsNoWitness) {
  auto scene = round_scene(2);
  GroundFusion::Options options;
  options.min_probability = 0;
  const double witnessed = fuse(scene, options, {seen(0, 0, 0)}).items.at(0).probability;
  scene->occluders.push_back(
      {.camera = "view2", .name = "wall", .polygon_px = {{0, 0}, {640, 0}, {640, 480}, {0, 480}}});
  const double unwitnessed = fuse(scene, options, {seen(0, 0, 0)}).items.at(0).probability;
  EXPECT_LT(witnessed, 0.85);
  EXPECT_NEAR(unwitnessed, 0.9, 1e-12);
}

TEST(GroundFusion, GivesOnlyWhatItsLimitsAllow) {
  const auto scene = round_scene(2);
  const std::vector<Observation> items = {seen(0, 0, 0, 0.6), seen(0, 5, 0, 0.999),
                                          seen(1, 5, 0.1, 0.999), seen(0, 2, 2, 0.999),
                                          seen(1, 2, 2.1, 0.999)};
  EXPECT_EQ(fuse(scene, {}, items).items.size(), 1U);
  GroundFusion::Options wide;
  wide.margin_m = 2;
  EXPECT_EQ(fuse(scene, wide, items).items.size(), 2U);
  GroundFusion::Options credulous;
  credulous.min_probability = 0.1;
  EXPECT_EQ(fuse(scene, credulous, items).items.size(), 2U);
  credulous.min_views = 2;
  EXPECT_EQ(fuse(scene, credulous, items).items.size(), 1U);
}

TEST(GroundFusion, DropsAnEchoButNotASecondPersonOfTheSameView) {
  const auto scene = round_scene(2);
  GroundFusion::Options options;
  options.view_sigma_m = 0;
  options.person_density_per_m2 = 1;
  options.min_probability = 0;
  const auto sharp = [](std::size_t camera, double x, double p) {
    return seen(camera, x, 0, p, 0.05);
  };
  options.min_distance_m = 0.7;
  const Observations echo = fuse(scene, options, {sharp(0, 0, 0.9), sharp(1, 0.5, 0.8)});
  ASSERT_EQ(echo.items.size(), 1U);
  EXPECT_DOUBLE_EQ(echo.items[0].position_m.x(), 0);
  EXPECT_EQ(fuse(scene, options, {sharp(0, 0, 0.9), sharp(0, 0.5, 0.8)}).items.size(), 2U);
  options.min_distance_m = 0.4;
  EXPECT_EQ(fuse(scene, options, {sharp(0, 0, 0.9), sharp(1, 0.5, 0.8)}).items.size(), 2U);
}

TEST(GroundFusion, RefusesObservationsThatAreNotOfOneView) {
  Observation joint = seen(0, 0, 0);
  joint.boxes.push_back({.camera = 1, .box = {}, .score = 1});
  try {
    fuse(round_scene(2), {}, {joint});
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("single views"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("'boxes'"));
  }
}

TEST(GroundFusion, GivesNothingForNothing) {
  EXPECT_TRUE(fuse(round_scene(3), {}, {}).items.empty());
}

/// Six people on crossing paths, four views with misses, jitter and clutter, from boxes to people.
TEST(GroundFusion, FindsCrossingPeopleThroughMissesAndClutter) {
  const auto scene = round_scene(4);
  BoxesDetector::Options box_options;
  box_options.probability = {{0, 0.3}, {1, 0.95}};
  const BoxesDetector boxes(box_options, context_of(scene));
  GroundFusion::Options options;
  options.person_density_per_m2 = 0.1;
  const GroundFusion fusion(options, context_of(scene));
  std::mt19937_64 random(21);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  int people_total = 0, found_total = 0, false_total = 0;
  for (int frame = 0; frame < 100; ++frame) {
    std::vector<Eigen::Vector2d> people;
    for (int i = 0; i < 6; ++i) {
      const double t = (frame / 99.0 - 0.5) * 6;
      people.push_back(i % 2 ? Eigen::Vector2d(t, -2.0 + 0.8 * i)
                             : Eigen::Vector2d(-2.0 + 0.8 * i, -t));
    }
    auto input = std::make_shared<Detections>();
    input->views.resize(4);
    for (std::size_t camera = 0; camera < 4; ++camera) {
      for (const Eigen::Vector2d& p : people) {
        if (unit(random) < 0.15) continue;
        Box box = person_box(scene->cameras[camera], p, 1.75 + 0.06 * normal(random));
        box.left += 0.02 * box.height * normal(random);
        box.top += 0.02 * box.height * normal(random);
        input->views[camera].push_back({box, 0.7 + 0.3 * unit(random)});
      }
      if (unit(random) < 0.3) {
        const Eigen::Vector2d p(8 * unit(random) - 4, 8 * unit(random) - 4);
        input->views[camera].push_back(
            {person_box(scene->cameras[camera], p, 1.75), 0.3 * unit(random)});
      }
    }
    auto single = std::make_shared<Observations>(detect(boxes, input));
    const Observations out = detect(fusion, single);
    std::vector<bool> used(out.items.size(), false);
    for (const Eigen::Vector2d& p : people) {
      ++people_total;
      for (std::size_t i = 0; i < out.items.size(); ++i) {
        if (used[i] || (out.items[i].position_m - p).norm() > 0.35) continue;
        used[i] = true;
        ++found_total;
        break;
      }
    }
    false_total += static_cast<int>(std::count(used.begin(), used.end(), false));
  }
  EXPECT_GT(found_total, people_total * 96 / 100);
  EXPECT_LT(false_total, people_total * 4 / 100);
}

}  // namespace
}  // namespace plaza
