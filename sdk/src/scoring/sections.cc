#include "plaza/scoring/sections.h"

#include <algorithm>
#include <optional>
#include <string>

#include "plaza/scoring/clear.h"
#include "plaza/scoring/detection.h"
#include "plaza/scoring/hota.h"
#include "plaza/scoring/identity.h"
#include "plaza/scoring/persistent_clear.h"

namespace plaza {
namespace {

using nlohmann::json;

/// Of a trajectory's frames.
constexpr double kMostlyTracked = 0.8;
constexpr double kMostlyLost = 0.2;

void put(json& section, const char* key, const std::optional<double>& value) {
  if (value) section[key] = *value;
}

void put_detection(json& section, const DetectionScores& scores) {
  put(section, "MODA", scores.moda());
  put(section, "MODP", scores.modp());
  put(section, "precision", scores.precision());
  put(section, "recall", scores.recall());
  put(section, "F1", scores.f1());
  section["TP"] = scores.tp;
  section["FN"] = scores.fn;
  section["FP"] = scores.fp;
}

void put_clear(json& section, const ClearScores& scores) {
  section["MOTA"] = scores.mota();
  section["MOTP"] = scores.motp();
  section["MODA"] = scores.moda();
  section["TP"] = scores.tp;
  section["FN"] = scores.fn;
  section["FP"] = scores.fp;
  section["IDS"] = scores.id_switches;
  section["GT"] = scores.present.size();
  section["MT"] = scores.mostly_tracked;
  section["PT"] = scores.partly_tracked;
  section["ML"] = scores.mostly_lost;
  section["FM"] = scores.fragments;
  section["Recall"] = scores.recall();
  section["Precision"] = scores.precision();
  section["F1"] = scores.f1();
  section["sMOTA"] = scores.smota();
  section["MOTAL"] = scores.motal();
  section["MOTP_sum"] = scores.similarity_sum;
}

void put_identity(json& section, const IdentityScores& scores) {
  section["IDF1"] = scores.idf1();
  section["IDP"] = scores.idp();
  section["IDR"] = scores.idr();
  section["IDTP"] = scores.idtp;
  section["IDFN"] = scores.idfn;
  section["IDFP"] = scores.idfp;
}

void put_hota(json& section, const HotaScores& scores) {
  section["HOTA"] = HotaScores::mean(scores.hota);
  section["DetA"] = HotaScores::mean(scores.det_a);
  section["AssA"] = HotaScores::mean(scores.ass_a);
  section["DetRe"] = HotaScores::mean(scores.det_re);
  section["DetPr"] = HotaScores::mean(scores.det_pr);
  section["AssRe"] = HotaScores::mean(scores.ass_re);
  section["AssPr"] = HotaScores::mean(scores.ass_pr);
  section["LocA"] = HotaScores::mean(scores.loc_a);
  section["OWTA"] = HotaScores::mean(scores.owta);
  section["HOTA(0)"] = scores.hota.front();
  section["LocA(0)"] = scores.loc_a.front();
  section["HOTA_alpha"] = {{"alpha", scores.alpha}, {"HOTA", scores.hota},  {"DetA", scores.det_a},
                           {"AssA", scores.ass_a},  {"LocA", scores.loc_a}, {"TP", scores.tp},
                           {"FN", scores.fn},       {"FP", scores.fp}};
}

}  // namespace

json image_detection_section(const PairedSequence& similarity, double overlap,
                             const std::vector<double>& sweep) {
  json section = {{"space", "image"}, {"overlap", overlap}};
  put_detection(section, score_overlap_detection(similarity, overlap));
  if (!sweep.empty()) section["sweep"] = json::array();
  for (const double threshold : sweep) {
    json& entry = section["sweep"].emplace_back(json{{"overlap", threshold}});
    put_detection(entry, score_overlap_detection(similarity, threshold));
  }
  return section;
}

json image_tracking_section(const PairedSequence& similarity, double overlap,
                            const std::vector<double>& sweep) {
  json section = {{"space", "image"}, {"overlap", overlap}};
  put_clear(section, score_clear(similarity, overlap));
  put_identity(section, score_identity(similarity, overlap));
  put_hota(section, score_hota(similarity));
  if (!sweep.empty()) section["sweep"] = json::array();
  for (const double threshold : sweep) {
    json& entry = section["sweep"].emplace_back(json{{"overlap", threshold}});
    put_clear(entry, score_clear(similarity, threshold));
    put_identity(entry, score_identity(similarity, threshold));
  }
  return section;
}

json ground_detection_section(const PairedSequence& distance, double distance_m) {
  json section = {{"space", "ground"}, {"distance_m", distance_m}};
  const DetectionScores scores = score_distance_detection(distance, distance_m);
  put_detection(section, scores);
  section["MODA"] = std::max(0.0, scores.moda().value_or(0));
  section["MODP"] = scores.modp().value_or(0);
  section["precision"] = scores.precision().value_or(0);
  section["recall"] = scores.recall().value_or(0);
  return section;
}

json ground_detection_figures(const PairedSequence& distance, double distance_m) {
  json figures = {{"distance_m", distance_m}};
  put_detection(figures, score_distance_detection(distance, distance_m));
  return figures;
}

json ground_tracking_figures(const PairedSequence& distance, double distance_m) {
  json figures = {{"distance_m", distance_m}};
  const PersistentClearScores clear = score_persistent_clear(distance);
  const std::optional<double> error_m = clear.mean_distance();
  put(figures, "MOTA", clear.mota());
  put(figures, "MODA", clear.moda());
  put(figures, "precision", clear.precision());
  put(figures, "recall", clear.recall());
  if (error_m) {
    figures["mean_error_m"] = *error_m;
    figures["MOTP"] = 1 - *error_m;
    figures["MOTP_over_distance"] = 1 - *error_m / distance_m;
  }
  figures["TP"] = clear.detections();
  figures["FN"] = clear.misses;
  figures["FP"] = clear.false_positives;
  figures["IDS"] = clear.switches;
  figures["GT"] = clear.unique_objects;
  figures["MT"] = clear.mostly_tracked;
  figures["PT"] = clear.partly_tracked;
  figures["ML"] = clear.mostly_lost;
  figures["FM"] = clear.fragments;
  figures["num_matches"] = clear.matches;
  figures["num_transfer"] = clear.transfers;
  figures["num_ascend"] = clear.ascends;
  figures["num_migrate"] = clear.migrates;
  figures["num_objects"] = clear.objects;
  figures["num_predictions"] = clear.predictions;
  figures["num_frames"] = clear.frames;
  put_identity(figures, score_identity_of_distance(distance));

  const PairedSequence similarity = similarity_from_distance(distance, 2 * distance_m);
  const HotaScores hota = score_hota(similarity);
  put_hota(figures, hota);
  json& euclid = figures["trackeval_euclid"];
  put_clear(euclid, score_clear(similarity, 0.5));
  put_identity(euclid, score_identity(similarity, 0.5));
  put_hota(euclid, hota);
  euclid.erase("HOTA_alpha");  // stands one level up
  return figures;
}

json thesis_section(const PairedSequence* detected, const PairedSequence* tracked, double overlap) {
  json section = {{"overlap", overlap}};
  if (detected != nullptr) {
    const DetectionScores scores = score_overlap_detection(*detected, overlap);
    put(section, "MODA", scores.moda());
    put(section, "MODP", scores.frame_modp());
  }
  if (tracked != nullptr && tracked->truth_count > 0) {
    const ClearScores scores = score_clear(*tracked, overlap);
    std::int64_t mostly_tracked = 0;
    std::int64_t mostly_lost = 0;
    for (std::size_t i = 0; i < scores.present.size(); ++i) {
      const double share =
          static_cast<double>(scores.matched[i]) / static_cast<double>(scores.present[i]);
      if (share >= kMostlyTracked) ++mostly_tracked;
      if (share < kMostlyLost) ++mostly_lost;
    }
    section["MOTA"] = 1 - static_cast<double>(scores.fn + scores.fp + scores.id_switches) /
                              static_cast<double>(tracked->truth_count);
    if (scores.tp > 0) section["MOTP"] = scores.motp();
    section["MT"] = mostly_tracked;
    section["ML"] = mostly_lost;
  }
  return section;
}

}  // namespace plaza
