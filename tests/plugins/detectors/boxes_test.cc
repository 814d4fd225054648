#include "plugins/detectors/ground/boxes.h"

#include <gtest/gtest.h>

#include "plaza/core/error.h"
#include "tests/plugins/detectors/simulated_scene.h"

namespace plaza {
namespace {

using testing::context_of;
using testing::detect;
using testing::person_box;
using testing::round_scene;

TEST(BoxesDetector, GivesOneObservationPerBoxByCamera) {
  const auto scene = round_scene(3);
  const BoxesDetector detector({}, context_of(scene));
  auto input = std::make_shared<Detections>();
  input->views.resize(3);
  const Eigen::Vector2d p(1, -1);
  for (const std::size_t camera : {0U, 2U}) {
    input->views[camera].push_back({person_box(scene->cameras[camera], p, 1.75), 1.0});
  }
  const Observations seen = detect(detector, input);
  ASSERT_EQ(seen.items.size(), 2U);
  EXPECT_EQ(seen.items[0].boxes.at(0).camera, 0U);
  EXPECT_EQ(seen.items[1].boxes.at(0).camera, 2U);
  for (const Observation& o : seen.items) EXPECT_LT((o.position_m - p).norm(), 1e-3);
}

TEST(BoxesDetector, GivesNothingForNothing) {
  const BoxesDetector detector({}, context_of(round_scene(2)));
  auto input = std::make_shared<Detections>();
  input->views.resize(2);
  EXPECT_TRUE(detect(detector, input).items.empty());
}

TEST(BoxesDetector, RefusesDetectionsOfAnotherScene) {
  const BoxesDetector detector({}, context_of(round_scene(2)));
  auto input = std::make_shared<Detections>();
  input->views.resize(3);
  EXPECT_THROW(detect(detector, input), InternalError);
}

}  // namespace
}  // namespace plaza
