// Agreement with the figures of the field's reference evaluators, case by case.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "plaza/scoring/detection.h"
#include "plaza/scoring/identity.h"
#include "plaza/scoring/mot_challenge.h"
#include "plaza/scoring/persistent_clear.h"
#include "plaza/scoring/sections.h"

namespace plaza {
namespace {

using nlohmann::json;
constexpr double kAgreement = 1e-9;

std::filesystem::path cases() {
  const char* data = std::getenv("PLAZA_DATA");
  const std::filesystem::path root =
      data != nullptr ? std::filesystem::path(data)
                      : std::filesystem::path(PLAZA_SOURCE_DIR) / ".." / "shared" / "data";
  return root / "eval-cases";
}

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(cases(), error)) {
    names.push_back(entry.path().filename().string());
  }
  if (names.empty()) names.push_back("absent");
  std::sort(names.begin(), names.end());
  return names;
}

class ReferenceCase : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    folder_ = cases() / GetParam();
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << "no reference cases at " << cases();
    std::ifstream in(folder_ / "expected.json");
    expected_ = json::parse(in);
  }

  /// Each figure of `expected`, under our name where that differs.
  static void compare(const json& expected, const json& got,
                      const std::map<std::string, std::string>& names) {
    for (const auto& [key, value] : expected.items()) {
      const auto renamed = names.find(key);
      const std::string& ours = renamed == names.end() ? key : renamed->second;
      ASSERT_TRUE(got.contains(ours)) << ours;
      if (value.is_array()) {
        ASSERT_EQ(got[ours].size(), value.size()) << ours;
        for (std::size_t i = 0; i < value.size(); ++i) {
          EXPECT_NEAR(got[ours][i].get<double>(), value[i].get<double>(), kAgreement)
              << ours << ' ' << i;
        }
      } else {
        EXPECT_NEAR(got[ours].get<double>(), value.get<double>(), kAgreement) << ours;
      }
    }
  }

  MotFile mot(const char* name) const {
    const std::string file = (folder_ / name).string();
    return {file, read_mot_rows(file, {.last_frame = expected_["num_frames"].get<std::int64_t>()})};
  }

  std::filesystem::path folder_;
  json expected_;
};

TEST_P(ReferenceCase, Boxes) {
  if (!expected_.contains("CLEAR")) return;
  const PairedSequence similarity = pair_mot_rows(
      mot("gt.txt"), mot("result.txt"), *mot_rules_from(expected_["benchmark"].get<std::string>()));
  EXPECT_EQ(similarity.truth_count, expected_["counts"]["gt_dets"]);
  EXPECT_EQ(similarity.truth_identities, expected_["counts"]["gt_ids"]);
  EXPECT_EQ(similarity.result_count, expected_["counts"]["tracker_dets"]);
  EXPECT_EQ(similarity.result_identities, expected_["counts"]["tracker_ids"]);
  const json got = image_tracking_section(similarity, expected_["iou_threshold"].get<double>());
  compare(expected_["CLEAR"], got, {{"IDSW", "IDS"}, {"Frag", "FM"}});
  compare(expected_["Identity"], got, {});
  compare(expected_["HOTA"], got, {});
  compare(expected_["HOTA_alpha"], got["HOTA_alpha"], {});
}

const std::map<std::string, std::string> kMotmetricsNames = {
    {"idf1", "IDF1"},
    {"idp", "IDP"},
    {"idr", "IDR"},
    {"num_unique_objects", "GT"},
    {"mostly_tracked", "MT"},
    {"partially_tracked", "PT"},
    {"mostly_lost", "ML"},
    {"num_false_positives", "FP"},
    {"num_misses", "FN"},
    {"num_switches", "IDS"},
    {"num_fragmentations", "FM"},
    {"mota", "MOTA"},
    {"moda", "MODA"},
    {"num_detections", "TP"},
    {"idtp", "IDTP"},
    {"idfp", "IDFP"},
    {"idfn", "IDFN"},
    {"motp", "mean_error_m"},
    {"motp_mean_distance_m", "mean_error_m"},
    {"motp_1_minus_d", "MOTP"},
    {"motp_1_minus_d_over_thr", "MOTP_over_distance"}};

TEST_P(ReferenceCase, PersistentRulesOnBoxes) {
  if (!expected_.contains("motmetrics_2d")) return;
  PairedSequence distance = pair_mot_rows(mot("gt.txt"), mot("result.txt"), MotRules::kMot15);
  for (PairedFrame& frame : distance.frames) {
    frame.values = frame.values
                       .unaryExpr([](double s) {
                         return 1 - s > 0.5 ? std::numeric_limits<double>::infinity() : 1 - s;
                       })
                       .eval();
  }
  compare(expected_["motmetrics_2d"], ground_tracking_figures(distance, 0.5), kMotmetricsNames);
}

TEST_P(ReferenceCase, Ground) {
  if (!expected_.contains("mvdet_pyeval")) return;
  const auto truth = read_ground_rows(folder_ / "gt.txt", {.first_frame = 0});
  const auto result = read_ground_rows(folder_ / "result.txt", {.first_frame = 0});
  const bool cells = !expected_.contains("motmetrics");
  PairedSequence near = pair_ground_rows(truth, result, /*has_identities=*/false);
  const double threshold = cells ? 20 : expected_["det_thr_m"].get<double>();
  const auto compare_detection = [&](const json& percent) {
    const json got = ground_detection_section(near, threshold);
    EXPECT_NEAR(got["MODA"].get<double>(), percent["moda"].get<double>() / 100, kAgreement);
    EXPECT_NEAR(got["MODP"].get<double>(), percent["modp"].get<double>() / 100, kAgreement);
    EXPECT_NEAR(got["precision"].get<double>(), percent["precision"].get<double>() / 100,
                kAgreement);
    EXPECT_NEAR(got["recall"].get<double>(), percent["recall"].get<double>() / 100, kAgreement);
    EXPECT_EQ(near.frames.size(), percent["frames"]);
  };
  compare_detection(expected_["mvdet_pyeval_all_gt_frames"]);
  std::erase_if(near.frames, [](const PairedFrame& frame) { return frame.result.empty(); });
  compare_detection(expected_["mvdet_pyeval"]);
  if (cells) return;
  const double thr_m = expected_["thr_m"].get<double>();
  const json got = ground_tracking_figures(pair_ground_rows(truth, result, true, thr_m), thr_m);
  compare(expected_["motmetrics"], got, kMotmetricsNames);
  compare(expected_["trackeval_euclid"], got["trackeval_euclid"],
          {{"IDSW", "IDS"}, {"Frag", "FM"}, {"MOTP_sim", "MOTP"}});
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceCase, ::testing::ValuesIn(case_names()),
                         [](const auto& param) {
                           std::string name = param.param;
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace plaza
