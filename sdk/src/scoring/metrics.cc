// What the figures of plaza/scoring/sections.h mean, for evaluators' declarations.
#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "plaza/scoring/sections.h"

namespace plaza {
namespace {

struct Figure {
  const char* name;
  const char* unit;
  Better better;
  const char* meaning;
};

/// The figures that papers print; the others explain them.
bool is_detail(std::string_view name) {
  constexpr std::array kHeadline = {"MODA",         "MODP", "precision", "recall", "MOTA", "MOTP",
                                    "mean_error_m", "FN",   "FP",        "IDS",    "GT",   "MT",
                                    "PT",           "ML",   "FM",        "IDF1",   "HOTA"};
  return std::find(kHeadline.begin(), kHeadline.end(), name) == kHeadline.end();
}

void add(std::vector<MetricSpec>& out, const char* section, std::initializer_list<Figure> figures) {
  for (const Figure& f : figures) {
    out.push_back({.section = section,
                   .name = f.name,
                   .unit = f.unit,
                   .better = f.better,
                   .meaning = f.meaning,
                   .detail = is_detail(f.name)});
  }
}

constexpr Better kHigher = Better::kHigher;
constexpr Better kLower = Better::kLower;
constexpr Better kNeither = Better::kNeither;

void add_detection(std::vector<MetricSpec>& out, const char* section, const char* modp) {
  add(out, section,
      {{"MODA", "", kHigher, "1 - (misses + false alarms) / true people"},
       {"MODP", "", kHigher, modp},
       {"precision", "", kHigher, "share of the results that match"},
       {"recall", "", kHigher, "share of the true people that are found"},
       {"F1", "", kHigher, "harmonic mean of precision and recall"}});
}

void add_counts(std::vector<MetricSpec>& out, const char* section) {
  add(out, section,
      {{"TP", "", kHigher, "matches, summed over the frames"},
       {"FN", "", kLower, "true people without a match, summed over the frames"},
       {"FP", "", kLower, "results without a match, summed over the frames"}});
}

void add_trajectories(std::vector<MetricSpec>& out, const char* section,
                      const char* mostly_tracked) {
  add(out, section,
      {{"IDS", "", kLower, "matches to another identity than the true person's last one"},
       {"GT", "", kNeither, "true trajectories"},
       {"MT", "", kHigher, mostly_tracked},
       {"PT", "", kNeither, "true trajectories that are neither mostly tracked nor mostly lost"},
       {"ML", "", kLower, "true trajectories matched in less than 20 % of their frames"},
       {"FM", "", kLower, "interruptions of true trajectories that were taken up again"}});
}

void add_identity(std::vector<MetricSpec>& out, const char* section) {
  add(out, section,
      {{"IDF1", "", kHigher, "harmonic mean of IDP and IDR"},
       {"IDP", "", kHigher,
        "share of the result that bears the identity assigned to the trajectory"},
       {"IDR", "", kHigher, "share of the truth that is found under that identity"},
       {"IDTP", "", kHigher, "frames in which assigned trajectories meet"},
       {"IDFN", "", kLower, "frames of the truth in which they do not"},
       {"IDFP", "", kLower, "frames of the result in which they do not"}});
}

void add_hota(std::vector<MetricSpec>& out, const char* section) {
  add(out, section,
      {{"HOTA", "", kHigher, "geometric mean of DetA and AssA, averaged over 19 thresholds"},
       {"DetA", "", kHigher, "detection accuracy, averaged over the thresholds"},
       {"AssA", "", kHigher, "association accuracy, averaged over the thresholds"},
       {"DetRe", "", kHigher, "detection recall, averaged over the thresholds"},
       {"DetPr", "", kHigher, "detection precision, averaged over the thresholds"},
       {"AssRe", "", kHigher, "association recall, averaged over the thresholds"},
       {"AssPr", "", kHigher, "association precision, averaged over the thresholds"},
       {"LocA", "", kHigher, "mean similarity of the matches, averaged over the thresholds"},
       {"OWTA", "", kHigher, "geometric mean of DetRe and AssA, averaged over the thresholds"},
       {"HOTA(0)", "", kHigher, "HOTA at the lowest threshold, 0.05"},
       {"LocA(0)", "", kHigher, "LocA at the lowest threshold, 0.05"}});
}

}  // namespace

std::vector<MetricSpec> image_detection_metrics() {
  std::vector<MetricSpec> out;
  add_detection(out, "detection", "mean overlap of the matches");
  add_counts(out, "detection");
  return out;
}

std::vector<MetricSpec> image_tracking_metrics() {
  std::vector<MetricSpec> out;
  add(out, "tracking",
      {{"MOTA", "", kHigher, "1 - (misses + false alarms + identity switches) / true people"},
       {"MOTP", "", kHigher, "mean overlap of the matches"},
       {"MODA", "", kHigher, "1 - (misses + false alarms) / true people, of the tracks"},
       {"Recall", "", kHigher, "share of the true people that are tracked"},
       {"Precision", "", kHigher, "share of the track points that match"},
       {"F1", "", kHigher, "harmonic mean of Precision and Recall"},
       {"sMOTA", "", kHigher, "MOTA with matches counted by their overlap"},
       {"MOTAL", "", kHigher, "MOTA with the decimal logarithm of the identity switches"},
       {"MOTP_sum", "", kHigher, "overlap summed over the matches"}});
  add_counts(out, "tracking");
  add_trajectories(out, "tracking", "true trajectories matched in more than 80 % of their frames");
  add_identity(out, "tracking");
  add_hota(out, "tracking");
  return out;
}

std::vector<MetricSpec> ground_metrics() {
  std::vector<MetricSpec> out;
  add_detection(out, "ground", "mean of 1 - distance / threshold over the matches");
  add(out, "ground",
      {{"MOTA", "", kHigher, "1 - (misses + false alarms + identity switches) / true people"},
       {"MOTP", "", kHigher, "1 - mean distance of the matches in metres"},
       {"MOTP_over_distance", "", kHigher, "1 - mean distance of the matches / threshold"},
       {"mean_error_m", "m", kLower, "mean distance of the matches"},
       {"num_matches", "", kHigher, "matches that are no identity switches"},
       {"num_transfer", "", kLower, "result identities that went over to another true person"},
       {"num_ascend", "", kLower, "identity switches to an identity that was never matched before"},
       {"num_migrate", "", kLower, "transfers to a true person who was never matched before"},
       {"num_objects", "", kNeither, "true people, summed over the frames"},
       {"num_predictions", "", kNeither, "results, summed over the frames"},
       {"num_frames", "", kNeither, "frames evaluated"}});
  add_counts(out, "ground");
  add_trajectories(out, "ground", "true trajectories matched in at least 80 % of their frames");
  add_identity(out, "ground");
  add_hota(out, "ground");
  return out;
}

std::vector<MetricSpec> thesis_detection_metrics() {
  std::vector<MetricSpec> out;
  add(out, "thesis",
      {{"MODA", "", kHigher, "thesis (3.1): 1 - (misses + false alarms) / true people"},
       {"MODP", "", kHigher,
        "thesis (3.3): the frames' mean overlaps, averaged over frames with a match"}});
  return out;
}

std::vector<MetricSpec> thesis_tracking_metrics() {
  std::vector<MetricSpec> out;
  add(out, "thesis",
      {{"MOTA", "", kHigher, "thesis (3.6): 1 - (misses + false alarms + switches) / true people"},
       {"MOTP", "", kHigher, "thesis (3.7): mean overlap of all matches"},
       {"MT", "", kHigher, "true trajectories matched in at least 80 % of their frames"},
       {"ML", "", kLower, "true trajectories matched in less than 20 % of their frames"}});
  return out;
}

}  // namespace plaza
