#include <Eigen/Geometry>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>

#include "framework/scene/calibration.h"
#include "framework/scene/fields.h"
#include "framework/scene/text_position.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

/// The numbers of both Tsai formats.
struct TsaiNumbers {
  double rx = 0, ry = 0, rz = 0, tx = 0, ty = 0, tz = 0;
};

CameraFromWorld pose_of(const TsaiNumbers& n) {
  return {tsai_rotation(n.rx, n.ry, n.rz), {n.tx, n.ty, n.tz}};
}

class XmlAttributes {
 public:
  XmlAttributes(std::string_view text, std::string file, Diagnostics& faults)
      : text_(text), file_(std::move(file)), faults_(faults) {}

  FilePosition position(const pugi::xml_node& node) const {
    return text_position(
        text_, node.offset_debug() < 0 ? 0 : static_cast<std::size_t>(node.offset_debug()), file_);
  }

  void fault(const pugi::xml_node& node, std::string message) {
    faults_.push_back({position(node), "", std::move(message)});
  }

  pugi::xml_node child(const pugi::xml_node& parent, const char* name) {
    const pugi::xml_node node = parent.child(name);
    if (!node)
      fault(parent, std::string("<") + parent.name() + "> lacks the element <" + name + ">");
    return node;
  }

  double number(const pugi::xml_node& node, const char* name, bool positive = false) {
    if (!node) return 1;  // its absence is reported already
    const std::string where = std::string("<") + node.name() + "> ";
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) {
      fault(node, where + "lacks the attribute \"" + name + "\"");
      return 1;
    }
    const auto value = parse_number(attribute.value());
    if (!value) {
      fault(node, where + name + "=\"" + attribute.value() + "\" is not a number");
      return 1;
    }
    if (positive && !(*value > 0)) {
      fault(node, where + name + "=\"" + attribute.value() + "\" must be greater than 0");
      return 1;
    }
    return *value;
  }

 private:
  std::string_view text_;
  std::string file_;
  Diagnostics& faults_;
};

}  // namespace

Eigen::Matrix3d tsai_rotation(double rx, double ry, double rz) {
  return (Eigen::AngleAxisd(rz, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(ry, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rx, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Calibration parse_tsai_xml(std::string_view text, const std::string& file) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result) {
    throw_fault(text_position(text, static_cast<std::size_t>(result.offset), file),
                std::string("not XML: ") + result.description());
  }
  const pugi::xml_node camera = document.child("Camera");
  if (!camera) {
    throw_fault({file, 1, 1}, "no element <Camera>: not a Tsai calibration as PETS publishes it");
  }
  Diagnostics faults;
  XmlAttributes xml(text, file, faults);
  const pugi::xml_node geometry = xml.child(camera, "Geometry");
  const pugi::xml_node intrinsic = xml.child(camera, "Intrinsic");
  const pugi::xml_node extrinsic = xml.child(camera, "Extrinsic");

  Calibration out;
  out.where = xml.position(camera);
  const Eigen::Vector2d size(xml.number(geometry, "width", true),
                             xml.number(geometry, "height", true));
  if (!(size.maxCoeff() <= 100'000) || size != size.array().round().matrix()) {
    xml.fault(geometry, "<Geometry> width and height must be whole pixels, at most 100000");
  } else {
    out.image_size = size.cast<int>();
  }
  TsaiIntrinsics in;
  in.dpx_mm = xml.number(geometry, "dpx", true);
  in.dpy_mm = xml.number(geometry, "dpy", true);
  in.focal_mm = xml.number(intrinsic, "focal", true);
  in.kappa1_per_mm2 = xml.number(intrinsic, "kappa1");
  in.cx_px = xml.number(intrinsic, "cx");
  in.cy_px = xml.number(intrinsic, "cy");
  in.sx = xml.number(intrinsic, "sx", true);
  out.intrinsics = in;
  TsaiNumbers n;
  n.tx = xml.number(extrinsic, "tx");
  n.ty = xml.number(extrinsic, "ty");
  n.tz = xml.number(extrinsic, "tz");
  n.rx = xml.number(extrinsic, "rx");
  n.ry = xml.number(extrinsic, "ry");
  n.rz = xml.number(extrinsic, "rz");
  out.pose = pose_of(n);
  if (!faults.empty()) throw UserError(std::move(faults));
  return out;
}

Calibration parse_tsai_json(std::string_view text, const std::string& file, std::size_t index) {
  const JsonDocument document = parse_json(text, file);
  Diagnostics faults;
  Fields fields(document, "", faults);
  bool index_reported = false;  // all arrays have the same length, and once is enough
  const auto value = [&](std::string_view key, bool for_all = false,
                         bool positive = false) -> double {
    const nlohmann::json* found = fields.need(key);
    if (found == nullptr) return 1;
    const nlohmann::json* item = found;
    if (found->is_array()) {
      if (index >= found->size() && index_reported) return 1;
      if (index >= found->size()) {
        index_reported = true;
        fields.fault(key, "has " + std::to_string(found->size()) + " cameras; there is no index " +
                              std::to_string(index));
        return 1;
      }
      item = &(*found)[index];
    } else if (!for_all) {
      fields.fault(key, "must be an array with one number per camera");
      return 1;
    }
    if (!item->is_number() || !std::isfinite(item->get<double>())) {
      fields.fault(key, "must hold numbers");
      return 1;
    }
    if (positive && !(item->get<double>() > 0)) {
      fields.fault(key, "must be greater than 0, not " + short_number(item->get<double>()));
      return 1;
    }
    return item->get<double>();
  };
  TsaiIntrinsics in;
  in.focal_mm = value("focal", false, true);
  in.kappa1_per_mm2 = value("kappa1");
  in.cx_px = value("cx");
  in.cy_px = value("cy");
  in.dpx_mm = value("dx", true, true);
  in.dpy_mm = value("dy", true, true);
  in.sx = fields.has("sx") ? value("sx", true, true) : 1;
  const TsaiNumbers n{value("rx"), value("ry"), value("rz"), value("tx"), value("ty"), value("tz")};
  if (!faults.empty()) throw UserError(std::move(faults));
  return {in, pose_of(n), std::nullopt, {file, 1, 1}};
}

}  // namespace plaza
