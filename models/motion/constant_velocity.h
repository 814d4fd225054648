#pragma once

#include "plaza/component/declaration.h"

namespace plaza {

/// People keep their velocity but for a random acceleration: the Kalman filter of the nearly
/// constant velocity model (Bar-Shalom, Li and Kirubarajan, "Estimation with Applications to
/// Tracking and Navigation", 2001, 6.2.1-2).
///
/// State: (x, y, vx, vy), metres and metres per second.
class ConstantVelocity final : public MotionModel {
 public:
  struct Options {
    double acceleration_sigma = 1.0;
    double initial_speed_sigma_mps = 1.0;
  };
  static Declaration<Options> declare();
  ConstantVelocity(const Options& options, const BuildContext& context);

 private:
  MotionState do_start(const Eigen::Vector2d& position_m,
                       const Eigen::Matrix2d& covariance_m2) const override;
  MotionState do_predict(const MotionState& state, double dt_s) const override;
  MotionState do_correct(const MotionState& state, const Eigen::Vector2d& position_m,
                         const Eigen::Matrix2d& covariance_m2) const override;
  Eigen::Vector2d do_position(const MotionState& state) const override;
  Eigen::Vector2d do_velocity(const MotionState& state) const override;
  Eigen::Matrix2d do_position_covariance(const MotionState& state) const override;

  Options options_;
};

}  // namespace plaza
