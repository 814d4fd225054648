#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "framework/config/json_document.h"
#include "plaza/core/diagnostic.h"
#include "plaza/geometry/camera.h"

namespace plaza {

class Fields;

/// What a calibration says of one camera, before it is checked. Lengths of the pose are in the
/// file's own unit.
struct Calibration {
  Intrinsics intrinsics;
  CameraFromWorld pose;
  std::optional<Eigen::Vector2i> image_size;  ///< that it was made for, where the file says so
  FilePosition where;                         ///< the camera in the file
};

/// Calibration files are small; a larger one is some other file.
inline constexpr std::size_t kMaxCalibrationBytes = 1 << 20;

// The readers take the text of a file; `file` is its name for messages. All throw UserError with
// every fault of the file, each at its line.

/// Tsai calibration as PETS 2009 publishes it: <Camera> with <Geometry>, <Intrinsic>, <Extrinsic>.
Calibration parse_tsai_xml(std::string_view text, const std::string& file);

/// Tsai calibrations of several cameras, one array per number, as for EPFL's sequences: focal,
/// kappa1, cx, cy, rx, ry, rz, tx, ty, tz, dx, dy, sx; the last three may be one number for all.
Calibration parse_tsai_json(std::string_view text, const std::string& file, std::size_t index);

enum class TranslationMeaning {
  kCentre,      ///< x_camera = R (x_world - T)
  kTranslation  ///< x_camera = R x_world + T
};

/// {"0": {"R": 3 x 3, "T": 3, "fx", "fy", "cx", "cy" or "K": 3 x 3, "k": [k1, k2, k3], "p": [p1,
/// p2]}}
Calibration parse_rtk_json(std::string_view text, const std::string& file,
                           const std::string& camera, TranslationMeaning meaning);

struct TextFile {
  std::string text;
  std::string file;
};

/// OpenCV's FileStorage in YAML, XML or JSON, and ROS's camera_info YAML; the pose may stand in a
/// file of its own. Known names: docs/scenes.md.
Calibration parse_opencv(const TextFile& intrinsics, const TextFile* pose);

// Calibrations without a file, from a scene's own "calibration" object, in metres. Nothing where a
// number is missing or wrong, which is then reported in `fields`.

std::optional<Calibration> read_pinhole(Fields& fields);
/// The numbers of TsaiIntrinsics by their names; the pose as for pinholes.
std::optional<Calibration> read_tsai(Fields& fields);

/// R = Rz(rz) Ry(ry) Rx(rx), angles in radians (Tsai's convention).
Eigen::Matrix3d tsai_rotation(double rx, double ry, double rz);

}  // namespace plaza
