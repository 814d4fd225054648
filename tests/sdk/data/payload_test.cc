#include "plaza/data/payload.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <vector>

#include "plaza/data/detections.h"
#include "plaza/data/evidence.h"
#include "plaza/data/frames.h"
#include "plaza/data/ground_likelihood.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"

namespace plaza {
namespace {

TEST(PayloadTest, EveryTypeHasAPortOfItsOwn) {
  const std::vector<PayloadPtr> payloads{
      std::make_shared<Detections>(),      std::make_shared<EvidenceSet>(),
      std::make_shared<ForegroundMask>(),  std::make_shared<FrameSet>(),
      std::make_shared<GroundTruth>(),     std::make_shared<Observations>(),
      std::make_shared<Tracks>(),          std::make_shared<Tracklets>(),
      std::make_shared<GroundLikelihood>()};
  std::set<std::string_view> ports;
  for (const PayloadPtr& payload : payloads) ports.insert(payload->port());
  EXPECT_EQ(ports.size(), payloads.size());
  EXPECT_TRUE(ports.contains("Frames"));
  EXPECT_TRUE(ports.contains("Tracks"));
}

TEST(PayloadTest, ThePortTellsTheTypeBehindThePointer) {
  auto tracks = std::make_shared<Tracks>();
  tracks->points.push_back({});
  const PayloadPtr payload = tracks;
  EXPECT_EQ(payload->port(), Tracks::kPort);
  ASSERT_NE(dynamic_cast<const Tracks*>(payload.get()), nullptr);
  EXPECT_EQ(dynamic_cast<const Tracks*>(payload.get())->points.size(), 1u);
  EXPECT_EQ(dynamic_cast<const Tracklets*>(payload.get()), nullptr);
}

TEST(PayloadTest, DefaultsAreHonest) {
  EXPECT_TRUE(GroundTruth().annotated);
  EXPECT_FALSE(TrackPoint().final) << "a point that nobody ended is not part of the answer";
  EXPECT_FALSE(Observation().heading_rad.has_value());
  EXPECT_FALSE(Observations().grid.has_value());
}

}  // namespace
}  // namespace plaza
