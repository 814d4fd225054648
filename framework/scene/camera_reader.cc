#include "framework/scene/camera_reader.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "framework/config/pipeline.h"
#include "framework/config/text.h"
#include "framework/scene/calibration.h"
#include "framework/scene/calibration_check.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

const std::vector<std::string> kUnits{"mm", "cm", "m"};

/// One camera's entry while it is read.
class CameraReader {
 public:
  CameraReader(Fields& entry, Diagnostics& faults)
      : entry_(entry), faults_(faults), fields_(entry.object("calibration")) {}

  std::optional<Camera> read() {
    const std::size_t faults_before = faults_.size();
    const auto name = entry_.text("name");
    const auto size = entry_.image_size("image_size");
    entry_.refuse_unknown();
    std::optional<Camera> camera;
    const auto format = fields_.choice("format", {"tsai-xml", "tsai-json", "opencv", "rtk-json",
                                                  "homographies", "pinhole", "tsai"});
    if (format) {
      name_ = name.value_or("?");
      size_ = size.value_or(Eigen::Vector2i(1, 1));
      complete_ = name && size;
      try {
        camera = *format == "homographies" ? homographies() : metric(*format);
      } catch (const UserError& error) {
        for (const Diagnostic& d : error.diagnostics()) report(d);
      } catch (const std::invalid_argument& error) {  // the SDK's own last check
        fields_.fault(error.what());
      }
      fields_.refuse_unknown();
      if (!complete_ || faults_.size() > faults_before) return std::nullopt;
    }
    return camera;
  }

  /// Of the calibration, after read().
  const std::string& unit() const { return unit_; }

 private:
  /// Faults without a place are about this entry.
  void report(const Diagnostic& d) {
    if (d.where.file.empty()) {
      fields_.fault(d.message);
    } else {
      faults_.push_back(d);
    }
  }

  /// A fault of the numbers, where they stand: in the scene, or in a file that knows no camera
  /// names.
  void fault_at(const FilePosition& where, const std::string& message) {
    if (where.file == fields_.document().file) return fields_.fault(message);
    faults_.push_back({where, "", "camera \"" + name_ + "\": " + message});
  }

  std::optional<TextFile> file(std::string_view key) {
    const auto text = fields_.text(key);
    if (!text) return std::nullopt;
    std::filesystem::path path;
    try {
      path = resolve_path(*text, fields_.document().file);
    } catch (const UserError& error) {
      fields_.fault(key, error.what());
      return std::nullopt;
    }
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
      const bool data = text->starts_with("$PLAZA_DATA");
      fields_.fault(key, "there is no file \"" + path.string() + "\"; " +
                             (data ? "set the environment variable PLAZA_DATA to the data folder"
                                   : "a relative path starts at the scene's folder"));
      return std::nullopt;
    }
    if (std::filesystem::file_size(path, error) > kMaxCalibrationBytes) {
      fields_.fault(key,
                    in_quotes(path.string()) + " is larger than 1 MiB: not a calibration file");
      return std::nullopt;
    }
    std::ifstream in(path, std::ios::binary);
    TextFile out{{std::istreambuf_iterator<char>(in), {}}, path.string()};
    if (!in) {
      fields_.fault(key, in_quotes(path.string()) + " cannot be read");
      return std::nullopt;
    }
    return out;
  }

  std::optional<Calibration> calibration(const std::string& format) {
    if (format == "pinhole") return read_pinhole(fields_);
    if (format == "tsai") return read_tsai(fields_);
    const auto main = file("file");
    if (format == "tsai-xml") {
      if (main) return parse_tsai_xml(main->text, main->file);
    } else if (format == "tsai-json") {
      const auto index = fields_.index("index");
      fields_.need("calibrated_size");  // the format does not say it, and it is seldom the images'
      if (main && index) {
        return parse_tsai_json(main->text, main->file, static_cast<std::size_t>(*index));
      }
    } else if (format == "rtk-json") {
      const auto camera = fields_.text("camera");
      const auto meaning = fields_.choice("T_is", {"centre", "translation"}, "centre");
      if (main && camera && meaning) {
        return parse_rtk_json(
            main->text, main->file, *camera,
            *meaning == "centre" ? TranslationMeaning::kCentre : TranslationMeaning::kTranslation);
      }
    } else {
      std::optional<TextFile> pose;
      if (fields_.find("pose_file") != nullptr) {
        pose = file("pose_file");
        if (!pose) return std::nullopt;
      }
      if (main) return parse_opencv(*main, pose ? &*pose : nullptr);
    }
    return std::nullopt;
  }

  std::optional<Camera> metric(const std::string& format) {
    std::optional<std::string> unit = "m";
    if (format != "pinhole" && format != "tsai") {
      unit = fields_.choice("unit", kUnits, format == "opencv" ? "m" : "mm");
    }
    std::optional<Eigen::Vector2i> calibrated;
    bool sizes_fine = true;
    if (fields_.find("calibrated_size") != nullptr) {
      calibrated = fields_.image_size("calibrated_size");
      sizes_fine = calibrated.has_value();
    }
    auto c = calibration(format);
    if (!c || !unit || !sizes_fine) return std::nullopt;
    const double metres = *unit == "mm" ? 1e-3 : *unit == "cm" ? 1e-2 : 1;
    unit_ = *unit;
    const std::string rotation = rotation_fault(c->pose.rotation);
    if (!rotation.empty()) {
      fault_at(c->where, rotation);
      return std::nullopt;
    }
    c->pose.rotation = nearest_rotation(c->pose.rotation);
    c->pose.translation *= metres;
    if (!complete_ || !size_matches(*c, calibrated)) return std::nullopt;
    const Eigen::Vector2i made_for = calibrated.value_or(c->image_size.value_or(size_));
    const Camera camera = std::visit(
        [&](const auto& in) {
          if constexpr (std::is_same_v<std::decay_t<decltype(in)>, TsaiIntrinsics>) {
            return Camera::tsai(name_, made_for, in, c->pose);
          } else {
            return Camera::pinhole(name_, made_for, in, c->pose);
          }
        },
        c->intrinsics);
    principal_point_check(*c, made_for);
    for (const std::string& fault : lens_faults(camera)) fault_at(c->where, fault);
    return camera.scaled(size_);
  }

  static std::string size_text(const Eigen::Vector2i& size) {
    return std::to_string(size.x()) + "x" + std::to_string(size.y());
  }

  bool size_matches(const Calibration& c, const std::optional<Eigen::Vector2i>& calibrated) {
    if (!c.image_size || !entry_.has("image_size")) return true;
    if (calibrated) {
      if (*calibrated == *c.image_size) return true;
      fields_.fault("calibrated_size", "is " + size_text(*calibrated) + ", but " + c.where.file +
                                           " was made for " + size_text(*c.image_size));
      return false;
    }
    if (*c.image_size == size_) return true;
    entry_.fault("image_size",
                 "is " + size_text(size_) + ", but " + c.where.file + " was made for " +
                     size_text(*c.image_size) +
                     "; if the images are scaled, say so with \"calibrated_size\": [" +
                     std::to_string(c.image_size->x()) + ", " + std::to_string(c.image_size->y()) +
                     "] in \"calibration\"");
    return false;
  }

  void principal_point_check(const Calibration& c, const Eigen::Vector2i& size) {
    const auto [cx, cy] =
        std::visit([](const auto& in) { return std::pair(in.cx_px, in.cy_px); }, c.intrinsics);
    if (std::abs(cx / size.x() - 0.5) <= 1 && std::abs(cy / size.y() - 0.5) <= 1) return;
    fault_at(c.where, "the principal point (" + short_number(cx) + ", " + short_number(cy) +
                          ") lies far outside the " + size_text(size) +
                          " image; if the calibration was made for another size, say so with "
                          "\"calibrated_size\"");
  }

  /// A 3 x 3 matrix given in place, or by its name in `from`.
  std::optional<Eigen::Matrix3d> homography(std::string_view key, const JsonDocument* from) {
    const nlohmann::json* value = fields_.need(key);
    if (value == nullptr) return std::nullopt;
    if (!value->is_string()) return fields_.matrix3(key);
    const std::string name = value->get<std::string>();
    if (from == nullptr) {
      fields_.fault(key, "names a matrix of a file; give the \"file\", or the matrix here");
      return std::nullopt;
    }
    std::vector<std::string> names;
    if (from->root.is_object()) {
      for (const auto& item : from->root.items()) names.push_back(item.key());
    }
    if (!from->root.is_object() || !from->root.contains(name)) {
      fields_.fault(
          key, "\"" + from->file + "\" has no matrix \"" + name + "\"" + did_you_mean(name, names));
      return std::nullopt;
    }
    return Fields(*from, "", faults_).matrix3(name);
  }

  std::optional<Camera> homographies() {
    const auto head_z = fields_.positive("head_z_m");
    const auto maps =
        fields_.choice("maps", {"ground-to-image", "image-to-ground"}, "ground-to-image");
    Eigen::Vector2d metres_per_unit(1, 1), origin(0, 0);
    if (fields_.find("metres_per_unit") != nullptr) {
      metres_per_unit = fields_.pair("metres_per_unit").value_or(metres_per_unit);
      if ((metres_per_unit.array() == 0).any()) {
        fields_.fault("metres_per_unit", "must not be 0; negative mirrors an axis");
      }
    }
    if (fields_.find("origin_m") != nullptr) origin = fields_.pair("origin_m").value_or(origin);
    std::optional<JsonDocument> document;
    if (fields_.find("file") != nullptr) {
      const auto text = file("file");
      if (!text) return std::nullopt;
      document = parse_json(text->text, text->file);
    }
    const JsonDocument* from = document ? &*document : nullptr;
    auto ground = homography("ground", from), head = homography("head", from);
    if (!ground || !head || !head_z || !maps) return std::nullopt;
    if (*maps == "image-to-ground") {
      for (auto* h : {&*ground, &*head}) {
        const Eigen::Matrix3d inverse = h->inverse();
        if (!inverse.allFinite()) {
          fields_.fault(h == &*ground ? "ground" : "head", "is singular; check its nine numbers");
          return std::nullopt;
        }
        *h = inverse / inverse.norm();
      }
    }
    Eigen::Matrix3d units_from_metres = Eigen::Matrix3d::Identity();
    for (int i = 0; i < 2; ++i) {
      units_from_metres(i, i) = 1 / metres_per_unit[i];
      units_from_metres(i, 2) = -origin[i] / metres_per_unit[i];
    }
    if (!units_from_metres.allFinite()) return std::nullopt;
    unit_.clear();
    return Camera::plane_homographies(name_, size_, *ground * units_from_metres,
                                      *head * units_from_metres, *head_z);
  }

  Fields& entry_;
  Diagnostics& faults_;
  Fields fields_;
  std::string name_;
  Eigen::Vector2i size_ = Eigen::Vector2i::Ones();
  bool complete_ = false;  ///< name and size are known
  std::string unit_ = "m";
};

}  // namespace

std::optional<CameraEntry> read_camera(Fields& entry, Diagnostics& faults) {
  CameraReader reader(entry, faults);
  auto camera = reader.read();
  if (!camera) return std::nullopt;
  return CameraEntry{std::move(*camera), reader.unit(), entry.pointer_of("calibration")};
}

}  // namespace plaza
