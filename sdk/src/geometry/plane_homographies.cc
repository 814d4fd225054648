#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

#include "camera_model.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

/// Upper triangular K with positive diagonal and rotation R, K R = `m` (R. Hartley and A.
/// Zisserman, "Multiple View Geometry", A4.1.1); `m` must have a positive determinant.
void rq(const Eigen::Matrix3d& m, Eigen::Matrix3d& k, Eigen::Matrix3d& r) {
  // QR of the rows in reverse order
  const Eigen::Matrix3d reversed = m.colwise().reverse().transpose();
  const Eigen::HouseholderQR<Eigen::Matrix3d> qr(reversed);
  const Eigen::Matrix3d q = qr.householderQ();
  const Eigen::Matrix3d upper = qr.matrixQR().triangularView<Eigen::Upper>();
  k = upper.transpose().colwise().reverse().rowwise().reverse();
  r = q.transpose().colwise().reverse();
  for (int i = 0; i < 3; ++i) {
    if (k(i, i) < 0) {
      k.col(i) *= -1;
      r.row(i) *= -1;
    }
  }
}

}  // namespace

Camera Camera::plane_homographies(std::string name, Eigen::Vector2i image_size,
                                  const Eigen::Matrix3d& image_from_ground,
                                  const Eigen::Matrix3d& image_from_head, double head_z_m) {
  const auto fail = [&name](const std::string& what) {
    throw UserError("camera '" + name + "': " + what);
  };
  if (!(image_size.x() > 0 && image_size.y() > 0) || !(head_z_m > 0) ||
      !image_from_ground.allFinite() || !image_from_head.allFinite()) {
    throw std::invalid_argument(
        "camera '" + name + "': image size and head plane must be positive, homographies finite");
  }
  // Pixels scaled to about one make the three rows comparable.
  Eigen::Matrix3d unit_from_pixel = Eigen::Matrix3d::Identity();
  const double size = image_size.maxCoeff();
  unit_from_pixel.diagonal() << 1 / size, 1 / size, 1;
  Eigen::Matrix3d ground = unit_from_pixel * image_from_ground;
  Eigen::Matrix3d head = unit_from_pixel * image_from_head;
  for (const auto* h : {&ground, &head}) {
    const double volume = std::abs(h->determinant());
    if (!(volume > 1e-12 * h->col(0).norm() * h->col(1).norm() * h->col(2).norm())) {
      fail(std::string("the ") + (h == &ground ? "ground" : "head-plane") +
           " homography is singular; check its nine numbers");
    }
  }
  ground /= ground.leftCols<2>().norm();
  // Both are [p1 p2 p3 z + p4] up to scale: the scale that makes the first two columns agree.
  const auto ground_xy = ground.leftCols<2>();
  const auto head_xy = head.leftCols<2>();
  head *= (ground_xy.array() * head_xy.array()).sum() / head_xy.squaredNorm();
  const double contradiction = (head.leftCols<2>() - ground_xy).norm();
  if (!(contradiction < 0.05)) {
    const auto percent = std::lround(100 * std::min(contradiction, 10.0));
    fail("the ground and the head-plane homography do not come from one camera: the images of " +
         std::string("the x and y directions differ by ") + std::to_string(percent) +
         " % (at most 5 % allowed); check that both map metres to pixels, in the same direction " +
         "and the same world frame");
  }
  // each plane's share of the disagreement is the same
  const Eigen::Matrix<double, 3, 2> xy = 0.5 * (ground.leftCols<2>() + head.leftCols<2>());
  Eigen::Matrix3d m;
  m << xy, (head.col(2) - ground.col(2)) / head_z_m;
  Eigen::Vector3d p4 = ground.col(2);
  const double volume = m.determinant();
  const bool apart = (head.col(2) - ground.col(2)).norm() > 1e-9 * ground.col(2).norm();
  if (!apart || !(std::abs(volume) > 1e-12 * m.col(0).norm() * m.col(1).norm() * m.col(2).norm())) {
    fail("the ground and the head-plane homography are the same; they must belong to two heights");
  }
  // A projection matrix has no sign: the one with the scene in front has a rotation.
  if (volume < 0) {
    m = -m;
    p4 = -p4;
  }
  Eigen::Matrix3d k, r;
  rq(m, k, r);
  const Eigen::Vector3d t = k.triangularView<Eigen::Upper>().solve(p4);
  k /= k(2, 2);
  Model model;
  model.name = std::move(name);
  model.image_size = std::move(image_size);
  model.pose.rotation = r;
  model.pose.translation = t;
  model.pixel_from_lens = size * k.topLeftCorner<2, 2>();
  model.principal_point = size * k.topRightCorner<2, 1>();
  return from_model(std::move(model));
}

}  // namespace plaza
