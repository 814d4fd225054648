// Calibrations whose numbers stand in the scene itself.
#include <Eigen/Geometry>

#include "framework/scene/calibration.h"
#include "framework/scene/fields.h"

namespace plaza {
namespace {

/// Either rotation and translation_m, or the camera's centre and a point it looks at.
std::optional<CameraFromWorld> read_inline_pose(Fields& fields) {
  CameraFromWorld pose;
  const bool looks = fields.has("look_at_m") || fields.has("centre_m");
  if (!looks) {
    const auto rotation = fields.matrix3("rotation");
    const auto t = fields.numbers("translation_m", 3);
    if (!rotation || !t) return std::nullopt;
    return CameraFromWorld{*rotation, Eigen::Vector3d(t->data())};
  }
  const auto centre = fields.numbers("centre_m", 3), target = fields.numbers("look_at_m", 3);
  if (!centre || !target) return std::nullopt;
  const Eigen::Vector3d eye(centre->data());
  const Eigen::Vector3d forward = Eigen::Vector3d(target->data()) - eye;
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  if (!(right.norm() > 1e-6 * forward.norm())) {
    fields.fault("look_at_m",
                 "must not be straight above or below centre_m: which way is up in "
                 "the image is undefined then; give rotation and translation_m");
    return std::nullopt;
  }
  const Eigen::Vector3d x = right.normalized(), z = forward.normalized();
  pose.rotation << x.transpose(), z.cross(x).transpose(), z.transpose();
  pose.translation = -pose.rotation * eye;
  return pose;
}

Calibration calibration_of(const Intrinsics& intrinsics, const CameraFromWorld& pose,
                           const Fields& fields) {
  return {intrinsics, pose, std::nullopt, fields.document().position(fields.pointer())};
}

}  // namespace

std::optional<Calibration> read_pinhole(Fields& fields) {
  const auto fx = fields.positive("fx_px"), fy = fields.positive("fy_px");
  const auto cx = fields.number("cx_px"), cy = fields.number("cy_px");
  const auto skew = fields.number("skew_px", 0);
  const auto d = fields.find("distortion") != nullptr ? fields.numbers("distortion", 5)
                                                      : std::vector<double>(5, 0.0);
  const auto pose = read_inline_pose(fields);
  if (!fx || !fy || !cx || !cy || !skew || !d || !pose) return std::nullopt;
  const Distortion distortion{(*d)[0], (*d)[1], (*d)[2], (*d)[3], (*d)[4]};
  return calibration_of(PinholeIntrinsics{*fx, *fy, *cx, *cy, distortion, *skew}, *pose, fields);
}

std::optional<Calibration> read_tsai(Fields& fields) {
  const auto focal = fields.positive("focal_mm");
  const auto kappa1 = fields.number("kappa1_per_mm2");
  const auto dpx = fields.positive("dpx_mm"), dpy = fields.positive("dpy_mm");
  const auto sx = fields.find("sx") != nullptr ? fields.positive("sx") : 1;
  const auto cx = fields.number("cx_px"), cy = fields.number("cy_px");
  const auto pose = read_inline_pose(fields);
  if (!focal || !kappa1 || !dpx || !dpy || !sx || !cx || !cy || !pose) return std::nullopt;
  return calibration_of(TsaiIntrinsics{*focal, *kappa1, *dpx, *dpy, *sx, *cx, *cy}, *pose, fields);
}

}  // namespace plaza
