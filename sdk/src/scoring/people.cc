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

void add_people(PairedSequenceBuilder& builder, std::int64_t frame, const GroundTruth& truth,
                std::span<const ResultPerson> results, double overlap) {
  std::vector<const TruePerson*> people;
  for (const TruePerson& person : truth.people) {
    if (!person.views.empty()) people.push_back(&person);
  }
  const auto rows = static_cast<Eigen::Index>(people.size());
  const auto columns = static_cast<Eigen::Index>(results.size());
  Eigen::MatrixXd similarity(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) {
      similarity(i, j) =
          view_overlap(*people[static_cast<std::size_t>(i)], results[static_cast<std::size_t>(j)]);
    }
  }

  std::vector<bool> forgiven(results.size(), false);
  std::vector<std::int64_t> true_ids, result_ids;
  std::vector<Eigen::Index> kept_rows, kept_columns;
  for (std::size_t i = 0; i < people.size(); ++i) {
    if (!counts_somewhere(*people[i])) continue;
    kept_rows.push_back(static_cast<Eigen::Index>(i));
    true_ids.push_back(people[i]->id);
  }
  if (kept_rows.size() < people.size()) {
    const std::vector<int> assigned = assign_maximum_weight(
        similarity.unaryExpr([overlap](double s) { return s >= overlap - kEpsilon ? s : 0.0; }));
    for (std::size_t i = 0; i < people.size(); ++i) {
      if (assigned[i] < 0 || counts_somewhere(*people[i])) continue;
      const double s = similarity(static_cast<Eigen::Index>(i), assigned[i]);
      if (s > 0 && s >= overlap - kEpsilon) forgiven[static_cast<std::size_t>(assigned[i])] = true;
    }
  }
  for (std::size_t j = 0; j < results.size(); ++j) {
    if (forgiven[j]) continue;
    kept_columns.push_back(static_cast<Eigen::Index>(j));
    result_ids.push_back(results[j].id);
  }
  builder.add(frame, true_ids, result_ids, similarity(kept_rows, kept_columns));
}

}  // namespace plaza
