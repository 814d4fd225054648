#include "plaza/io/mot_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "plaza/core/error.h"
#include "row_text.h"

namespace plaza {
namespace {

using row_text::Faults;
using row_text::Field;
using row_text::Lines;

constexpr std::size_t kMotColumns = 10;
/// Pixels and metres beyond this are mistakes; within, areas and squared distances stay finite.
constexpr double kFarthest = 1e9;

void check_frame(std::int64_t frame, const Field& field, int line, const RowLimits& limits,
                 Faults& faults) {
  if (frame < limits.first_frame) {
    faults.add(line, field.column,
               "frame " + std::to_string(frame) + " comes before the first frame, " +
                   std::to_string(limits.first_frame));
  } else if (limits.last_frame && frame > *limits.last_frame) {
    faults.add(line, field.column,
               "frame " + std::to_string(frame) + " comes after the last frame, " +
                   std::to_string(*limits.last_frame));
  }
}

/// An identity is in one place at a time.
template <class Row>
void check_identities(const std::vector<Row>& rows, bool unidentified, Faults& faults) {
  unidentified = unidentified || std::all_of(rows.begin(), rows.end(),
                                             [](const Row& row) { return row.id == kNoIdentity; });
  std::vector<std::tuple<std::int64_t, std::int64_t, int>> seen;  // frame, id, line
  seen.reserve(rows.size());
  for (const Row& row : rows) {
    if (!(unidentified && row.id == kNoIdentity)) seen.emplace_back(row.frame, row.id, row.line);
  }
  std::sort(seen.begin(), seen.end());
  std::vector<std::pair<int, std::string>> repeated;
  for (std::size_t i = 1; i < seen.size(); ++i) {
    const auto& [frame, id, line] = seen[i];
    const auto& [frame_before, id_before, line_before] = seen[i - 1];
    if (frame != frame_before || id != id_before) continue;
    repeated.emplace_back(line, "id " + std::to_string(id) + " a second time in frame " +
                                    std::to_string(frame) + " (first in line " +
                                    std::to_string(line_before) +
                                    "); an identity occurs once in a frame");
  }
  std::sort(repeated.begin(), repeated.end());
  for (auto& [line, message] : repeated) faults.add(line, 1, std::move(message));
}

/// Takes the tolerated separator at the end of a line away, and holds every row to the first one's
/// width.
class Width {
 public:
  explicit Width(std::size_t least) : least_(least) {}

  /// The row's fields, or nothing (with a fault) when there are too few or another number of them.
  std::span<const Field> check(const Lines& lines, const char* expected, Faults& faults) {
    std::span<const Field> fields = lines.fields();
    if (fields.size() > least_ && fields.back().text.empty() && fields.size() != width_) {
      fields = fields.first(fields.size() - 1);
    }
    const int end = fields.back().column + static_cast<int>(fields.back().text.size());
    if (fields.size() < least_) {
      faults.add(lines.number(), end,
                 std::to_string(fields.size()) + " columns are too few; a row is " + expected);
      return {};
    }
    if (width_ == 0) {
      width_ = fields.size();
      first_line_ = lines.number();
    }
    if (fields.size() != width_) {
      faults.add(lines.number(), end,
                 std::to_string(fields.size()) + " columns, but line " +
                     std::to_string(first_line_) + " has " + std::to_string(width_) +
                     "; is the row cut off?");
      return {};
    }
    return fields;
  }

 private:
  std::size_t least_;
  std::size_t width_ = 0;
  int first_line_ = 0;
};

std::optional<MotRow> parse_mot_row(std::span<const Field> fields, int line,
                                    const RowLimits& limits, Faults& faults) {
  static constexpr std::array<const char*, kMotColumns> kWithClass = {
      "frame",  "id",         "left",  "top",        "width",
      "height", "confidence", "class", "visibility", "column 10"};
  static constexpr std::array<const char*, kMotColumns> kWithPosition = {
      "frame", "id", "left", "top", "width", "height", "confidence", "x", "y", "z"};
  const auto& names = fields.size() == kMotColumns ? kWithPosition : kWithClass;

  const auto frame = row_text::whole_number(fields[0], names[0], line, faults);
  const auto id = row_text::whole_number(fields[1], names[1], line, faults);
  std::array<double, kMotColumns> values{};
  bool complete = frame.has_value() && id.has_value();
  for (std::size_t i = 2; i < fields.size(); ++i) {
    const auto value = row_text::number(fields[i], names[i], line, faults);
    if (value) {
      values[i] = *value;
    } else {
      complete = false;
    }
  }
  if (frame) check_frame(*frame, fields[0], line, limits, faults);
  if (!complete) return std::nullopt;
  for (std::size_t i = 2; i < 6; ++i) {
    if (std::abs(values[i]) <= kFarthest) continue;
    faults.add(line, fields[i].column,
               std::string(names[i]) + " " + row_text::quoted(fields[i].text) +
                   " is beyond any image; at most 1e9 pixels");
    return std::nullopt;
  }
  for (const std::size_t i : {std::size_t{4}, std::size_t{5}}) {
    if (values[i] < 0) {
      faults.add(line, fields[i].column,
                 std::string(names[i]) + " " + row_text::quoted(fields[i].text) +
                     " is negative; a box is left, top, width, height");
    }
  }

  MotRow row;
  row.frame = *frame;
  row.id = *id;
  row.box = {.left = values[2], .top = values[3], .width = values[4], .height = values[5]};
  row.line = line;
  if (fields.size() > 6) row.confidence = values[6];
  if (fields.size() == kMotColumns) {
    const Eigen::Vector3d position_m(values[7], values[8], values[9]);
    if ((position_m.array() != -1.0).any()) row.position_m = position_m;
  } else if (fields.size() > 7) {
    if (values[7] != std::trunc(values[7]) || std::abs(values[7]) > 1e6) {
      faults.add(
          line, fields[7].column,
          "class " + row_text::quoted(fields[7].text) + " is not one of MOTChallenge's numbers");
      return std::nullopt;
    }
    if (values[7] != -1) row.class_id = static_cast<int>(values[7]);
    if (fields.size() > 8 && values[8] != -1) row.visibility = values[8];
  }
  return row;
}

/// Where a ground-plane file keeps what; -1: nowhere.
struct GroundColumns {
  int frame = 0, id = -1, x = -1, y = -1, heading = -1, score = -1;
  bool named = false;
  bool named_metres = true;
  double unit_m = 1;
};

bool is_header(std::span<const Field> fields) {
  return std::any_of(fields.begin(), fields.end(),
                     [](const Field& f) { return f.text == "frame"; });
}

std::optional<GroundColumns> columns_of_header(std::span<const Field> fields, int line,
                                               double unit_m, Faults& faults) {
  GroundColumns columns;
  columns.frame = -1;
  columns.named = true;
  columns.unit_m = 1;
  std::map<std::string_view, int*> known = {
      {"frame", &columns.frame}, {"id", &columns.id},
      {"x_m", &columns.x},       {"y_m", &columns.y},
      {"x", &columns.x},         {"y", &columns.y},
      {"score", &columns.score}, {"heading_deg", &columns.heading}};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto entry = known.find(fields[i].text);
    if (entry == known.end()) continue;
    if (*entry->second >= 0) {
      faults.add(line, fields[i].column, "column " + row_text::quoted(fields[i].text) + " twice");
      return std::nullopt;
    }
    *entry->second = static_cast<int>(i);
    if (entry->first == "x") {
      columns.unit_m = unit_m;
      columns.named_metres = false;
    }
  }
  if (columns.frame < 0 || columns.x < 0 || columns.y < 0) {
    faults.add(line, 1, "the names of the columns must include frame, x_m and y_m");
    return std::nullopt;
  }
  return columns;
}

GroundColumns columns_of_row(std::size_t width, double unit_m) {
  GroundColumns columns;
  columns.unit_m = unit_m;
  if (width == 3) {
    columns.x = 1;
    columns.y = 2;
  } else if (width == kMotColumns) {
    columns.id = 1;
    columns.x = 7;
    columns.y = 8;
  } else {
    columns.id = 1;
    columns.x = 2;
    columns.y = 3;
  }
  return columns;
}

std::optional<GroundRow> parse_ground_row(std::span<const Field> fields,
                                          const GroundColumns& columns, int line,
                                          const RowLimits& limits, Faults& faults) {
  const auto field = [&](int column) -> const Field& {
    return fields[static_cast<std::size_t>(column)];
  };
  const auto optional_number = [&](int column, const char* what) -> std::optional<double> {
    if (column < 0 || field(column).text.empty()) return std::nullopt;
    return row_text::number(field(column), what, line, faults);
  };
  GroundRow row;
  row.line = line;
  const auto frame = row_text::whole_number(field(columns.frame), "frame", line, faults);
  bool complete = frame.has_value();
  if (frame) check_frame(*frame, field(columns.frame), line, limits, faults);
  if (columns.id >= 0 && !(columns.named && field(columns.id).text.empty())) {
    const auto id = row_text::whole_number(field(columns.id), "id", line, faults);
    if (id) row.id = *id;
    complete = complete && id.has_value();
  }
  const auto x = row_text::number(field(columns.x), "x", line, faults);
  const auto y = row_text::number(field(columns.y), "y", line, faults);
  row.heading_deg = optional_number(columns.heading, "heading_deg");
  row.score = optional_number(columns.score, "score");
  if (!columns.named) {
    for (int i = 0; i < static_cast<int>(fields.size()); ++i) {
      if (i == columns.frame || i == columns.id || i == columns.x || i == columns.y) continue;
      complete = row_text::number(field(i), "column", line, faults).has_value() && complete;
    }
  }
  if (!complete || !x || !y) return std::nullopt;
  row.frame = *frame;
  row.named_metres = columns.named && columns.named_metres;
  row.position_m = columns.unit_m * Eigen::Vector2d(*x, *y);
  if (!(row.position_m.cwiseAbs().maxCoeff() <= kFarthest)) {
    faults.add(line, field(columns.x).column, "position is beyond any place; at most 1e9 m");
    return std::nullopt;
  }
  if (fields.size() == kMotColumns && !columns.named && *x == -1 && *y == -1 &&
      row_text::number(field(9), "z", line, faults) == -1.0) {
    faults.add(line, field(columns.x).column, "the row has no ground position (x, y, z are -1)");
    return std::nullopt;
  }
  return row;
}

template <class Row>
std::vector<Row> finish(std::vector<Row> rows, const RowLimits& limits, Faults& faults) {
  check_identities(rows, limits.unidentified, faults);
  if (rows.empty() && !faults.any()) {
    faults.add(
        1, 0,
        "the file has no rows; a result without anyone in it can't be told from a failed run");
  }
  faults.throw_if_any();
  return rows;
}

}  // namespace

std::vector<MotRow> parse_mot_rows(std::string_view text, const std::string& name,
                                   const RowLimits& limits) {
  constexpr const char* kExpected = "frame,id,left,top,width,height[,confidence[,...]]";
  Faults faults(name);
  Lines lines(text, faults);
  Width width(6);
  std::vector<MotRow> rows;
  while (lines.next()) {
    std::span<const Field> fields = width.check(lines, kExpected, faults);
    if (fields.empty()) continue;
    if (fields.size() > kMotColumns) {
      faults.add(lines.number(), fields[kMotColumns].column,
                 std::to_string(fields.size()) + " columns are too many; a row is " + kExpected +
                     " with at most 10");
      continue;
    }
    if (auto row = parse_mot_row(fields, lines.number(), limits, faults))
      rows.push_back(std::move(*row));
  }
  return finish(std::move(rows), limits, faults);
}

std::vector<GroundRow> parse_ground_rows(std::string_view text, const std::string& name,
                                         const RowLimits& limits, double unit_m) {
  Faults faults(name);
  Lines lines(text, faults);
  Width width(3);
  std::optional<GroundColumns> columns;
  std::vector<GroundRow> rows;
  while (lines.next()) {
    const std::span<const Field> fields =
        width.check(lines, "frame,id,x,y[,...] or frame,x,y", faults);
    if (fields.empty()) continue;
    if (!columns && is_header(fields)) {
      columns = columns_of_header(fields, lines.number(), unit_m, faults);
      if (!columns) break;
      continue;
    }
    if (!columns) columns = columns_of_row(fields.size(), unit_m);
    if (auto row = parse_ground_row(fields, *columns, lines.number(), limits, faults)) {
      rows.push_back(std::move(*row));
    }
  }
  return finish(std::move(rows), limits, faults);
}

std::vector<MotRow> read_mot_rows(const std::filesystem::path& file, const RowLimits& limits) {
  return parse_mot_rows(row_text::read_text(file.string()), file.string(), limits);
}

std::vector<GroundRow> read_ground_rows(const std::filesystem::path& file, const RowLimits& limits,
                                        double unit_m) {
  return parse_ground_rows(row_text::read_text(file.string()), file.string(), limits, unit_m);
}

}  // namespace plaza
