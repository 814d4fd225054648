#include "plugins/sinks/error-pictures/error_table.h"

#include <cmath>
#include <cstdio>

namespace plaza::error_pictures {
namespace {

/// Fields of a line; what is unknown is empty.
class Row {
 public:
  Row& text(std::string_view value) {
    if (!line_.empty()) line_ += ',';
    line_ += value;
    return *this;
  }
  Row& number(double value, int digits = 3) {
    if (!std::isfinite(value)) return skip(1);
    char digits_text[64];
    std::snprintf(digits_text, sizeof digits_text, "%.*f", digits, value);
    return text(digits_text);
  }
  Row& integer(std::int64_t value) { return text(std::to_string(value)); }
  Row& skip(int fields) {
    for (int i = 0; i < fields; ++i) line_ += ',';
    return *this;
  }
  Row& place(const BestView* view, const Scene& scene) {
    if (view == nullptr) return skip(5);
    const Box& b = view->box;
    return text(scene.cameras[view->camera].name())
        .number(b.left, 1)
        .number(b.top, 1)
        .number(b.width, 1)
        .number(b.height, 1);
  }
  std::string take() { return std::move(line_) + "\n"; }

 private:
  std::string line_;
};

}  // namespace

std::string table_header() {
  return "frame,error,kind,person,x_m,y_m,view,left,top,width,height,score,probability,"
         "behind_occluder,behind_people,cut,hidden,nearest_m,border_m\n";
}

std::string table_row(std::int64_t frame, const Miss& miss, const TruePerson& person,
                      const BestView* view, const Scene& scene) {
  Row row;
  row.integer(frame + 1).text("miss").text(to_string(miss.kind)).integer(person.id);
  const PersonSight& sight = miss.sight;
  if (sight.position_m) {
    row.number(sight.position_m->x()).number(sight.position_m->y());
  } else {
    row.skip(2);
  }
  row.place(view, scene).skip(2);
  row.number(sight.behind_occluder).number(sight.behind_people).number(sight.cut);
  return row.number(sight.hidden).number(sight.nearest_m).number(sight.border_m).take();
}

std::string table_row(std::int64_t frame, const FalseAlarm& alarm, const Observation& observation,
                      const TruePerson* person, const BestView* view, const Scene& scene) {
  Row row;
  row.integer(frame + 1).text("false alarm").text(to_string(alarm.kind));
  if (person != nullptr) {
    row.integer(person->id);
  } else {
    row.skip(1);
  }
  row.number(observation.position_m.x()).number(observation.position_m.y()).place(view, scene);
  return row.number(observation.score).number(observation.probability).skip(6).take();
}

}  // namespace plaza::error_pictures
