#include "framework/config/text.h"
#include "framework/scene/calibration.h"
#include "framework/scene/fields.h"
#include "framework/scene/text_position.h"
#include "plaza/core/error.h"

namespace plaza {

Calibration parse_rtk_json(std::string_view text, const std::string& file,
                           const std::string& camera, TranslationMeaning meaning) {
  const JsonDocument document = parse_json(text, file);
  if (!document.root.is_object() || !document.root.contains(camera)) {
    std::vector<std::string> names;
    if (document.root.is_object()) {
      for (const auto& item : document.root.items()) names.push_back(item.key());
    }
    std::string message = "there is no camera \"" + camera + "\"; the file holds ";
    for (const std::string& name : names) {
      message.append(&name == names.data() ? "\"" : ", \"").append(name).append("\"");
    }
    if (names.empty()) message += "none";
    message += did_you_mean(camera, names);
    throw_fault({file, 1, 1}, std::move(message));
  }
  Diagnostics faults;
  std::string pointer = "/";
  pointer += pointer_token(camera);
  Fields fields(document, pointer, faults);
  PinholeIntrinsics in;
  if (fields.has("K")) {
    const Eigen::Matrix3d k = fields.matrix3("K").value_or(Eigen::Matrix3d::Identity());
    in = {k(0, 0), k(1, 1), k(0, 2), k(1, 2), {}};
    if (!(in.fx_px > 0 && in.fy_px > 0)) fields.fault("K", "focal lengths must be greater than 0");
  } else {
    in = {fields.positive("fx").value_or(1),
          fields.positive("fy").value_or(1),
          fields.number("cx").value_or(0),
          fields.number("cy").value_or(0),
          {}};
  }
  if (fields.has("k")) {
    const auto k = fields.numbers("k", 3).value_or(std::vector<double>(3));
    in.distortion.k1 = k[0];
    in.distortion.k2 = k[1];
    in.distortion.k3 = k[2];
  }
  if (fields.has("p")) {
    const auto p = fields.numbers("p", 2).value_or(std::vector<double>(2));
    in.distortion.p1 = p[0];
    in.distortion.p2 = p[1];
  }
  CameraFromWorld pose;
  pose.rotation = fields.matrix3("R").value_or(Eigen::Matrix3d::Identity());
  const auto t = fields.numbers("T", 3).value_or(std::vector<double>(3));
  pose.translation << t[0], t[1], t[2];
  if (meaning == TranslationMeaning::kCentre) {
    pose.translation = (-pose.rotation * pose.translation).eval();
  }
  if (!faults.empty()) throw UserError(std::move(faults));
  return {in, pose, std::nullopt, document.position(pointer)};
}

}  // namespace plaza
