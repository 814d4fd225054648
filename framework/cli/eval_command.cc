#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "framework/cli/commands.h"
#include "framework/cli/context.h"
#include "plaza/core/error.h"
#include "plaza/io/mot_rows.h"
#include "plaza/scoring/mot_challenge.h"
#include "plaza/scoring/sections.h"

namespace plaza {
namespace {

using nlohmann::json;

// What the field uses where the user names nothing.
constexpr double kOverlap = 0.5;
constexpr double kThesisOverlap = 0.3;
constexpr double kTrackingDistanceM = 1.0;
constexpr double kDetectionDistanceM = 0.5;

struct EvalOptions {
  std::string gt;
  std::string result;
  std::string rules = "MOT15";
  std::optional<std::int64_t> last_frame;
  std::optional<double> iou;
  std::optional<double> distance_m;
  double unit_m = 1.0;
  bool as_json = false;
};

template <class Row>
bool has_identities(const std::vector<Row>& rows) {
  return std::any_of(rows.begin(), rows.end(),
                     [](const Row& row) { return row.id != kNoIdentity; });
}

json evaluate_boxes(const EvalOptions& options, MotRules rules, json& counts) {
  const RowLimits limits{.first_frame = 1, .last_frame = options.last_frame};
  const MotFile truth{options.gt, read_mot_rows(options.gt, limits)};
  const MotFile result{options.result, read_mot_rows(options.result, limits)};
  const bool tracked = has_identities(truth.rows) && has_identities(result.rows);

  std::int64_t last_frame = options.last_frame.value_or(1);
  for (const auto* rows : {&truth.rows, &result.rows}) {
    for (const MotRow& row : *rows) last_frame = std::max(last_frame, row.frame);
  }
  PairedSequence similarity;
  if (tracked) {
    similarity = pair_mot_rows(truth, result, rules);
  } else {
    MotFile people = truth;  // nobody's identity counts: number them within each frame
    for (std::size_t i = 0; i < people.rows.size(); ++i)
      people.rows[i].id = static_cast<std::int64_t>(i);
    similarity = pair_mot_rows(people, result, rules, /*has_identities=*/false);
  }
  counts = {{"frames", last_frame},
            {"gt_dets", similarity.truth_count},
            {"tracker_dets", similarity.result_count}};

  const double overlap = options.iou.value_or(kOverlap);
  json evaluation;
  evaluation["detection"] = image_detection_section(similarity, overlap);
  if (tracked) {
    counts["gt_ids"] = similarity.truth_identities;
    counts["tracker_ids"] = similarity.result_identities;
    evaluation["tracking"] = image_tracking_section(similarity, overlap);
  }
  evaluation["thesis"] = thesis_section(&similarity, tracked ? &similarity : nullptr,
                                        options.iou.value_or(kThesisOverlap));
  return evaluation;
}

/// Distances are compared in the files' own unit: cells of a grid then lie exactly at thresholds.
std::vector<GroundRow> read_in_file_unit(const std::string& file, const RowLimits& limits,
                                         double unit_m) {
  std::vector<GroundRow> rows = read_ground_rows(file, limits);
  for (GroundRow& row : rows) {
    if (row.named_metres) row.position_m /= unit_m;
  }
  return rows;
}

PairedSequence in_metres(PairedSequence distance, double unit_m) {
  for (PairedFrame& frame : distance.frames) frame.values *= unit_m;
  return distance;
}

PairedSequence frames_with_results(PairedSequence sequence) {
  std::erase_if(sequence.frames, [](const PairedFrame& frame) { return frame.result.empty(); });
  return sequence;
}

json evaluate_ground(const EvalOptions& options, json& counts) {
  const RowLimits limits{.first_frame = 0, .last_frame = options.last_frame};
  const std::vector<GroundRow> truth = read_in_file_unit(options.gt, limits, options.unit_m);
  const std::vector<GroundRow> result = read_in_file_unit(options.result, limits, options.unit_m);
  const bool tracked = has_identities(truth) && has_identities(result);
  std::set<std::int64_t> frames;
  for (const GroundRow& row : truth) frames.insert(row.frame);
  const auto elsewhere =
      std::count_if(result.begin(), result.end(),
                    [&frames](const GroundRow& row) { return !frames.contains(row.frame); });

  const double detection_m = options.distance_m.value_or(kDetectionDistanceM);
  const double tracking_m = options.distance_m.value_or(kTrackingDistanceM);
  // The detection rule is scored in file units, too, and knows distances only as parts of the
  // threshold.
  const PairedSequence near = pair_ground_rows(truth, result, /*has_identities=*/false);
  counts = {{"frames", frames.size()},
            {"gt_dets", near.truth_count},
            {"tracker_dets", near.result_count},
            {"tracker_dets_in_other_frames", elsewhere}};
  json evaluation;
  evaluation["detection"] = ground_detection_section(near, detection_m / options.unit_m);
  evaluation["detection"]["distance_m"] = detection_m;
  if (PairedSequence answered = frames_with_results(near);
      answered.frames.size() < near.frames.size()) {
    // The benchmark's evaluator looks only at frames that the result has, which forgives missing
    // ones.
    const std::size_t frame_count = answered.frames.size();
    json& part = evaluation["detection"]["frames_with_results"];
    part = ground_detection_section(answered, detection_m / options.unit_m);
    part["distance_m"] = detection_m;
    part["frames"] = frame_count;
  }
  if (tracked) {
    const PairedSequence distance =
        pair_ground_rows(truth, result, /*has_identities=*/true, tracking_m / options.unit_m);
    counts["gt_ids"] = distance.truth_identities;
    counts["tracker_ids"] = distance.result_identities;
    evaluation["ground"] = ground_tracking_figures(in_metres(distance, options.unit_m), tracking_m);
  } else {
    evaluation["ground"] = ground_detection_figures(near, detection_m / options.unit_m);
    evaluation["ground"]["distance_m"] = detection_m;
  }
  return evaluation;
}

/// What a section's figures are, in one line.
std::string convention(const std::string& section, const json& figures) {
  std::ostringstream text;
  if (figures.contains("overlap")) {
    text << "overlap >= " << figures["overlap"].get<double>();
  } else if (section == "detection" || !figures.contains("MOTA")) {
    text << "distance < " << figures["distance_m"].get<double>() << " m";
  } else {
    text << "distance <= " << figures["distance_m"].get<double>() << " m";
  }
  if (section == "tracking") {
    text << "; CLEAR MOT, identity and HOTA (over its 19 thresholds) as TrackEval counts";
  } else if (section == "thesis") {
    text << "; equations (3.1)-(3.7)";
  } else if (section == "ground" && figures.contains("MOTA")) {
    text << "; CLEAR MOT and identity as py-motmetrics counts, HOTA on 1 - d / (2 threshold)";
  } else if (figures.contains("distance_m")) {
    text << ", one assignment per frame, as WILDTRACK's evaluator counts";
  } else {
    text << "; one assignment per frame, MODP the mean overlap of the matches";
  }
  return text.str();
}

void print_section(std::ostream& out, const std::string& name, const json& figures) {
  static const std::vector<std::string> kOrder = {
      "MODA", "MODP", "precision", "recall", "F1",   "MOTA", "MOTP", "mean_error_m",
      "TP",   "FN",   "FP",        "IDS",    "GT",   "MT",   "PT",   "ML",
      "FM",   "IDF1", "IDP",       "IDR",    "HOTA", "DetA", "AssA", "LocA"};
  out << name << ": " << convention(name, figures) << '\n';
  std::ostringstream names;
  std::ostringstream values;
  for (const std::string& key : kOrder) {
    const auto found = figures.find(key);
    if (found == figures.end()) continue;
    std::ostringstream value;
    if (found->is_number_float()) {
      value << std::fixed << std::setprecision(4) << found->get<double>();
    } else {
      value << *found;
    }
    const auto width = static_cast<int>(std::max(key.size(), value.str().size())) + 2;
    names << std::setw(width) << key;
    values << std::setw(width) << value.str();
  }
  out << names.str() << '\n' << values.str() << "\n\n";
}

void print_table(std::ostream& out, const json& report) {
  const json& counts = report["counts"];
  out << report["result"].get<std::string>() << " against " << report["gt"].get<std::string>()
      << " by " << report["rules"].get<std::string>() << ": " << counts["frames"] << " frames, "
      << counts["gt_dets"] << " true people, " << counts["tracker_dets"] << " in the result\n";
  if (counts.value("tracker_dets_in_other_frames", 0) > 0) {
    out << counts["tracker_dets_in_other_frames"]
        << " result rows are in frames without ground truth and count for nothing\n";
  }
  out << '\n';
  const json& evaluation = report["evaluation"];
  for (const char* name : {"detection", "tracking", "ground", "thesis"}) {
    if (evaluation.contains(name)) print_section(out, name, evaluation[name]);
  }
  if (evaluation["detection"].contains("frames_with_results")) {
    const json& part = evaluation["detection"]["frames_with_results"];
    out << "Only " << part["frames"] << " of these frames have results. In them, ";
    print_section(out, "detection", part);
  }
}

void check(const EvalOptions& options) {
  const bool ground = options.rules == "ground";
  if (ground && options.iou) {
    throw UserError("--iou is for boxes; with --rules ground give --distance-m");
  }
  if (!ground && options.distance_m) {
    throw UserError("--distance-m is for --rules ground; with " + options.rules + " give --iou");
  }
  if (!ground && options.unit_m != 1.0) throw UserError("--unit-m is for --rules ground");
  if (options.iou && !(*options.iou > 0 && *options.iou <= 1)) {
    throw UserError("--iou must be above 0 and at most 1");
  }
  if (options.distance_m && !(*options.distance_m > 0 && std::isfinite(*options.distance_m))) {
    throw UserError("--distance-m must be above 0");
  }
  if (!(options.unit_m > 0 && std::isfinite(options.unit_m)))
    throw UserError("--unit-m must be above 0");
  if (options.last_frame && *options.last_frame < 1)
    throw UserError("--last-frame must be at least 1");
}

void run(const EvalOptions& options) {
  check(options);
  json counts;
  json evaluation;
  if (const auto rules = mot_rules_from(options.rules)) {
    evaluation = evaluate_boxes(options, *rules, counts);
  } else {
    evaluation = evaluate_ground(options, counts);
  }
  const json report = {{"plaza", 1},
                       {"gt", options.gt},
                       {"result", options.result},
                       {"rules", options.rules},
                       {"counts", counts},
                       {"evaluation", evaluation}};
  if (options.as_json) {
    std::cout << report.dump(2) << '\n';
  } else {
    print_table(std::cout, report);
  }
}

}  // namespace

void add_eval_command(CLI::App& app, CliContext& /*context*/) {
  const auto options = std::make_shared<EvalOptions>();
  CLI::App* command = app.add_subcommand("eval", "Score a result file against ground truth");
  command->add_option("--gt", options->gt, "Ground truth file")->required()->type_name("FILE");
  command->add_option("--result", options->result, "Result file")->required()->type_name("FILE");
  command
      ->add_option(
          "--rules", options->rules,
          "MOT15 (boxes, no classes), MOT16, MOT17, MOT20 (boxes, classes in the ground truth) or "
          "ground (rows frame,id,x,y or frame,x,y; frames may start at 0; frames that the ground "
          "truth has are evaluated)")
      ->check(CLI::IsMember({"MOT15", "MOT16", "MOT17", "MOT20", "ground"}))
      ->type_name("RULES")
      ->capture_default_str();
  command
      ->add_option(
          "--last-frame", options->last_frame,
          "Length of the sequence; rows after it are errors. Default: the files' last frame")
      ->type_name("N");
  command
      ->add_option("--iou", options->iou,
                   "Least overlap of a match. Default: 0.5, and 0.3 for the thesis's figures")
      ->type_name("T");
  command
      ->add_option(
          "--distance-m", options->distance_m,
          "Largest distance of a match on the ground. Default: 1 for tracks, 0.5 for detections")
      ->type_name("D");
  command
      ->add_option("--unit-m", options->unit_m,
                   "Length of the ground files' unit in metres, 0.025 for WILDTRACK's grid cells")
      ->type_name("U")
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "Print JSON with the keys of summary.json");
  command->callback([options] { run(*options); });
}

}  // namespace plaza
