#include "plaza/scoring/mot_challenge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "plaza/core/error.h"
#include "plaza/math/assignment.h"
#include "rounding.h"

namespace plaza {
namespace {

constexpr double kForgivingOverlap = 0.5;  // part of the rules, whatever the scores' threshold

constexpr int kPedestrian = 1;
constexpr int kPersonOnVehicle = 2;
constexpr int kVehicle = 6;
constexpr int kStaticPerson = 7;
constexpr int kDistractor = 8;
constexpr int kReflection = 12;
constexpr int kLastClass = 13;

bool has_classes(MotRules rules) { return rules != MotRules::kMot15; }

bool is_forgiven(int class_id, MotRules rules) {
  return class_id == kPersonOnVehicle || class_id == kStaticPerson || class_id == kDistractor ||
         class_id == kReflection || (class_id == kVehicle && rules == MotRules::kMot20);
}

bool counts(const MotRow& row, MotRules rules) {
  if (std::abs(row.confidence) < 1) return false;  // int(confidence) == 0
  return !has_classes(rules) || row.class_id == kPedestrian;
}

void check_classes(const MotFile& truth, const MotFile& result, MotRules rules) {
  if (!has_classes(rules)) return;
  constexpr std::size_t kShown = 20;
  Diagnostics faults;
  const auto add = [&faults](const std::string& file, int line, std::string message) {
    if (faults.size() < kShown)
      faults.push_back({.where = {file, line, 0}, .pointer = {}, .message = std::move(message)});
  };
  for (const MotRow& row : truth.rows) {
    if (!row.class_id) {
      add(truth.name, row.line,
          "the row has no class, which these rules need as column 8 of 8 or 9; without classes "
          "evaluate by "
          "MOT15");
    } else if (*row.class_id < kPedestrian || *row.class_id > kLastClass) {
      add(truth.name, row.line,
          "class " + std::to_string(*row.class_id) + " is none of MOTChallenge's, 1 to 13");
    }
  }
  for (const MotRow& row : result.rows) {
    if (row.class_id && *row.class_id > kPedestrian) {
      add(result.name, row.line,
          "class " + std::to_string(*row.class_id) +
              " in a result; only pedestrians (1) are evaluated");
    }
  }
  if (!faults.empty()) throw UserError(std::move(faults));
}

/// Rows by frame, in the file's order within each.
template <class Row>
std::map<std::int64_t, std::vector<const Row*>> by_frame(std::span<const Row> rows) {
  std::map<std::int64_t, std::vector<const Row*>> frames;
  for (const Row& row : rows) frames[row.frame].push_back(&row);
  return frames;
}

template <class Row, class Member>
auto gather(const std::vector<const Row*>& rows, Member Row::*member) {
  std::vector<Member> out;
  out.reserve(rows.size());
  for (const Row* row : rows) out.push_back(row->*member);
  return out;
}

/// Columns of the result boxes that sit on something the rules forgive.
std::vector<bool> forgiven(const Eigen::MatrixXd& overlaps, const std::vector<const MotRow*>& truth,
                           MotRules rules) {
  std::vector<bool> out(static_cast<std::size_t>(overlaps.cols()), false);
  const Eigen::MatrixXd score = overlaps.unaryExpr(
      [](double overlap) { return overlap < kForgivingOverlap - kEpsilon ? 0.0 : overlap; });
  const std::vector<int> assigned = assign_maximum_weight(score);
  for (std::size_t i = 0; i < assigned.size(); ++i) {
    if (assigned[i] < 0 || !(score(static_cast<Eigen::Index>(i), assigned[i]) > kEpsilon)) continue;
    if (is_forgiven(*truth[i]->class_id, rules)) out[static_cast<std::size_t>(assigned[i])] = true;
  }
  return out;
}

}  // namespace

std::optional<MotRules> mot_rules_from(std::string_view name) {
  if (name == "MOT15") return MotRules::kMot15;
  if (name == "MOT16") return MotRules::kMot16;
  if (name == "MOT17") return MotRules::kMot17;
  if (name == "MOT20") return MotRules::kMot20;
  return std::nullopt;
}

Eigen::MatrixXd box_overlaps(std::span<const Box> truth, std::span<const Box> result) {
  Eigen::MatrixXd overlaps(static_cast<Eigen::Index>(truth.size()),
                           static_cast<Eigen::Index>(result.size()));
  for (std::size_t j = 0; j < result.size(); ++j) {
    const Box& b = result[j];
    const double area_b = (b.right() - b.left) * (b.bottom() - b.top);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Box& a = truth[i];
      const double area_a = (a.right() - a.left) * (a.bottom() - a.top);
      const double width = std::max(std::min(a.right(), b.right()) - std::max(a.left, b.left), 0.0);
      const double height =
          std::max(std::min(a.bottom(), b.bottom()) - std::max(a.top, b.top), 0.0);
      const double common = width * height;
      const double united = area_a + area_b - common;
      const bool empty = area_a <= kEpsilon || area_b <= kEpsilon || united <= kEpsilon;
      overlaps(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          empty ? 0.0 : common / united;
    }
  }
  return overlaps;
}

PairedSequence pair_mot_rows(const MotFile& truth, const MotFile& result, MotRules rules,
                             bool has_identities) {
  check_classes(truth, result, rules);
  const auto truth_frames = by_frame<MotRow>(truth.rows);
  const auto result_frames = by_frame<MotRow>(result.rows);
  std::map<std::int64_t, std::pair<std::vector<const MotRow*>, std::vector<const MotRow*>>> frames;
  for (const auto& [frame, rows] : truth_frames) frames[frame].first = rows;
  for (const auto& [frame, rows] : result_frames) frames[frame].second = rows;

  PairedSequenceBuilder builder;
  for (const auto& [frame, rows] : frames) {
    const auto& [truth_rows, result_rows] = rows;
    const std::vector<Box> truth_boxes = gather(truth_rows, &MotRow::box);
    const std::vector<Box> result_boxes = gather(result_rows, &MotRow::box);
    const Eigen::MatrixXd overlaps = box_overlaps(truth_boxes, result_boxes);
    std::vector<bool> removed(result_rows.size(), false);
    if (has_classes(rules)) removed = forgiven(overlaps, truth_rows, rules);

    std::vector<std::int64_t> truth_ids, result_ids;
    std::vector<Eigen::Index> kept_rows, kept_columns;
    for (std::size_t i = 0; i < truth_rows.size(); ++i) {
      if (!counts(*truth_rows[i], rules)) continue;
      kept_rows.push_back(static_cast<Eigen::Index>(i));
      truth_ids.push_back(truth_rows[i]->id);
    }
    for (std::size_t j = 0; j < result_rows.size(); ++j) {
      if (removed[j]) continue;
      kept_columns.push_back(static_cast<Eigen::Index>(j));
      result_ids.push_back(has_identities ? result_rows[j]->id : static_cast<std::int64_t>(j));
    }
    builder.add(frame, truth_ids, result_ids, overlaps(kept_rows, kept_columns));
  }
  return builder.build();
}

Eigen::MatrixXd point_distances(std::span<const Eigen::Vector2d> truth,
                                std::span<const Eigen::Vector2d> result, double reach) {
  Eigen::MatrixXd distances(static_cast<Eigen::Index>(truth.size()),
                            static_cast<Eigen::Index>(result.size()));
  for (std::size_t j = 0; j < result.size(); ++j) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double squared = (truth[i] - result[j]).squaredNorm();
      distances(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          squared > reach * reach ? std::numeric_limits<double>::infinity() : std::sqrt(squared);
    }
  }
  return distances;
}

PairedSequence pair_ground_rows(std::span<const GroundRow> truth, std::span<const GroundRow> result,
                                bool has_identities, double reach_m) {
  const auto truth_frames = by_frame(truth);
  const auto result_frames = by_frame(result);
  PairedSequenceBuilder builder;
  for (const auto& [frame, truth_rows] : truth_frames) {
    const auto found = result_frames.find(frame);
    const std::vector<const GroundRow*> result_rows =
        found == result_frames.end() ? std::vector<const GroundRow*>() : found->second;
    std::vector<std::int64_t> truth_ids = gather(truth_rows, &GroundRow::id);
    std::vector<std::int64_t> result_ids = gather(result_rows, &GroundRow::id);
    if (!has_identities) {
      std::iota(truth_ids.begin(), truth_ids.end(), std::int64_t{0});
      std::iota(result_ids.begin(), result_ids.end(), std::int64_t{0});
    }
    builder.add(frame, truth_ids, result_ids,
                point_distances(gather(truth_rows, &GroundRow::position_m),
                                gather(result_rows, &GroundRow::position_m), reach_m));
  }
  return builder.build();
}

}  // namespace plaza
