#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/core/export.h"
#include "plaza/geometry/box.h"
#include "plaza/io/mot_rows.h"
#include "plaza/scoring/paired_sequence.h"

namespace plaza {

/// Which rows of a MOTChallenge file count. MOT15 has no classes; MOT16, 17 and 20 evaluate
/// pedestrians and forgive boxes on what is nearly one (MOT20 forgives vehicles, too).
enum class MotRules { kMot15, kMot16, kMot17, kMot20 };

/// "MOT15", ...; nothing for other names.
PLAZA_API std::optional<MotRules> mot_rules_from(std::string_view name);

/// Rows with the name of their file, for errors.
struct MotFile {
  std::string name;
  std::vector<MotRow> rows;
};

/// Intersection over union of each box of `truth` with each of `result`, in TrackEval's arithmetic:
/// sizes are taken from the corners, and a box without area overlaps nothing. truth x result.
PLAZA_API Eigen::MatrixXd box_overlaps(std::span<const Box> truth, std::span<const Box> result);

/// What is left to compare under the rules: result boxes on distractors are gone, true rows with
/// int(confidence) 0 or of another class too; similarities are overlaps. `has_identities` false:
/// the identities of the result are meaningless (numbered within each frame). Throws UserError with
/// file and line where the rules need a class and the row has none or an unknown one, and where a
/// result row (of 8 or 9 columns) is of another class than pedestrian.
PLAZA_API PairedSequence pair_mot_rows(const MotFile& truth, const MotFile& result, MotRules rules,
                                       bool has_identities = true);

/// Distances of each point of `truth` to each of `result`; +infinity where the square exceeds the
/// square of `reach` (py-motmetrics' test, which is inclusive). truth x result.
PLAZA_API Eigen::MatrixXd point_distances(std::span<const Eigen::Vector2d> truth,
                                          std::span<const Eigen::Vector2d> result,
                                          double reach = std::numeric_limits<double>::infinity());

/// Distances on the ground, metres, in the frames that `truth` has; result rows of other frames
/// count for nothing. `has_identities` as above, for both. Pairs beyond `reach_m` can't be.
PLAZA_API PairedSequence pair_ground_rows(std::span<const GroundRow> truth,
                                          std::span<const GroundRow> result,
                                          bool has_identities = true,
                                          double reach_m = std::numeric_limits<double>::infinity());

}  // namespace plaza
