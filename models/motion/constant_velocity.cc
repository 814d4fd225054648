#include "models/motion/constant_velocity.h"

#include <Eigen/Cholesky>

namespace plaza {

Declaration<ConstantVelocity::Options> ConstantVelocity::declare() {
  Parameters<Options> p;
  p.value("acceleration_sigma", &Options::acceleration_sigma)
      .unit("m/s^2")
      .above(0)
      .meaning(
          "strength of the random acceleration: standard deviation that an axis' velocity gains "
          "over one second, which is the same at every frame rate")
      .source("Bar-Shalom et al. 2001, (6.2.2-10)");
  p.value("initial_speed_sigma_mps", &Options::initial_speed_sigma_mps)
      .unit("m/s")
      .above(0)
      .meaning("standard deviation of an axis' velocity before anything is known of it");
  Declaration<Options> d("constant-velocity",
                         "Predicts people who keep their velocity, by a Kalman filter.");
  return d.source("thesis 6.3").parameters(std::move(p));
}

ConstantVelocity::ConstantVelocity(const Options& options, const BuildContext& /*context*/)
    : options_(options) {}

MotionState ConstantVelocity::do_start(const Eigen::Vector2d& position_m,
                                       const Eigen::Matrix2d& covariance_m2) const {
  MotionState state{.mean = Eigen::Vector4d::Zero(), .covariance = Eigen::Matrix4d::Zero()};
  state.mean.head<2>() = position_m;
  state.covariance.topLeftCorner<2, 2>() = covariance_m2;
  const double speed = options_.initial_speed_sigma_mps;
  state.covariance.bottomRightCorner<2, 2>() = speed * speed * Eigen::Matrix2d::Identity();
  return state;
}

MotionState ConstantVelocity::do_predict(const MotionState& state, double dt_s) const {
  const double q = options_.acceleration_sigma * options_.acceleration_sigma;
  const Eigen::Matrix2d unit = Eigen::Matrix2d::Identity();
  Eigen::Matrix4d transition = Eigen::Matrix4d::Identity();
  transition.topRightCorner<2, 2>() = dt_s * unit;
  // The integral of white acceleration, not one constant per step: two half steps equal a whole
  // one.
  Eigen::Matrix4d noise;
  noise << dt_s * dt_s * dt_s / 3 * q * unit, dt_s * dt_s / 2 * q * unit,  //
      dt_s * dt_s / 2 * q * unit, dt_s * q * unit;
  MotionState next;
  next.mean = transition * state.mean;
  next.covariance = transition * state.covariance * transition.transpose() + noise;
  return next;
}

MotionState ConstantVelocity::do_correct(const MotionState& state,
                                         const Eigen::Vector2d& position_m,
                                         const Eigen::Matrix2d& covariance_m2) const {
  const Eigen::Matrix2d innovation = state.covariance.topLeftCorner<2, 2>() + covariance_m2;
  const Eigen::Matrix<double, 4, 2> cross = state.covariance.leftCols<2>();
  const Eigen::Matrix<double, 4, 2> gain = innovation.llt().solve(cross.transpose()).transpose();
  // Joseph's form keeps the covariance positive definite, however exact a measurement claims to be.
  Eigen::Matrix4d rest = Eigen::Matrix4d::Identity();
  rest.leftCols<2>() -= gain;
  MotionState next;
  next.mean = state.mean + gain * (position_m - state.mean.head<2>());
  const Eigen::Matrix4d covariance =
      rest * state.covariance * rest.transpose() + gain * covariance_m2 * gain.transpose();
  next.covariance = 0.5 * (covariance + covariance.transpose());
  return next;
}

Eigen::Vector2d ConstantVelocity::do_position(const MotionState& state) const {
  return state.mean.head<2>();
}
Eigen::Vector2d ConstantVelocity::do_velocity(const MotionState& state) const {
  return state.mean.tail<2>();
}
Eigen::Matrix2d ConstantVelocity::do_position_covariance(const MotionState& state) const {
  return state.covariance.topLeftCorner<2, 2>();
}

}  // namespace plaza
