#include "plugins/sinks/image-data-set/pinhole_fit.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <vector>

namespace plaza::data_set {
namespace {

constexpr int kSteps = 16;  // of the grid of pixels, each way

/// A pixel and the normalised image coordinates of its ray.
struct Sight {
  Eigen::Vector2d pixel;
  Eigen::Vector2d ideal;
};

std::vector<Sight> look_around(const Camera& camera) {
  std::vector<Sight> out;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const Eigen::Vector2d pixel(camera.width() * (i / double{kSteps}) - 0.5,
                                  camera.height() * (k / double{kSteps}) - 0.5);
      const std::optional<Ray> ray = camera.ray(pixel);
      if (!ray) continue;
      const Eigen::Vector3d x = camera.pose().rotation * ray->direction;
      if (x.z() > 1e-3) out.push_back({pixel, x.head<2>() / x.z()});
    }
  }
  return out;
}

}  // namespace

std::optional<PinholeIntrinsics> fit_pinhole(const Camera& camera, double tolerance_px) {
  const std::vector<Sight> sights = look_around(camera);
  if (sights.size() < 12) return std::nullopt;
  // u = c + f (x (1 + k1 r2 + k2 r4 + k3 r6) + tangential): linear in c, f and f times the rest
  PinholeIntrinsics out;
  const auto rows = static_cast<Eigen::Index>(sights.size());
  Eigen::MatrixXd across(rows, 7), down(rows, 7);
  Eigen::VectorXd u(rows), v(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Sight& s = sights[static_cast<std::size_t>(i)];
    const double x = s.ideal.x(), y = s.ideal.y(), r2 = s.ideal.squaredNorm();
    across.row(i) << 1, x, x * r2, x * r2 * r2, x * r2 * r2 * r2, 2 * x * y, r2 + 2 * x * x;
    down.row(i) << 1, y, y * r2, y * r2 * r2, y * r2 * r2 * r2, r2 + 2 * y * y, 2 * x * y;
    u[i] = s.pixel.x();
    v[i] = s.pixel.y();
  }
  const Eigen::VectorXd a = across.colPivHouseholderQr().solve(u);
  const Eigen::VectorXd b = down.colPivHouseholderQr().solve(v);
  if (!(a[1] > 0 && b[1] > 0)) return std::nullopt;
  out.cx_px = a[0];
  out.cy_px = b[0];
  out.fx_px = a[1];
  out.fy_px = b[1];
  out.distortion.k1 = 0.5 * (a[2] / a[1] + b[2] / b[1]);
  out.distortion.k2 = 0.5 * (a[3] / a[1] + b[3] / b[1]);
  out.distortion.k3 = 0.5 * (a[4] / a[1] + b[4] / b[1]);
  out.distortion.p1 = 0.5 * (a[5] / a[1] + b[5] / b[1]);
  out.distortion.p2 = 0.5 * (a[6] / a[1] + b[6] / b[1]);
  const Camera fitted =
      Camera::pinhole(camera.name(), {camera.width(), camera.height()}, out, camera.pose());
  for (const Sight& s : sights) {
    const Eigen::Vector3d x = s.ideal.homogeneous();
    const auto pixel =
        fitted.project(camera.pose().rotation.transpose() * (x - camera.pose().translation));
    if (!pixel || (*pixel - s.pixel).norm() > tolerance_px) return std::nullopt;
  }
  return out;
}

}  // namespace plaza::data_set
