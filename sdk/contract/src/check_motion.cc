#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "stage.h"

namespace plaza::contract {
namespace {

bool same(const MotionState& a, const MotionState& b) {
  return a.mean == b.mean && a.covariance == b.covariance;
}

bool is_covariance(const Eigen::Matrix2d& c) {
  const double scale = c.cwiseAbs().maxCoeff();
  return c.allFinite() && std::abs(c(0, 1) - c(1, 0)) <= 1e-9 * scale && c.trace() >= 0 &&
         c.determinant() >= -1e-12 * scale * scale;
}

}  // namespace

void check_motion(const Stage& stage, Findings& findings) {
  const auto model = stage.make_as<MotionModel>();
  const Eigen::Vector2d here(1.5, -2);
  Eigen::Matrix2d uncertainty;
  uncertainty << 0.09, 0.02, 0.02, 0.04;
  const MotionState start = model->start(here, uncertainty);

  findings.require((model->position(start) - here).norm() < 1e-6,
                   "start() is not where it was told to be");
  findings.require(is_covariance(model->position_covariance(start)),
                   "the covariance after start() is not symmetric positive semidefinite");
  findings.require(model->velocity(start).allFinite(), "the velocity after start() is not finite");
  findings.must_throw<std::invalid_argument>("predict() into the past", "std::invalid_argument",
                                             [&] { (void)model->predict(start, -0.1); });

  // a belief with a velocity, where the model has one
  MotionState moving = start;
  for (int i = 1; i <= 20; ++i) {
    moving = model->correct(model->predict(moving, 0.1), here + Eigen::Vector2d(0.12 * i, 0.05 * i),
                            uncertainty);
    findings.require(
        is_covariance(model->position_covariance(moving)),
        "a covariance is not symmetric positive semidefinite after predict() and correct()");
  }
  findings.require(model->position(moving).allFinite() && model->velocity(moving).allFinite(),
                   "position or velocity are not finite after predict() and correct()");

  for (const MotionState& state : {start, moving}) {
    const MotionState still = model->predict(state, 0);
    findings.require((model->position(still) - model->position(state)).norm() < 1e-9,
                     "predict(0) moves the position");
    const Eigen::Matrix2d before = model->position_covariance(state);
    findings.require(
        (model->position_covariance(still) - before).norm() <= 1e-9 * (1 + before.norm()),
        "predict(0) changes the covariance");
    double trace = before.trace();
    for (const double dt_s : {0.04, 0.5, 2.0, 10.0}) {
      const MotionState later = model->predict(state, dt_s);
      const Eigen::Matrix2d c = model->position_covariance(later);
      findings.require(is_covariance(c),
                       "a covariance is not symmetric positive semidefinite after predict()");
      findings.require(c.trace() >= trace * (1 - 1e-9),
                       "uncertainty shrinks while nothing is observed");
      findings.require(model->position(later).allFinite(), "a predicted position is not finite");
      trace = c.trace();
    }
    const Eigen::Vector2d prior = model->position(state);
    const Eigen::Vector2d measured = prior + Eigen::Vector2d(0.3, -0.2);
    const MotionState corrected = model->correct(state, measured, uncertainty);
    const Eigen::Vector2d posterior = model->position(corrected);
    findings.require((posterior - measured).norm() < (prior - measured).norm(),
                     "correct() does not move towards the measurement");
    findings.require((posterior - prior).norm() <= (measured - prior).norm() * 1.5,
                     "correct() jumps far beyond the measurement");
    findings.require(model->position_covariance(corrected).trace() <= before.trace() * (1 + 1e-9),
                     "correct() makes the position less certain");
    const MotionState sure = model->correct(state, measured, 1e-8 * Eigen::Matrix2d::Identity());
    findings.require((model->position(sure) - measured).norm() < 1e-2,
                     "a measurement that is all but certain is not believed");
  }

  // stateless: what is asked about another belief in between changes nothing
  const MotionState first = model->predict(moving, 0.3);
  (void)model->correct(model->start({100, 100}, uncertainty), {101, 101}, uncertainty);
  findings.require(same(first, model->predict(moving, 0.3)),
                   "predict() gives another answer the second time");
  findings.require(same(first, stage.make_as<MotionModel>()->predict(moving, 0.3)),
                   "a second model with the same parameters gives another answer");
}

}  // namespace plaza::contract
