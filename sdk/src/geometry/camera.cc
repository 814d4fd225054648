#include "plaza/geometry/camera.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "camera_model.h"
#include "number_text.h"

namespace plaza {
namespace {

void require(bool condition, const std::string& camera, const char* message) {
  if (!condition) throw std::invalid_argument("camera '" + camera + "': " + message);
}

}  // namespace

Camera::Camera(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

Camera Camera::from_model(Model model) {
  const std::string& name = model.name;
  require(model.image_size.x() > 0 && model.image_size.y() > 0, name,
          "image size must be positive");
  require(model.pose.rotation.allFinite() && model.pose.translation.allFinite(), name,
          "the pose must be finite");
  require(model.pixel_from_lens.allFinite() && model.principal_point.allFinite(), name,
          "the intrinsic numbers must be finite");
  require(model.pixel_from_lens(0, 0) > 0 && model.pixel_from_lens(1, 1) > 0, name,
          "focal lengths must be positive");
  model.centre = -model.pose.rotation.transpose() * model.pose.translation;
  return Camera(std::make_shared<const Model>(std::move(model)));
}

Camera Camera::pinhole(std::string name, Eigen::Vector2i image_size,
                       const PinholeIntrinsics& intrinsics, const CameraFromWorld& pose) {
  const Distortion& d = intrinsics.distortion;
  require(std::isfinite(d.k1 + d.k2 + d.k3 + d.p1 + d.p2), name, "the distortion must be finite");
  Model model;
  model.name = std::move(name);
  model.image_size = std::move(image_size);
  model.pose = pose;
  model.lens = Lens(d);
  model.pixel_from_lens << intrinsics.fx_px, intrinsics.skew_px, 0, intrinsics.fy_px;
  model.principal_point << intrinsics.cx_px, intrinsics.cy_px;
  return from_model(std::move(model));
}

Camera Camera::tsai(std::string name, Eigen::Vector2i image_size, const TsaiIntrinsics& intrinsics,
                    const CameraFromWorld& pose) {
  const TsaiIntrinsics& in = intrinsics;
  require(in.focal_mm > 0 && in.dpx_mm > 0 && in.dpy_mm > 0 && in.sx > 0, name,
          "focal length, pixel size and sx must be positive");
  require(std::isfinite(in.kappa1_per_mm2), name, "kappa1 must be finite");
  Model model;
  model.name = std::move(name);
  model.image_size = std::move(image_size);
  model.pose = pose;
  // Tsai's sensor coordinates are normalised ones times the focal length
  model.lens = Lens::tsai(in.kappa1_per_mm2 * in.focal_mm * in.focal_mm);
  model.pixel_from_lens.diagonal() << in.sx * in.focal_mm / in.dpx_mm, in.focal_mm / in.dpy_mm;
  model.principal_point << in.cx_px, in.cy_px;
  model.focal_mm = in.focal_mm;
  model.sx = in.sx;
  return from_model(std::move(model));
}

const std::string& Camera::name() const { return model_->name; }
int Camera::width() const { return model_->image_size.x(); }
int Camera::height() const { return model_->image_size.y(); }
const CameraFromWorld& Camera::pose() const { return model_->pose; }
Eigen::Vector3d Camera::centre() const { return model_->centre; }

Intrinsics Camera::intrinsics() const {
  const Model& m = *model_;
  const Eigen::Matrix2d& k = m.pixel_from_lens;
  if (m.focal_mm > 0) {
    return TsaiIntrinsics{.focal_mm = m.focal_mm,
                          .kappa1_per_mm2 = m.lens.tsai_kappa() / (m.focal_mm * m.focal_mm),
                          .dpx_mm = m.sx * m.focal_mm / k(0, 0),
                          .dpy_mm = m.focal_mm / k(1, 1),
                          .sx = m.sx,
                          .cx_px = m.principal_point.x(),
                          .cy_px = m.principal_point.y()};
  }
  return PinholeIntrinsics{.fx_px = k(0, 0),
                           .fy_px = k(1, 1),
                           .cx_px = m.principal_point.x(),
                           .cy_px = m.principal_point.y(),
                           .distortion = m.lens.coefficients(),
                           .skew_px = k(0, 1)};
}

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& x_world) const {
  const Model& m = *model_;
  const Eigen::Vector3d x = m.pose.rotation * x_world + m.pose.translation;
  if (!(x.z() > kMinDepth_m)) return std::nullopt;
  const auto distorted = m.lens.distort(x.head<2>() / x.z());
  if (!distorted) return std::nullopt;
  const Eigen::Vector2d pixel = m.pixel_from_lens * *distorted + m.principal_point;
  if (!pixel.allFinite()) return std::nullopt;
  return pixel;
}

std::optional<Camera::Model::Projection> Camera::Model::project_with_jacobian(
    const Eigen::Vector3d& x_world) const {
  const Eigen::Vector3d x = pose.rotation * x_world + pose.translation;
  if (!(x.z() > kMinDepth_m)) return std::nullopt;
  const Eigen::Vector2d ideal = x.head<2>() / x.z();
  const auto distorted = lens.distort(ideal);
  if (!distorted) return std::nullopt;
  Eigen::Matrix<double, 2, 3> ideal_by_camera;
  ideal_by_camera << 1, 0, -ideal.x(), 0, 1, -ideal.y();
  ideal_by_camera /= x.z();
  return Projection{pixel_from_lens * *distorted + principal_point,
                    pixel_from_lens * lens.jacobian(ideal) * ideal_by_camera * pose.rotation};
}

std::optional<Ray> Camera::ray(const Eigen::Vector2d& pixel) const {
  const Model& m = *model_;
  if (!pixel.allFinite()) return std::nullopt;
  const Eigen::Vector2d q = pixel - m.principal_point;
  const Eigen::Matrix2d& k = m.pixel_from_lens;
  const double y = q.y() / k(1, 1);
  const auto ideal = m.lens.undistort({(q.x() - k(0, 1) * y) / k(0, 0), y});
  if (!ideal || !ideal->allFinite()) return std::nullopt;  // extreme coefficients overflow
  return Ray{m.centre, (m.pose.rotation.transpose() * ideal->homogeneous()).stableNormalized()};
}

std::optional<Eigen::Vector2d> Camera::to_plane(const Eigen::Vector2d& pixel, double z_m) const {
  const auto sight = ray(pixel);
  if (!sight) return std::nullopt;
  const double drop = z_m - sight->origin.z();
  // parallel to the plane within rounding is the horizon
  if (std::abs(sight->direction.z()) < 1e-12 || !(drop / sight->direction.z() > 0)) {
    return std::nullopt;
  }
  const double distance = drop / sight->direction.z();
  return sight->origin.head<2>() + distance * sight->direction.head<2>();
}

std::optional<Eigen::Matrix2d> Camera::plane_jacobian(const Eigen::Vector2d& pixel,
                                                      double z_m) const {
  const auto there = to_plane(pixel, z_m);
  if (!there) return std::nullopt;
  const auto projection = model_->project_with_jacobian({there->x(), there->y(), z_m});
  if (!projection) return std::nullopt;
  const Eigen::Matrix2d pixel_by_plane = projection->by_world.leftCols<2>();
  const Eigen::Matrix2d plane_by_pixel = pixel_by_plane.inverse();
  if (!plane_by_pixel.allFinite()) return std::nullopt;
  return plane_by_pixel;
}

bool Camera::contains(const Eigen::Vector2d& pixel) const {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= width() - 0.5 &&
         pixel.y() <= height() - 0.5;
}

Camera Camera::scaled(Eigen::Vector2i image_size) const {
  Model model = *model_;
  const Eigen::Vector2d scale =
      image_size.cast<double>().cwiseQuotient(model.image_size.cast<double>());
  model.image_size = std::move(image_size);
  model.pixel_from_lens = scale.asDiagonal() * model.pixel_from_lens;
  // the corner lies half a pixel before the first centre
  model.principal_point =
      scale.cwiseProduct(model.principal_point + Eigen::Vector2d::Constant(0.5)) -
      Eigen::Vector2d::Constant(0.5);
  return from_model(std::move(model));
}

std::string Camera::fingerprint() const {
  const Model& m = *model_;
  const Eigen::Matrix3d& r = m.pose.rotation;
  const Eigen::Vector3d& t = m.pose.translation;
  const Eigen::Matrix2d& k = m.pixel_from_lens;
  return std::to_string(width()) + "x" + std::to_string(height()) + " K " +
         number_text({k(0, 0), k(0, 1), k(1, 1), m.principal_point.x(), m.principal_point.y()}) +
         " lens " + m.lens.fingerprint() + " R " +
         number_text(
             {r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)}) +
         " t " + number_text({t.x(), t.y(), t.z()});
}

}  // namespace plaza
