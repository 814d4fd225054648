#include "plaza/scoring/detection_errors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "person_sights.h"
#include "plaza/core/error.h"
#include "plaza/math/assignment.h"
#include "plaza/scoring/people.h"

namespace plaza {
namespace {

constexpr double kApart = std::numeric_limits<double>::infinity();

using Polygon = std::vector<Eigen::Vector2d>;

[[noreturn]] void refuse_occluder(const std::string& pointer, const std::string& message) {
  throw UserError(fault_at("/occluders/" + pointer, message));
}

Polygon polygon_from(const std::vector<std::vector<double>>& corners, const std::string& pointer) {
  if (corners.size() < 3) refuse_occluder(pointer, "a polygon needs at least three corners [x, y]");
  Polygon polygon;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i].size() != 2) {
      refuse_occluder(pointer + "/" + std::to_string(i), "a corner is [x, y]: two numbers");
    }
    polygon.emplace_back(corners[i][0], corners[i][1]);
  }
  return polygon;
}

MissKind kind_of(Standing standing, bool paired) {
  if (standing == Standing::kInSight) return paired ? MissKind::kDisplaced : MissKind::kUnexplained;
  return static_cast<MissKind>(standing);  // the same, in the same order
}

/// The observations and the people of one frame, as the rules compare them.
class MatchedFrame {
 public:
  MatchedFrame(const Scene& scene, const ErrorRules& rules, const GroundTruth& truth,
               const Observations& observations)
      : scene_(scene), rules_(rules), truth_(truth), observations_(observations) {
    for (const Observation& o : observations.items) {
      results_.push_back({.id = static_cast<std::int64_t>(results_.size()),
                          .boxes = boxes_in_views(scene, o.position_m, o.boxes)});
    }
    for (const TruePerson& p : truth.people) positions_.push_back(place_of(p, scene));
    match_ = match_people(truth, results_, rules.overlap);
  }

  const PeopleMatch& match() const { return match_; }

  /// On the ground, metres; infinity where the person's place is unknown.
  double distance_m(std::size_t person, std::size_t observation) const {
    if (!positions_[person]) return kApart;
    return (*positions_[person] - observations_.items[observation].position_m).norm();
  }

  /// The same as what it costs to pair both; infinity where they can't be one person.
  double displacement_m(std::size_t person, std::size_t observation) const {
    const double on_ground_m = distance_m(person, observation);
    if (on_ground_m <= rules_.displaced_m) return on_ground_m;
    const double overlap = view_overlap(truth_.people[person], results_[observation]);
    if (overlap < rules_.displaced_overlap) return kApart;
    return std::isfinite(on_ground_m) ? on_ground_m : rules_.displaced_m;
  }

  /// Who was found, and stands nearest to an observation's place within reach.
  std::optional<std::size_t> found_at(std::size_t observation) const {
    std::optional<std::size_t> nearest;
    double least_m = rules_.displaced_m;
    for (std::size_t i = 0; i < truth_.people.size(); ++i) {
      if (match_.result_of[i] < 0 || distance_m(i, observation) > least_m) continue;
      nearest = i;
      least_m = distance_m(i, observation);
    }
    return nearest;
  }

  /// Somebody in line with an observation, in every view whose image shows its box: of the first
  /// one.
  std::optional<std::size_t> in_line_with(std::size_t observation) const {
    std::optional<std::size_t> first;
    for (std::size_t camera = 0; camera < scene_.cameras.size(); ++camera) {
      const auto& box = results_[observation].boxes[camera];
      if (!box || intersection_area(*box, image_box(scene_.cameras[camera])) <= 0) continue;
      const auto person = in_line_with(*box, camera);
      if (!person) return std::nullopt;
      if (!first) first = person;
    }
    return first;
  }

 private:
  std::optional<std::size_t> in_line_with(const Box& box, std::size_t camera) const {
    std::optional<std::size_t> best;
    double most = 0;
    for (std::size_t i = 0; i < truth_.people.size(); ++i) {
      const Box* const other = box_in(truth_.people[i], camera);
      if (other == nullptr) continue;
      const double smaller = std::min(box.area(), other->area());
      if (!(smaller > 0)) continue;
      const double share = intersection_area(box, *other) / smaller;
      if (share < rules_.sight_share || share <= most) continue;
      best = i;
      most = share;
    }
    return best;
  }

  const Scene& scene_;
  const ErrorRules& rules_;
  const GroundTruth& truth_;
  const Observations& observations_;
  std::vector<ResultPerson> results_;
  std::vector<std::optional<Eigen::Vector2d>> positions_;
  PeopleMatch match_;
};

/// One to one, as many as can be, of least sum of distances.
void pair_errors(std::vector<Miss>& misses, std::vector<FalseAlarm>& alarms,
                 const MatchedFrame& frame) {
  Eigen::MatrixXd cost(static_cast<Eigen::Index>(misses.size()),
                       static_cast<Eigen::Index>(alarms.size()));
  for (std::size_t i = 0; i < misses.size(); ++i) {
    for (std::size_t j = 0; j < alarms.size(); ++j) {
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          frame.displacement_m(misses[i].sight.person, alarms[j].observation);
    }
  }
  const std::vector<int> assigned = assign_minimum_cost(cost);
  for (std::size_t i = 0; i < misses.size(); ++i) {
    if (assigned[i] < 0) continue;
    FalseAlarm& alarm = alarms[static_cast<std::size_t>(assigned[i])];
    misses[i].alarm = alarm.observation;
    alarm.kind = AlarmKind::kDisplaced;
    alarm.person = misses[i].sight.person;
  }
}

}  // namespace

std::string_view to_string(Standing standing) {
  static constexpr std::array<std::string_view, kStandings> kNames = {
      "behind_occluder", "behind_people", "at_border", "near_another", "hidden", "in_sight"};
  return kNames.at(static_cast<std::size_t>(standing));
}

std::string_view to_string(MissKind kind) {
  static constexpr std::array<std::string_view, kMissKinds> kNames = {
      "behind_occluder", "behind_people", "at_border",  "near_another",
      "hidden",          "displaced",     "unexplained"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::string_view to_string(AlarmKind kind) {
  static constexpr std::array<std::string_view, kAlarmKinds> kNames = {
      "displaced", "duplicate", "at_border", "ghost", "unexplained"};
  return kNames.at(static_cast<std::size_t>(kind));
}

ErrorSorter::ErrorSorter(std::shared_ptr<const Scene> scene, const ErrorRules& rules)
    : scene_(std::move(scene)), rules_(rules), occluders_(scene_->cameras.size()) {
  for (const auto& [camera, polygons] : rules_.occluders) {
    const auto index = scene_->camera_index(camera);
    if (!index) refuse_occluder(camera, "the scene has no camera of this name");
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      occluders_[*index].push_back(polygon_from(polygons[i], camera + "/" + std::to_string(i)));
    }
  }
  if (!rules_.occluders.empty()) return;
  for (const StaticOccluder& occluder : scene_->occluders) {
    if (const auto index = scene_->camera_index(occluder.camera)) {
      occluders_[*index].push_back(occluder.polygon_px);
    }
  }
}

FrameErrors ErrorSorter::sort(const GroundTruth& truth, const Observations& observations) const {
  FrameErrors errors;
  if (!truth.annotated) return errors;
  const MatchedFrame frame(*scene_, rules_, truth, observations);
  for (const PersonSight& sight : sights_of(truth)) {
    if (!frame.match().counts[sight.person]) continue;
    errors.people.push_back(sight);
    if (frame.match().result_of[sight.person] < 0) {
      Miss miss;
      miss.sight = sight;
      errors.misses.push_back(miss);
    }
  }
  for (std::size_t j = 0; j < observations.items.size(); ++j) {
    if (frame.match().person_of[j] >= 0) continue;
    FalseAlarm alarm;
    alarm.observation = j;
    errors.alarms.push_back(alarm);
  }
  pair_errors(errors.misses, errors.alarms, frame);
  for (Miss& miss : errors.misses) {
    miss.kind = kind_of(miss.sight.standing, miss.alarm.has_value());
  }
  for (FalseAlarm& alarm : errors.alarms) {
    if (alarm.kind == AlarmKind::kDisplaced) continue;
    if (const auto person = frame.found_at(alarm.observation)) {
      alarm.kind = AlarmKind::kDuplicate;
      alarm.person = person;
    } else if (border_distance_m(observations.items[alarm.observation].position_m) <
               rules_.border_m) {
      alarm.kind = AlarmKind::kAtBorder;
    } else if (const auto in_line = frame.in_line_with(alarm.observation)) {
      alarm.kind = AlarmKind::kGhost;
      alarm.person = in_line;
    }
  }
  return errors;
}

}  // namespace plaza
