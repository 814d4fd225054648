#include "plaza/scoring/people.h"

#include <algorithm>
#include <utility>

#include "plaza/math/assignment.h"
#include "plaza/scoring/mot_challenge.h"
#include "rounding.h"

namespace plaza {
namespace {

bool is_visible(const TrueView& view) { return view.visibility >= kCountingVisibility; }

bool counts_somewhere(const TruePerson& person) {
  return std::any_of(person.views.begin(), person.views.end(), is_visible);
}

double overlap_of(const Box& truth, const std::optional<Box>& result) {
  if (!result) return 0;
  return box_overlaps({&truth, 1}, {&*result, 1})(0, 0);
}

}  // namespace

std::vector<std::optional<Box>> boxes_in_views(const Scene& scene,
                                               const Eigen::Vector2d& position_m,
                                               std::span<const ViewBox> measured) {
  std::vector<std::optional<Box>> boxes(scene.cameras.size());
  for (const ViewBox& box : measured) boxes.at(box.camera) = box.box;
  for (std::size_t camera = 0; camera < boxes.size(); ++camera) {
    if (!boxes[camera]) boxes[camera] = body_box(scene.cameras[camera], position_m, scene.body);
  }
  return boxes;
}

double view_overlap(const TruePerson& person, const ResultPerson& result) {
  const bool all_views = !counts_somewhere(person);
  double sum = 0;
  int views = 0;
  for (const TrueView& view : person.views) {
    if (!all_views && !is_visible(view)) continue;
    ++views;
    if (view.camera < result.boxes.size()) sum += overlap_of(view.box, result.boxes[view.camera]);
  }
  return views > 0 ? sum / views : 0;
}

namespace {

bool reaches(double similarity, double overlap) { return similarity >= overlap - kEpsilon; }

/// How well everybody fits everybody in one frame, and who is left to be matched.
struct Comparison {
  std::vector<std::size_t> people;    // of the truth, those who have a box: the matrix's rows
  Eigen::MatrixXd similarity;         // people x results
  std::vector<Eigen::Index> rows;     // of those who count
  std::vector<Eigen::Index> columns;  // of the results that are not forgiven
  std::vector<std::pair<Eigen::Index, Eigen::Index>> forgiven;  // row who doesn't count, column
};

Comparison compare(const GroundTruth& truth, std::span<const ResultPerson> results,
                   double overlap) {
  Comparison out;
  for (std::size_t i = 0; i < truth.people.size(); ++i) {
    if (!truth.people[i].views.empty()) out.people.push_back(i);
  }
  const auto rows = static_cast<Eigen::Index>(out.people.size());
  const auto columns = static_cast<Eigen::Index>(results.size());
  out.similarity.resize(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const TruePerson& person = truth.people[out.people[static_cast<std::size_t>(i)]];
    if (counts_somewhere(person)) out.rows.push_back(i);
    for (Eigen::Index j = 0; j < columns; ++j) {
      out.similarity(i, j) = view_overlap(person, results[static_cast<std::size_t>(j)]);
    }
  }
  std::vector<bool> is_forgiven(results.size(), false);
  if (std::cmp_less(out.rows.size(), rows)) {
    const std::vector<int> assigned = assign_maximum_weight(
        out.similarity.unaryExpr([overlap](double s) { return reaches(s, overlap) ? s : 0.0; }));
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto row = static_cast<std::size_t>(i);
      if (assigned[row] < 0 || counts_somewhere(truth.people[out.people[row]])) continue;
      const double s = out.similarity(i, assigned[row]);
      if (!(s > 0) || !reaches(s, overlap)) continue;
      is_forgiven[static_cast<std::size_t>(assigned[row])] = true;
      out.forgiven.emplace_back(i, assigned[row]);
    }
  }
  for (Eigen::Index j = 0; j < columns; ++j) {
    if (!is_forgiven[static_cast<std::size_t>(j)]) out.columns.push_back(j);
  }
  return out;
}

}  // namespace

void add_people(PairedSequenceBuilder& builder, std::int64_t frame, const GroundTruth& truth,
                std::span<const ResultPerson> results, double overlap) {
  const Comparison all = compare(truth, results, overlap);
  std::vector<std::int64_t> true_ids, result_ids;
  for (const Eigen::Index i : all.rows) {
    true_ids.push_back(truth.people[all.people[static_cast<std::size_t>(i)]].id);
  }
  for (const Eigen::Index j : all.columns) {
    result_ids.push_back(results[static_cast<std::size_t>(j)].id);
  }
  builder.add(frame, true_ids, result_ids, all.similarity(all.rows, all.columns));
}

PeopleMatch match_people(const GroundTruth& truth, std::span<const ResultPerson> results,
                         double overlap) {
  const Comparison all = compare(truth, results, overlap);
  PeopleMatch match;
  match.counts.assign(truth.people.size(), false);
  match.result_of.assign(truth.people.size(), -1);
  match.person_of.assign(results.size(), -1);
  const auto join = [&](Eigen::Index row, Eigen::Index column) {
    const std::size_t person = all.people[static_cast<std::size_t>(row)];
    match.result_of[person] = static_cast<int>(column);
    match.person_of[static_cast<std::size_t>(column)] = static_cast<int>(person);
  };
  for (const auto& [row, column] : all.forgiven) join(row, column);
  for (const Eigen::Index row : all.rows) {
    match.counts[all.people[static_cast<std::size_t>(row)]] = true;
  }
  const Eigen::MatrixXd kept = all.similarity(all.rows, all.columns);
  const std::vector<int> assigned = assign_maximum_weight(
      kept.unaryExpr([overlap](double s) { return reaches(s, overlap) ? s : 0.0; }));
  for (std::size_t i = 0; i < assigned.size(); ++i) {
    if (assigned[i] < 0) continue;
    if (!reaches(kept(static_cast<Eigen::Index>(i), assigned[i]), overlap)) continue;
    join(all.rows[i], all.columns[static_cast<std::size_t>(assigned[i])]);
  }
  return match;
}

}  // namespace plaza
