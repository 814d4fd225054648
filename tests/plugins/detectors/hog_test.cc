#include "plugins/detectors/hog/hog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plaza/core/error.h"
#include "plaza/data/frames.h"
#include "tests/plugins/detectors/drawn_people.h"
#include "tests/plugins/detectors/simulated_scene.h"

namespace plaza {
namespace {

using testing::context_of;
using testing::detect;
using testing::draw_person;
using testing::empty_street;
using testing::looking_camera;
using testing::person_box;
using testing::round_scene;

std::shared_ptr<Scene> street() {
  auto scene = round_scene(1);
  scene->cameras[0] = looking_camera("street", {0, -11, 3.5}, {0, 0, 0.9});
  scene->area = {.min_m = {-4, -3}, .max_m = {4, 4}};
  return scene;
}

std::shared_ptr<FrameSet> frame_of(const cv::Mat& image) {
  auto frame = std::make_shared<FrameSet>();
  frame->views = {image};
  return frame;
}

TEST(PlanSearch, CoversEveryBodyWithALevelOfItsSize) {
  const auto scene = street();
  const SearchPlanOptions options;
  const auto levels = plan_search(scene->cameras[0], *scene, options);
  ASSERT_FALSE(levels.empty());
  for (double x = -4; x <= 4; x += 0.7) {
    for (double y = -3; y <= 4; y += 0.7) {
      const auto box = body_box(scene->cameras[0], {x, y}, scene->body);
      ASSERT_TRUE(box);
      const bool covered = std::any_of(levels.begin(), levels.end(), [&](const SearchLevel& l) {
        const double ratio = box->height / l.body_height_px;
        return std::abs(std::log(ratio)) <= 0.5 * std::log(options.scale_step) + 1e-3 &&
               std::max(box->left, 0.0) >= l.region.x && std::max(box->top, 0.0) >= l.region.y &&
               std::min(box->right(), 640.0) <= l.region.x + l.region.width &&
               std::min(box->bottom(), 480.0) <= l.region.y + l.region.height;
      });
      EXPECT_TRUE(covered) << x << ", " << y;
    }
  }
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_GT(levels[i].body_height_px, levels[i - 1].body_height_px);
  }
}

TEST(PlanSearch, SearchesLessThanAPyramid) {
  const auto scene = street();
  const auto levels = plan_search(scene->cameras[0], *scene, {});
  double planned = 0, pyramid = 0;
  for (const SearchLevel& l : levels) {
    const double scale = 96 / l.body_height_px;
    planned += l.region.area() * scale * scale;
    pyramid += 640.0 * 480 * scale * scale;
  }
  EXPECT_LT(planned, 0.6 * pyramid);
}

TEST(PlanSearch, LeavesOutWhatIsTooSmallOrOutOfSight) {
  const auto scene = street();
  EXPECT_TRUE(plan_search(scene->cameras[0], *scene, {.min_height_px = 1000}).empty());
  const Camera away = looking_camera("away", {0, -11, 3.5}, {0, -20, 0.9});
  EXPECT_TRUE(plan_search(away, *scene, {}).empty());
}

TEST(HogDetector, FindsDrawnPeopleWhereTheyStand) {
  const auto scene = street();
  const HogDetector detector({}, context_of(scene));
  cv::Mat image = empty_street();
  const std::vector<Eigen::Vector2d> people = {{-2, 0}, {1.5, 1}};
  for (const auto& p : people) draw_person(image, person_box(scene->cameras[0], p, 1.75));
  const Observations seen = detect(detector, frame_of(image));
  for (const auto& p : people) {
    EXPECT_TRUE(std::any_of(seen.items.begin(), seen.items.end(), [&](const Observation& o) {
      return (o.position_m - p).norm() < 0.8;
    })) << p.transpose();
  }
  EXPECT_LE(seen.items.size(), people.size() + 1);
}

TEST(HogDetector, FindsNobodyInAnEmptyStreetOrWithoutAnImage) {
  const auto scene = street();
  const HogDetector detector({}, context_of(scene));
  EXPECT_TRUE(detect(detector, frame_of(empty_street())).items.empty());
  EXPECT_TRUE(detect(detector, frame_of(cv::Mat())).items.empty());
}

TEST(HogDetector, GivesTheSameForTheSame) {
  const auto scene = street();
  const HogDetector detector({}, context_of(scene));
  cv::Mat image = empty_street();
  draw_person(image, person_box(scene->cameras[0], {0, 0}, 1.75));
  const Observations a = detect(detector, frame_of(image));
  const Observations b = detect(detector, frame_of(image.clone()));
  ASSERT_EQ(a.items.size(), b.items.size());
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    EXPECT_EQ(a.items[i].position_m, b.items[i].position_m);
    EXPECT_EQ(a.items[i].probability, b.items[i].probability);
  }
}

TEST(HogDetector, RefusesImagesOfAnotherSize) {
  const HogDetector detector({}, context_of(street()));
  try {
    detect(detector, frame_of(cv::Mat(240, 320, CV_8UC3)));
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("320x240"));
    EXPECT_EQ(error.context().camera, "street");
  }
}

TEST(HogDetector, RefusesAStrideBetweenCells) {
  HogDetector::Options options;
  options.stride_px = 6;
  EXPECT_THROW(HogDetector(options, context_of(street())), UserError);
}

}  // namespace
}  // namespace plaza
