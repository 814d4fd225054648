#include "plaza/scoring/sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "sequences.h"

namespace plaza {
namespace {

using nlohmann::json;
using testing_support::follow_one;
using testing_support::sequence_of;

/// Every number in a section is declared, so that studies can take it.
void expect_declared(const json& section, const std::vector<MetricSpec>& metrics,
                     const std::set<std::string>& settings) {
  std::set<std::string> names = settings;
  for (const MetricSpec& metric : metrics) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name << " declared twice";
    EXPECT_FALSE(metric.meaning.empty()) << metric.name;
  }
  for (const auto& [key, value] : section.items()) {
    if (value.is_number()) {
      EXPECT_TRUE(names.contains(key)) << key;
    }
  }
}

TEST(Sections, EveryFigureIsDeclared) {
  const PairedSequence similarity = follow_one({1, 1, 2, 0});
  expect_declared(image_detection_section(similarity, 0.3), image_detection_metrics(), {"overlap"});
  expect_declared(image_tracking_section(similarity, 0.3), image_tracking_metrics(), {"overlap"});
  const PairedSequence distance = sequence_of({{{1}, {1}, Eigen::MatrixXd::Constant(1, 1, 0.2)}});
  expect_declared(ground_tracking_figures(distance, 0.5), ground_metrics(), {"distance_m"});
  expect_declared(ground_detection_figures(distance, 0.5), ground_metrics(), {"distance_m"});
  std::vector<MetricSpec> thesis = thesis_detection_metrics();
  for (MetricSpec& m : thesis_tracking_metrics()) thesis.push_back(std::move(m));
  expect_declared(thesis_section(&similarity, &similarity, 0.3), thesis, {"overlap"});
}

TEST(Sections, SweepRepeatsTheFiguresAtEachThreshold) {
  const PairedSequence s = sequence_of({{{1}, {1}, Eigen::MatrixXd::Constant(1, 1, 0.5)}});
  const json detection = image_detection_section(s, 0.3, {0.3, 0.5, 0.7});
  ASSERT_EQ(detection["sweep"].size(), 3U);
  EXPECT_EQ(detection["sweep"][1]["overlap"], 0.5);
  EXPECT_EQ(detection["sweep"][1]["MODA"], 1.0);
  EXPECT_EQ(detection["sweep"][2]["MODA"], -1.0);
  EXPECT_FALSE(detection["sweep"][2].contains("MODP")) << "no match has no mean overlap";
  const json tracking = image_tracking_section(s, 0.3, {0.7});
  EXPECT_EQ(tracking["sweep"][0]["MOTA"], -1.0);
  EXPECT_FALSE(image_tracking_section(s, 0.3).contains("sweep"));
}

TEST(Sections, GroundDetectionKeepsToTheBenchmark) {
  const double far = 9;
  const PairedSequence s = sequence_of({{{1}, {1, 2}, Eigen::MatrixXd::Constant(1, 2, far)}});
  const json section = ground_detection_section(s, 0.5);
  EXPECT_EQ(section["space"], "ground");
  EXPECT_EQ(section["MODA"], 0.0) << "never below 0";
  EXPECT_EQ(section["MODP"], 0.0);
  const json figures = ground_detection_figures(s, 0.5);
  EXPECT_EQ(figures["MODA"], -2.0);
  EXPECT_FALSE(figures.contains("MODP"));
}

TEST(Sections, GroundTrackingLeavesOutWhatIsUndefined) {
  const json none = ground_tracking_figures(sequence_of({{{1}, {}, Eigen::MatrixXd(1, 0)}}), 0.5);
  EXPECT_EQ(none["MOTA"], 0.0);
  EXPECT_EQ(none["recall"], 0.0);
  EXPECT_FALSE(none.contains("mean_error_m"));
  EXPECT_FALSE(none.contains("MOTP"));
  EXPECT_FALSE(none.contains("precision"));
}

TEST(Sections, ThesisCountsTrajectoriesInclusively) {
  const PairedSequence s = follow_one({1, 1, 1, 1, 0});
  const json thesis = thesis_section(nullptr, &s, 0.3);
  EXPECT_EQ(thesis["MT"], 1) << "exactly 80 %";
  EXPECT_EQ(thesis["ML"], 0);
  EXPECT_DOUBLE_EQ(thesis["MOTA"].get<double>(), 0.8);
  EXPECT_FALSE(thesis.contains("MODA"));
  EXPECT_EQ(image_tracking_section(s, 0.3)["MT"], 0);
}

TEST(Sections, ThesisMotaOfNoResultIsZeroAndHasNoMotp) {
  const PairedSequence s = follow_one({0, 0});
  const json thesis = thesis_section(&s, &s, 0.3);
  EXPECT_EQ(thesis["MOTA"], 0.0);
  EXPECT_EQ(thesis["MODA"], 0.0);
  EXPECT_EQ(thesis["ML"], 1);
  EXPECT_FALSE(thesis.contains("MOTP"));
  EXPECT_FALSE(thesis.contains("MODP"));
}

}  // namespace
}  // namespace plaza
