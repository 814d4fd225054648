#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "plaza/core/export.h"
#include "plaza/geometry/box.h"

namespace plaza {

/// Half-line in the world, metres; `direction` has unit length and points away from the camera.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

/// Brown-Conrady distortion in OpenCV's order and meaning (k1, k2, p1, p2, k3); all zero: none.
struct Distortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
};

/// x_camera = rotation * x_world + translation, metres; x right, y down, z along the optical axis.
struct CameraFromWorld {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// Tsai's model (R. Tsai, "A versatile camera calibration technique", 1987) with the sensor's
/// geometry. Lengths on the sensor in mm, as calibration files give them; the pose in metres.
struct TsaiIntrinsics {
  double focal_mm = 0;
  double kappa1_per_mm2 = 0;  ///< undistorted = distorted * (1 + kappa1 * r_distorted^2)
  double dpx_mm = 0;          ///< effective pixel size along x (dx * ncx / nfx)
  double dpy_mm = 0;
  double sx = 1;
  double cx_px = 0;
  double cy_px = 0;
};

struct PinholeIntrinsics {
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;
  Distortion distortion;
  double skew_px = 0;  ///< column = fx x + skew y + cx; not 0 where pixels are no rectangles
};

/// What stands behind the pose: from camera coordinates to pixels.
using Intrinsics = std::variant<PinholeIntrinsics, TsaiIntrinsics>;

struct Body;

/// One calibrated view. Immutable, cheap to copy, safe to share between threads.
///
/// The factories throw std::invalid_argument for numbers that make no camera: an image size or
/// focal length that is not positive, or anything that is not finite. They trust that the pose is a
/// rotation; who reads one from a file checks that.
///
/// World frame: metres, z = 0 is the ground, z up. Pixels: centres at integers, x right, y down.
class PLAZA_API Camera {
 public:
  /// `image_size` is (width, height) in pixels.
  static Camera pinhole(std::string name, Eigen::Vector2i image_size,
                        const PinholeIntrinsics& intrinsics, const CameraFromWorld& pose);
  static Camera tsai(std::string name, Eigen::Vector2i image_size, const TsaiIntrinsics& intrinsics,
                     const CameraFromWorld& pose);
  /// From the homographies that map ground metres (x, y, 1) at z = 0 and on the plane z =
  /// `head_z_m` to pixels, as EPFL publishes them. Both share the images of the x and y directions,
  /// which fixes their relative scale and gives the whole 3 x 4 projection matrix. Throws UserError
  /// when the two contradict each other (they do not come from one camera).
  static Camera plane_homographies(std::string name, Eigen::Vector2i image_size,
                                   const Eigen::Matrix3d& image_from_ground,
                                   const Eigen::Matrix3d& image_from_head, double head_z_m);

  const std::string& name() const;
  int width() const;
  int height() const;
  /// The same for every model, for homographies as they decompose.
  const CameraFromWorld& pose() const;
  /// The lens model, of a scaled camera for its own image size; homographies decompose to a
  /// pinhole with skew. With these numbers, its size and pose() the factories give this camera
  /// again, up to rounding.
  Intrinsics intrinsics() const;
  /// Optical centre in the world, metres.
  Eigen::Vector3d centre() const;

  /// Pixel of a world point; nothing when the point is behind the camera or beyond the radius where
  /// the distortion model folds back. The pixel may lie outside the image.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& x_world) const;
  /// Viewing ray of a pixel; nothing where the distortion cannot be inverted.
  std::optional<Ray> ray(const Eigen::Vector2d& pixel) const;
  /// World (x, y) where the pixel's ray meets the plane z = `z_m`; nothing at or above the horizon.
  std::optional<Eigen::Vector2d> to_plane(const Eigen::Vector2d& pixel, double z_m = 0) const;
  /// d (x, y) / d pixel of to_plane, metres per pixel, 2 x 2; nothing where to_plane has no answer.
  std::optional<Eigen::Matrix2d> plane_jacobian(const Eigen::Vector2d& pixel, double z_m = 0) const;
  /// Whether the pixel is on the image, half a pixel around the outermost centres included.
  bool contains(const Eigen::Vector2d& pixel) const;

  /// The same camera for images of another size (both axes scaled about the image's corner).
  Camera scaled(Eigen::Vector2i image_size) const;

  /// Text of every number that matters, for cache keys: equal text, equal projections.
  std::string fingerprint() const;

 private:
  friend std::optional<Box> body_box(const Camera&, const Eigen::Vector2d&, const Body&);
  struct Model;
  static Camera from_model(Model model);
  explicit Camera(std::shared_ptr<const Model> model);
  std::shared_ptr<const Model> model_;
};

/// A standing person as an upright cylinder: what boxes are drawn from. The radius that fits PETS's
/// boxes best is 0.30 m.
struct Body {
  double height_m = 1.75;
  double radius_m = 0.30;
};

/// Bounding box in the image of the upright cylinder `body` standing at `position_m` (ground,
/// metres), not cut at the image border; exact to 1e-6 px, distortion included. Nothing when any
/// part of it is behind the camera or where the distortion folds back.
PLAZA_API std::optional<Box> body_box(const Camera& camera, const Eigen::Vector2d& position_m,
                                      const Body& body);

}  // namespace plaza
