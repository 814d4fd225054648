// The detectors in the contract suite's world.
#include <gtest/gtest.h>

#include "plaza/contract/gtest.h"
#include "plugins/detectors/ground/boxes.h"
#include "plugins/detectors/ground/ground_fusion.h"
#include "plugins/detectors/hog/hog.h"

namespace plaza {
namespace {

TEST(DetectorContract, BoxesKeepsIt) {
  contract::expect_kept(contract::subject_of<BoxesDetector>());
  contract::Trial trial;
  trial.label = "voting, with a margin";
  trial.values = {{"vote_overlap", 0.5}, {"nms_overlap", 0.2}, {"margin_m", 3.0}};
  contract::expect_kept(contract::subject_of<BoxesDetector>(), trial);
}

TEST(DetectorContract, HogKeepsIt) {
  contract::Trial trial;
  trial.world = std::make_shared<contract::World>(2, 8);  // a tenth of a second per frame
  contract::expect_kept(contract::subject_of<HogDetector>(), trial);
}

TEST(DetectorContract, GroundFusionKeepsIt) {
  auto world = std::make_shared<contract::World>();
  // what a detector that works view by view makes of the world: the boxes of each person, one by
  // one
  std::vector<PayloadPtr> by_frame;
  for (std::int64_t frame = 0; frame < world->frame_count(); ++frame) {
    auto single = std::make_shared<Observations>();
    for (const Observation& person : world->observations(frame).items) {
      for (const ViewBox& box : person.boxes) {
        Observation o = person;
        o.boxes = {box};
        o.position_m += Eigen::Vector2d(0.05 * static_cast<double>(box.camera), 0.02);
        single->items.push_back(std::move(o));
      }
    }
    by_frame.push_back(std::move(single));
  }
  world->provide(std::string(Observations::kPort), std::move(by_frame));
  contract::Trial trial;
  trial.world = world;
  contract::expect_kept(contract::subject_of<GroundFusion>(), trial);
}

}  // namespace
}  // namespace plaza
