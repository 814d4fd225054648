#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/core/export.h"
#include "plaza/geometry/box.h"

namespace plaza {

/// Identity of a row that names nobody (a detection). Files write it as -1.
inline constexpr std::int64_t kNoIdentity = -1;

/// One row of a MOTChallenge file: `frame,id,left,top,width,height[,confidence[,...]]`.
///
/// What follows the confidence depends on the number of columns: 8 or 9 are `class[,visibility]`
/// (ground truth since MOT16), 10 are `x,y,z` (MOT15, detections, PETS).
struct MotRow {
  std::int64_t frame = 0;  ///< as in the file
  std::int64_t id = kNoIdentity;
  Box box;                                    ///< pixels; width and height >= 0
  double confidence = 1;                      ///< 1 where the file has no such column
  std::optional<int> class_id;                ///< MOTChallenge's number, 1 is a pedestrian
  std::optional<double> visibility;           ///< [0, 1]
  std::optional<Eigen::Vector3d> position_m;  ///< absent where all three are -1
  int line = 0;                               ///< in the file, from 1
};

/// One row of a ground-plane file: `frame,id,x,y[,...]`, or `frame,x,y` where people have no
/// identities. A first line of names (`frame,id,x_m,y_m,heading_deg,score`, in any order, others
/// ignored) says which column is which; then unknown values of optional columns may be empty
/// fields.
struct GroundRow {
  std::int64_t frame = 0;  ///< as in the file
  std::int64_t id = kNoIdentity;
  Eigen::Vector2d position_m =
      Eigen::Vector2d::Zero();        ///< file's unit times read_ground_rows' unit_m
  bool named_metres = false;          ///< a header said so (x_m, y_m), and the unit was not applied
  std::optional<double> heading_deg;  ///< only with a header
  std::optional<double> score;        ///< only with a header
  int line = 0;                       ///< in the file, from 1
};

/// What a file must keep to.
struct RowLimits {
  std::int64_t first_frame = 1;
  std::optional<std::int64_t> last_frame = std::nullopt;  ///< none: any
  /// Rows with id -1 are people without identity, as many in a frame as there are. Otherwise they
  /// are so only where the whole file has no other id, and -1 is an identity like any other where
  /// it has.
  bool unidentified = false;
};

/// Reads a whole file strictly, in the file's order. Fields are separated by commas, or by blanks
/// or tabs where the first line has no comma. Numbers are decimal and rounded correctly; frame and
/// id may be written as "12.0". Tolerated: a byte order mark, CRLF, empty lines, blanks around
/// fields, one separator at the end of a line.
///
/// Throws UserError with file:line:column and remedy, all faults of the file at once (the first 20
/// and how many more there are): numbers that are none or not finite, rows with too few or too many
/// columns or another number of them than the first row, negative sizes, frames outside the limits,
/// an identity twice in a frame, a file that is missing, empty or not text.
PLAZA_API std::vector<MotRow> read_mot_rows(const std::filesystem::path& file,
                                            const RowLimits& limits = {});

/// The same from text; `name` stands for the file in errors.
PLAZA_API std::vector<MotRow> parse_mot_rows(std::string_view text, const std::string& name,
                                             const RowLimits& limits = {});

/// Ground-plane rows, under the same rules. `unit_m` is the length of the file's unit (0.025 for
/// WILDTRACK's grid cells); x_m and y_m named in a header are metres whatever it says.
PLAZA_API std::vector<GroundRow> read_ground_rows(const std::filesystem::path& file,
                                                  const RowLimits& limits = {},
                                                  double unit_m = 1.0);
PLAZA_API std::vector<GroundRow> parse_ground_rows(std::string_view text, const std::string& name,
                                                   const RowLimits& limits = {},
                                                   double unit_m = 1.0);

}  // namespace plaza
