#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "plaza/component/component.h"
#include "plaza/geometry/camera.h"
#include "plaza/geometry/silhouette.h"

namespace plaza {

/// A body on the ground.
struct Pose {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double heading_rad = 0;  ///< 0 along +x, counter-clockwise seen from above
  double scale = 1;        ///< body size relative to the model's own
};

/// The geometry of what is tracked (three cylinders for people, a box for other objects).
class PLAZA_API ShapeModel : public Component {
 public:
  ~ShapeModel() override;
  Silhouette silhouette(const Pose& pose, const Camera& camera) const;
  Body body() const { return do_body(); }

 protected:
  virtual Silhouette do_silhouette(const Pose& pose, const Camera& camera) const = 0;
  virtual Body do_body() const = 0;
};

/// A coloured surface point in the body's frame (x ahead, y left, z up, metres).
struct SurfacePoint {
  Eigen::Vector3f position_m;
  Eigen::Vector3f normal;
  Eigen::Vector3f lab;  ///< CIE-Lab colour
};

/// How a person looks from all around (thesis 5.4.1).
class PLAZA_API AppearanceModel : public Component {
 public:
  ~AppearanceModel() override;
  /// Surface points visible to the camera at the pose.
  std::vector<SurfacePoint> visible_points(const Pose& pose, const Camera& camera) const;

 protected:
  virtual std::vector<SurfacePoint> do_visible_points(const Pose& pose,
                                                      const Camera& camera) const = 0;
};

/// Gaussian belief of a motion model; the layout of `mean` is the model's own.
struct MotionState {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// How people move on the ground. Stateless: the belief is passed in and out, times in seconds.
class PLAZA_API MotionModel : public Component {
 public:
  ~MotionModel() override;
  MotionState start(const Eigen::Vector2d& position_m, const Eigen::Matrix2d& covariance_m2) const;
  /// dt_s >= 0, else std::invalid_argument.
  MotionState predict(const MotionState& state, double dt_s) const;
  MotionState correct(const MotionState& state, const Eigen::Vector2d& position_m,
                      const Eigen::Matrix2d& covariance_m2) const;
  Eigen::Vector2d position(const MotionState& state) const;             ///< m
  Eigen::Vector2d velocity(const MotionState& state) const;             ///< m/s
  Eigen::Matrix2d position_covariance(const MotionState& state) const;  ///< m^2

 protected:
  virtual MotionState do_start(const Eigen::Vector2d& position_m,
                               const Eigen::Matrix2d& covariance_m2) const = 0;
  virtual MotionState do_predict(const MotionState& state, double dt_s) const = 0;
  virtual MotionState do_correct(const MotionState& state, const Eigen::Vector2d& position_m,
                                 const Eigen::Matrix2d& covariance_m2) const = 0;
  virtual Eigen::Vector2d do_position(const MotionState& state) const = 0;
  virtual Eigen::Vector2d do_velocity(const MotionState& state) const = 0;
  virtual Eigen::Matrix2d do_position_covariance(const MotionState& state) const = 0;
};

}  // namespace plaza
