#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "plaza/geometry/camera.h"

namespace plaza {

/// Lens distortion between normalised image coordinates (x / z, y / z), unit free.
///
/// Both models are one-to-one only up to some radius; beyond it they fold back, and a point there
/// would appear a second time, somewhere in the middle of the image. There, both directions give
/// nothing.
class Lens {
 public:
  Lens() = default;
  explicit Lens(const Distortion& brown_conrady);
  /// Tsai's undistorted = distorted * (1 + kappa * |distorted|^2), kappa in normalised units.
  static Lens tsai(double kappa);

  bool is_ideal() const { return kind_ == Kind::kIdeal; }
  /// What the lens was made with: Brown-Conrady's coefficients and Tsai's; 0 for the other model.
  const Distortion& coefficients() const { return coefficients_; }
  double tsai_kappa() const { return kappa_; }
  std::optional<Eigen::Vector2d> distort(const Eigen::Vector2d& ideal) const;
  std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& distorted) const;
  /// d distorted / d ideal at `ideal`, which must be a point that distort() accepts.
  Eigen::Matrix2d jacobian(const Eigen::Vector2d& ideal) const;
  std::string fingerprint() const;

 private:
  enum class Kind { kIdeal, kBrownConrady, kTsai };

  std::optional<Eigen::Vector2d> undistort_brown_conrady(const Eigen::Vector2d& distorted) const;
  double radial(double r2) const;
  Eigen::Vector2d brown_conrady(const Eigen::Vector2d& ideal) const;
  Eigen::Matrix2d brown_conrady_jacobian(const Eigen::Vector2d& ideal) const;

  Kind kind_ = Kind::kIdeal;
  Distortion coefficients_;
  double kappa_ = 0;
  /// Fold of the radial part: squared, in ideal coordinates (Brown-Conrady) or distorted ones
  /// (Tsai).
  double fold_r2_ = 0;
};

}  // namespace plaza
