#include "plugins/sources/detections/truth_table.h"

#include <algorithm>
#include <utility>

#include "plaza/geometry/angle.h"

namespace plaza::sources {
namespace {

constexpr int kPedestrian = 1;  // MOTChallenge's class

bool counts(const MotRow& row) {
  if (row.confidence == 0) return false;
  return !row.class_id || *row.class_id <= 0 || *row.class_id == kPedestrian;
}

Diagnostic row_fault(const std::string& file, int line, std::string message) {
  Diagnostic fault = fault_at({}, std::move(message));
  fault.where.file = file;
  fault.where.line = line;
  return fault;
}

Diagnostic no_identity(const std::string& file, int line) {
  return row_fault(
      file, line,
      "id -1 names nobody; ground truth needs an identity in every row, the same one in "
      "all views");
}

double mix(double a, double b, double t) { return a + t * (b - a); }

Box mix(const Box& a, const Box& b, double t) {
  return {.left = mix(a.left, b.left, t),
          .top = mix(a.top, b.top, t),
          .width = mix(a.width, b.width, t),
          .height = mix(a.height, b.height, t)};
}

// A person between two annotated frames, in the views and with the values that both have.
TruePerson mix(const TruePerson& a, const TruePerson& b, double t) {
  TruePerson person;
  person.id = a.id;
  if (a.position_m && b.position_m) {
    person.position_m = *a.position_m + t * (*b.position_m - *a.position_m);
  }
  if (a.heading_rad && b.heading_rad) {
    person.heading_rad =
        wrap_angle(*a.heading_rad + t * angle_difference(*b.heading_rad, *a.heading_rad));
  }
  for (const TrueView& view : a.views) {
    const auto other = std::ranges::find(b.views, view.camera, &TrueView::camera);
    if (other == b.views.end()) continue;
    person.views.push_back({.camera = view.camera,
                            .box = mix(view.box, other->box, t),
                            .visibility = mix(view.visibility, other->visibility, t)});
  }
  return person;
}

}  // namespace

void TruthTable::add_boxes(std::size_t camera, const std::vector<MotRow>& rows,
                           const std::string& file, Diagnostics& faults) {
  for (const MotRow& row : rows) {
    const std::int64_t frame = row.frame - 1;
    first_lines_[file].emplace(frame, row.line);
    if (!counts(row)) continue;
    if (row.id == kNoIdentity) {
      faults.push_back(no_identity(file, row.line));
      continue;
    }
    Draft& draft = by_frame_[frame][row.id];
    draft.person.id = row.id;
    draft.person.views.push_back(
        {.camera = camera, .box = row.box, .visibility = row.visibility.value_or(1.0)});
    if (row.position_m) {
      draft.position_sum_m += row.position_m->head<2>();
      ++draft.positions;
      draft.person.position_m = draft.position_sum_m / draft.positions;
    }
  }
}

void TruthTable::add_ground(const std::vector<GroundRow>& rows, const std::string& file,
                            Diagnostics& faults) {
  for (const GroundRow& row : rows) {
    const std::int64_t frame = row.frame - 1;
    first_lines_[file].emplace(frame, row.line);
    if (row.id == kNoIdentity) {
      faults.push_back(no_identity(file, row.line));
      continue;
    }
    TruePerson& person = by_frame_[frame][row.id].person;
    person.id = row.id;
    person.position_m = row.position_m;
    if (row.heading_deg) person.heading_rad = wrap_angle(radians_from_degrees(*row.heading_deg));
  }
}

void TruthTable::finish(Diagnostics& faults) {
  std::optional<std::int64_t> first;
  std::int64_t last = -1;
  for (const auto& [file, lines] : first_lines_) {
    if (lines.empty()) continue;
    first = std::min(first.value_or(lines.begin()->first), lines.begin()->first);
    last = std::max(last, lines.rbegin()->first);
  }
  phase_ = first.value_or(0) % annotation_.every;
  frames_ = annotation_.frames.value_or(last + 1);
  for (const auto& [file, lines] : first_lines_) {
    std::int64_t others = 0;
    std::optional<std::pair<std::int64_t, int>> example;
    for (const auto& [frame, line] : lines) {
      if (frame % annotation_.every == phase_) continue;
      if (!example) example = {frame, line};
      ++others;
    }
    if (!example) continue;
    faults.push_back(row_fault(
        file, example->second,
        "frame " + std::to_string(example->first + 1) + " and " + std::to_string(others - 1) +
            " more are not among every " + std::to_string(annotation_.every) +
            " frames from frame " + std::to_string(phase_ + 1) +
            "; set \"every\" to the true distance between annotated frames"));
  }
}

bool TruthTable::annotated(std::int64_t frame) const {
  if (frame < 0 || frame >= frames_) return false;
  if (frame % annotation_.every == phase_) return true;
  if (!annotation_.interpolate || frame < phase_) return false;
  return frame - (frame - phase_) % annotation_.every + annotation_.every < frames_;
}

const TruthTable::People* TruthTable::people(std::int64_t frame) const {
  const auto found = by_frame_.find(frame);
  return found == by_frame_.end() ? nullptr : &found->second;
}

GroundTruth TruthTable::at(std::int64_t frame) const {
  GroundTruth truth;
  truth.annotated = annotated(frame);
  if (!truth.annotated) return truth;
  const std::int64_t before = frame - (frame - phase_) % annotation_.every;
  if (before != frame) return between(before, frame);
  if (const People* here = people(frame)) {
    for (const auto& [id, draft] : *here) truth.people.push_back(draft.person);
  }
  return truth;
}

GroundTruth TruthTable::between(std::int64_t before, std::int64_t frame) const {
  GroundTruth truth;
  const People* a = people(before);
  const People* b = people(before + annotation_.every);
  if (a == nullptr || b == nullptr) return truth;
  const double t = static_cast<double>(frame - before) / static_cast<double>(annotation_.every);
  for (const auto& [id, draft] : *a) {
    const auto later = b->find(id);
    if (later != b->end()) truth.people.push_back(mix(draft.person, later->second.person, t));
  }
  return truth;
}

}  // namespace plaza::sources
