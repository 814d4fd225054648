#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "plaza/component/declaration.h"
#include "plugins/evaluators/diagnosis/detection_errors.h"
#include "plugins/evaluators/diagnosis/reliability.h"
#include "tests/sdk/geometry/test_cameras.h"

namespace plaza::diagnosis {
namespace {

BuildContext context() {
  auto scene = std::make_shared<Scene>();
  scene->area = {{-10, -10}, {10, 10}};
  scene->cameras.push_back(Camera::pinhole("south", {640, 480}, {700, 700, 319.5, 239.5, {}},
                                           test::look_at({0, -20, 6}, {0, 0, 0.8})));
  BuildContext c;
  c.scene = scene;
  return c;
}

std::shared_ptr<GroundTruth> people_at(const std::vector<Eigen::Vector2d>& places,
                                       bool boxes = true) {
  const BuildContext c = context();
  auto truth = std::make_shared<GroundTruth>();
  for (const Eigen::Vector2d& place : places) {
    TruePerson person;
    person.id = static_cast<std::int64_t>(truth->people.size()) + 1;
    person.position_m = place;
    const Box box = *body_box(c.scene->cameras[0], place, c.scene->body);
    if (boxes) person.views.push_back({0, box, 1.0});
    truth->people.push_back(person);
  }
  return truth;
}

Observation seen_at(const Eigen::Vector2d& place, double score, double probability) {
  Observation o;
  o.position_m = place;
  o.covariance_m2 = 0.04 * Eigen::Matrix2d::Identity();
  o.score = score;
  o.probability = probability;
  return o;
}

std::shared_ptr<Observations> seen(const std::vector<Observation>& items) {
  auto observations = std::make_shared<Observations>();
  observations->items = items;
  return observations;
}

void observe(Node& node, std::int64_t frame, std::vector<PayloadPtr> inputs) {
  const std::vector<int> slots = {0, 1};
  NodeIo io(frame, 0, inputs.data(), slots, {});
  node.process(io);
}

TEST(DetectionErrorsEvaluator, CountsEveryErrorOnceAndSharesOfThem) {
  DetectionErrors node({}, context());
  observe(node, 0, {seen({seen_at({0, 0}, 1, 0.5)}), people_at({{0, 0}, {4, 2}})});
  observe(node, 1,
          {seen({seen_at({0.9, 0}, 1, 0.5), seen_at({-5, 5}, 1, 0.5)}), people_at({{0, 0}})});
  const auto e = node.evaluate().at("errors");
  EXPECT_EQ(e["misses"], 2);
  EXPECT_EQ(e["missed_unexplained"], 1);
  EXPECT_EQ(e["missed_displaced"], 1);
  EXPECT_EQ(e["missed_displaced_share"], 0.5);
  EXPECT_EQ(e["missed_behind_people"], 0);
  EXPECT_EQ(e["false_alarms"], 2);
  EXPECT_EQ(e["alarms_displaced"], 1);
  EXPECT_EQ(e["alarms_unexplained"], 1);
  EXPECT_EQ(e["alarms_ghost_share"], 0.0);
  EXPECT_EQ(e["people_in_sight"], 3);
  EXPECT_EQ(e["miss_rate_in_sight"], 2.0 / 3);
  EXPECT_FALSE(e.contains("miss_rate_at_border")) << "nobody was there";
}

TEST(DetectionErrorsEvaluator, WithoutErrorsThereAreNoShares) {
  DetectionErrors node({}, context());
  observe(node, 0, {seen({seen_at({0, 0}, 1, 0.5)}), people_at({{0, 0}})});
  const auto e = node.evaluate().at("errors");
  EXPECT_EQ(e["misses"], 0);
  EXPECT_FALSE(e.contains("missed_displaced_share"));
}

TEST(DetectionErrorsEvaluator, WithoutTrueBoxesThereIsNoSection) {
  DetectionErrors node({}, context());
  observe(node, 0, {seen({seen_at({0, 0}, 1, 0.5)}), people_at({{0, 0}}, /*boxes=*/false)});
  EXPECT_TRUE(node.evaluate().empty());
}

TEST(ReliabilityEvaluator, JudgesProbabilitiesAndPositions) {
  Reliability node({}, context());
  observe(node, 0,
          {seen({seen_at({0.2, 0}, 3, 0.9), seen_at({-5, 5}, 1, 0.3)}), people_at({{0, 0}})});
  const auto r = node.evaluate().at("reliability");
  EXPECT_EQ(r["observations"], 2);
  EXPECT_EQ(r["right_share"], 0.5);
  EXPECT_NEAR(r["brier"].get<double>(), (0.01 + 0.09) / 2, 1e-12);
  EXPECT_NEAR(r["calibration_error"].get<double>(), (0.1 + 0.3) / 2, 1e-12);
  EXPECT_EQ(r["curve"], nlohmann::json({{1.0, 0.25}, {3.0, 0.75}}));
  EXPECT_EQ(r["positions"], 1);
  EXPECT_NEAR(r["variance_ratio"].get<double>(), 0.5, 1e-12) << "one sigma away: 1 / 2";
  EXPECT_EQ(r["inside_50"], 1.0);
}

TEST(ReliabilityEvaluator, WithoutObservationsOrTruthThereIsNoSection) {
  Reliability node({}, context());
  observe(node, 0, {seen({}), people_at({{0, 0}})});
  EXPECT_TRUE(node.evaluate().empty());
  Reliability no_truth({}, context());
  observe(no_truth, 0, {seen({seen_at({0, 0}, 1, 0.5)}), people_at({{0, 0}}, /*boxes=*/false)});
  EXPECT_TRUE(no_truth.evaluate().empty());
}

TEST(Diagnosis, MetricsAreDeclaredOnce) {
  for (const ComponentDeclaration& info :
       {DetectionErrors::declare().info("evaluator"), Reliability::declare().info("evaluator")}) {
    std::set<std::string> names;
    for (const MetricSpec& m : info.metrics) {
      EXPECT_TRUE(names.insert(m.section + "." + m.name).second) << info.name << ' ' << m.name;
    }
    EXPECT_GT(names.size(), 8U);
  }
}

}  // namespace
}  // namespace plaza::diagnosis
