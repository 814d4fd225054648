#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/core/export.h"
#include "plaza/scoring/paired_sequence.h"

// The sections of an evaluation as summary.json and `plaza eval --json` show them. Keys that the
// evaluation contract names are the contract's; further ones bear the names that the reference
// evaluators give them.

namespace plaza {

/// "detection" in images: MODA, MODP (mean overlap of the matches), precision, recall, F1, TP, FN,
/// FP at `overlap`; undefined ratios are left out. With `sweep`, the same at each of its
/// thresholds.
PLAZA_API nlohmann::json image_detection_section(const PairedSequence& similarity, double overlap,
                                                 const std::vector<double>& sweep = {});

/// "tracking" in images: CLEAR MOT and identity at `overlap`, HOTA at its own thresholds, as
/// TrackEval defines them (also where it defines a ratio of nothing as 0). With `sweep`, CLEAR MOT
/// and identity at each of its thresholds.
PLAZA_API nlohmann::json image_tracking_section(const PairedSequence& similarity, double overlap,
                                                const std::vector<double>& sweep = {});

/// "detection" on the ground by WILDTRACK's rule, which counts pairs strictly nearer than
/// `distance_m`. As there, MODA is never below 0, and ratios of nothing are 0.
PLAZA_API nlohmann::json ground_detection_section(const PairedSequence& distance,
                                                  double distance_m);

/// The figures of `ground_detection_section` as they are, with negative MODA and without ratios of
/// nothing: MODA, MODP, precision, recall, FN, FP.
PLAZA_API nlohmann::json ground_detection_figures(const PairedSequence& distance,
                                                  double distance_m);

/// Figures of tracks on the ground, `distance` in metres with +infinity beyond `distance_m`:
/// py-motmetrics' CLEAR MOT and identity scores, HOTA with similarity 1 - d / (2 distance_m). Below
/// "trackeval_euclid" stands what TrackEval makes of the same similarities.
PLAZA_API nlohmann::json ground_tracking_figures(const PairedSequence& distance, double distance_m);

/// "thesis": MODA (3.1), MODP (3.3) of what was detected; MOTA (3.6), MOTP (3.7, the mean overlap
/// of the matches), MT (at least 80 %) and ML (less than 20 %) of what was tracked. Either may be
/// null; frames without a match have no mean overlap and do not count in MODP.
PLAZA_API nlohmann::json thesis_section(const PairedSequence* detected,
                                        const PairedSequence* tracked, double overlap);

/// The declarations of all figures in these sections, for evaluators.
PLAZA_API std::vector<MetricSpec> image_detection_metrics();
PLAZA_API std::vector<MetricSpec> image_tracking_metrics();
PLAZA_API std::vector<MetricSpec> ground_metrics();
PLAZA_API std::vector<MetricSpec> thesis_detection_metrics();
PLAZA_API std::vector<MetricSpec> thesis_tracking_metrics();

}  // namespace plaza
