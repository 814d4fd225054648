#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "plaza/component/declaration.h"
#include "plugins/evaluators/scores/detection_scores.h"
#include "plugins/evaluators/scores/ground_scores.h"
#include "plugins/evaluators/scores/tracking_scores.h"

namespace plaza::scores {
namespace {

const Box kBox{100, 100, 20, 60};

std::shared_ptr<Scene> one_camera() {
  CameraFromWorld pose;  // 2 m above the ground, looking along +y
  pose.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  pose.translation = -pose.rotation * Eigen::Vector3d(0, 0, 2);
  PinholeIntrinsics k;
  k.fx_px = k.fy_px = 500;
  k.cx_px = 320;
  k.cy_px = 240;
  auto scene = std::make_shared<Scene>();
  scene->cameras.push_back(Camera::pinhole("a", {640, 480}, k, pose));
  return scene;
}

BuildContext context() {
  BuildContext c;
  c.scene = one_camera();
  return c;
}

std::shared_ptr<GroundTruth> truth_at(double x_m, bool with_box = true) {
  auto truth = std::make_shared<GroundTruth>();
  TruePerson person;
  person.id = 1;
  person.position_m = Eigen::Vector2d(x_m, 6);
  if (with_box) person.views.push_back({.camera = 0, .box = kBox, .visibility = 1});
  truth->people.push_back(person);
  return truth;
}

std::shared_ptr<Observations> observation_at(double x_m) {
  auto observations = std::make_shared<Observations>();
  Observation o;
  o.position_m = Eigen::Vector2d(x_m, 6);
  o.boxes.push_back({.camera = 0, .box = kBox, .score = 1});
  observations->items.push_back(o);
  return observations;
}

TrackPoint point(TrackId id, std::int64_t frame, double x_m, bool final = true) {
  TrackPoint p;
  p.id = id;
  p.frame = frame;
  p.position_m = Eigen::Vector2d(x_m, 6);
  p.final = final;
  p.boxes.push_back({.camera = 0, .box = kBox, .score = 1});
  return p;
}

std::shared_ptr<Tracks> tracks(std::vector<TrackPoint> points) {
  auto t = std::make_shared<Tracks>();
  t->points = std::move(points);
  return t;
}

/// Hands the node its inputs, ten frames a second, in the order of its declaration; null: not
/// there.
void observe(Node& node, std::int64_t frame, std::vector<PayloadPtr> inputs, bool flush = false) {
  std::vector<int> slots;
  for (std::size_t i = 0; i < inputs.size(); ++i) slots.push_back(static_cast<int>(i));
  NodeIo io(frame, frame * 100'000'000, inputs.data(), slots, {});
  flush ? node.flush(io) : node.process(io);
}

TEST(DetectionScoresTest, ScoresObservationsByTheirBoxes) {
  DetectionScores node({}, context());
  observe(node, 0, {observation_at(0), truth_at(0)});
  observe(node, 1, {std::make_shared<Observations>(), truth_at(0)});
  const Evaluation e = node.evaluate();
  EXPECT_EQ(e.at("detection")["MODA"], 0.5);
  EXPECT_EQ(e.at("detection")["MODP"], 1.0);
  EXPECT_EQ(e.at("detection")["overlap"], 0.3);
  EXPECT_EQ(e.at("detection")["sweep"].size(), 9U);
  EXPECT_EQ(e.at("thesis")["MODA"], 0.5);
  EXPECT_FALSE(e.at("thesis").contains("MOTA"));
}

TEST(DetectionScoresTest, FramesThatNobodyLookedAtCountForNothing) {
  DetectionScores node({}, context());
  auto unseen = std::make_shared<GroundTruth>();
  unseen->annotated = false;
  observe(node, 0, {observation_at(0), truth_at(0)});
  observe(node, 1, {observation_at(0), unseen});
  EXPECT_EQ(node.evaluate().at("detection")["FP"], 0);
}

TEST(DetectionScoresTest, WithoutTrueBoxesThereIsNoSection) {
  DetectionScores node({}, context());
  observe(node, 0, {observation_at(0), truth_at(0, /*with_box=*/false)});
  EXPECT_TRUE(node.evaluate().empty());
}

TEST(TrackingScoresTest, WaitsForFinalPoints) {
  TrackingScores node({}, context());
  observe(node, 0, {tracks({point(7, 0, 0, /*final=*/false)}), truth_at(0)});
  observe(node, 1, {tracks({point(7, 0, 0)}), truth_at(0)});
  observe(node, 2, {tracks({point(8, 1, 0), point(9, 2, 0)}), nullptr}, /*flush=*/true);
  const Evaluation e = node.evaluate();
  EXPECT_EQ(e.at("tracking")["TP"], 2);
  EXPECT_EQ(e.at("tracking")["FP"], 0) << "frame 2 has no truth";
  EXPECT_EQ(e.at("tracking")["IDS"], 1);
  EXPECT_EQ(e.at("tracking")["MOTA"], 0.5);
  EXPECT_EQ(e.at("thesis")["MT"], 1);
}

TEST(TrackingScoresTest, AFinalPointDoesNotComeTwice) {
  TrackingScores node({}, context());
  EXPECT_THROW(observe(node, 0, {tracks({point(7, 0, 0), point(7, 0, 1)}), truth_at(0)}),
               InternalError);
}

TEST(GroundScoresTest, ObservationsGiveModaAndTracksTheRest) {
  GroundScores node({}, context());
  observe(node, 0, {truth_at(0), observation_at(0.25), tracks({point(7, 0, 0.4)})});
  observe(node, 1, {truth_at(0), std::make_shared<Observations>(), tracks({point(7, 1, 0.2)})});
  const auto ground = node.evaluate().at("ground");
  EXPECT_EQ(ground["distance_m"], 0.5);
  EXPECT_EQ(ground["MODA"], 0.5);
  EXPECT_EQ(ground["MODP"], 0.5);
  EXPECT_EQ(ground["MODA_from"], "observations");
  EXPECT_EQ(ground["MOTA"], 1.0);
  EXPECT_NEAR(ground["mean_error_m"].get<double>(), 0.3, 1e-12);
  ASSERT_EQ(ground["sweep"].size(), 4U);
  EXPECT_EQ(ground["sweep"][0]["MOTA"], 0.0);
}

TEST(GroundScoresTest, WithTracksAlone) {
  GroundScores node({}, context());
  observe(node, 0, {truth_at(0), nullptr, tracks({point(7, 0, 0.4)})});
  const auto ground = node.evaluate().at("ground");
  EXPECT_EQ(ground["MODA"], 1.0);
  EXPECT_EQ(ground["MODA_from"], "tracks");
}

TEST(ScoresTest, FramesBeforeTheTimeCountForNothing) {
  const auto miss = std::make_shared<Observations>();
  DetectionScores detection(ImageScores::Options{.overlap = 0.3, .sweep = {}, .from_s = 0.3},
                            context());
  TrackingScores tracking(ImageScores::Options{.overlap = 0.3, .sweep = {}, .from_s = 0.3},
                          context());
  GroundScores ground({.distance_m = 0.5, .sweep = {}, .from_s = 0.3}, context());
  for (std::int64_t frame = 0; frame < 8; ++frame) {
    const bool found = frame >= 4;  // missed in the frames 0 to 3, of which 3 counts
    const auto seen = found ? observation_at(0) : miss;
    const auto track = tracks(found ? std::vector{point(7, frame, 0)} : std::vector<TrackPoint>());
    observe(detection, frame, {seen, truth_at(0)});
    observe(tracking, frame, {track, truth_at(0)});
    observe(ground, frame, {truth_at(0), seen, track});
  }
  EXPECT_DOUBLE_EQ(detection.evaluate().at("detection")["MODA"], 0.8);
  EXPECT_DOUBLE_EQ(tracking.evaluate().at("tracking")["MOTA"], 0.8);
  EXPECT_DOUBLE_EQ(ground.evaluate().at("ground")["MODA"], 0.8);
  EXPECT_DOUBLE_EQ(ground.evaluate().at("ground")["MOTA"], 0.8);
}

TEST(ScoresTest, MetricsAreDeclaredOnce) {
  for (const ComponentDeclaration& info :
       {DetectionScores::declare().info("evaluator"), TrackingScores::declare().info("evaluator"),
        GroundScores::declare().info("evaluator")}) {
    std::set<std::string> names;
    for (const MetricSpec& m : info.metrics) {
      EXPECT_TRUE(names.insert(m.section + "." + m.name).second) << info.name << ' ' << m.name;
    }
    EXPECT_GT(names.size(), 8U);
  }
}

}  // namespace
}  // namespace plaza::scores
