#include "lens.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "number_text.h"

namespace plaza {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kConverged = 1e-12;  // normalised units; 1e-10 is promised
constexpr int kMaxIterations = 50;

/// Smallest q > 0 with 1 + a q + b q^2 + c q^3 = 0; infinity without one. The polynomial is 1 at q
/// = 0.
double smallest_positive_root(double a, double b, double c) {
  const auto value = [&](double q) { return 1 + q * (a + q * (b + q * c)); };
  // between its stationary points the cubic is monotone, so each piece holds one root at most
  double breaks[2] = {kInfinity, kInfinity};
  if (c != 0) {
    const double discriminant = b * b - 3 * a * c;
    if (discriminant > 0) {
      // the stable pair of roots of 3 c q^2 + 2 b q + a
      const double s = -(b + std::copysign(std::sqrt(discriminant), b));
      const double roots[2] = {s / (3 * c), s != 0 ? a / s : kInfinity};
      breaks[0] = std::min(roots[0], roots[1]);
      breaks[1] = std::max(roots[0], roots[1]);
    }
  } else if (b != 0) {
    breaks[0] = -a / (2 * b);
  }
  double low = 0;
  for (const double end : {breaks[0], breaks[1], kInfinity}) {
    if (!(end > low)) continue;
    double high = end;
    if (!std::isfinite(high)) {
      // no root closer to zero than this bound (Cauchy), none further than that one (monotone tail)
      high = std::max(1.0, 2 * low);
      while (value(high) > 0 && high < 1e12) high *= 2;
    }
    if (value(high) <= 0) {
      for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
        const double middle = 0.5 * (low + high);
        (value(middle) > 0 ? low : high) = middle;
      }
      return low;
    }
    low = high;
  }
  return kInfinity;
}

}  // namespace

Lens::Lens(const Distortion& d) : coefficients_(d) {
  if (d.k1 == 0 && d.k2 == 0 && d.k3 == 0 && d.p1 == 0 && d.p2 == 0) return;
  kind_ = Kind::kBrownConrady;
  // d/dr of r (1 + k1 r^2 + k2 r^4 + k3 r^6), with q = r^2
  fold_r2_ = smallest_positive_root(3 * d.k1, 5 * d.k2, 7 * d.k3);
}

Lens Lens::tsai(double kappa) {
  Lens lens;
  if (kappa == 0) return lens;
  lens.kind_ = Kind::kTsai;
  lens.kappa_ = kappa;
  lens.fold_r2_ = kappa < 0 ? -1 / (3 * kappa) : kInfinity;
  return lens;
}

std::optional<Eigen::Vector2d> Lens::distort(const Eigen::Vector2d& ideal) const {
  switch (kind_) {
    case Kind::kIdeal:
      return ideal;
    case Kind::kBrownConrady: {
      if (!(ideal.squaredNorm() < fold_r2_)) return std::nullopt;
      // the tangential terms fold too, on one side earlier than the radial ones
      const bool tangential = coefficients_.p1 != 0 || coefficients_.p2 != 0;
      if (tangential && !(brown_conrady_jacobian(ideal).determinant() > 0)) return std::nullopt;
      return brown_conrady(ideal);
    }
    case Kind::kTsai:
      break;
  }
  // Solves kappa r^3 + r = u for the branch through zero: with r = A sinh(a), A = 2 / sqrt(3
  // kappa), the equation is sinh(3 a) = 3 u / A; sin instead of sinh for a negative kappa.
  const double u = ideal.norm();
  const double root = std::sqrt(3 * std::abs(kappa_));
  const double argument = 1.5 * u * root;
  if (argument < 1e-7) return ideal / (1 + kappa_ * u * u);  // next term: argument^4
  double r = 0;
  if (kappa_ > 0) {
    r = 2 / root * std::sinh(std::asinh(argument) / 3);
  } else {
    if (!(argument < 1)) return std::nullopt;
    r = 2 / root * std::sin(std::asin(argument) / 3);
  }
  return ideal * (r / u);
}

std::optional<Eigen::Vector2d> Lens::undistort(const Eigen::Vector2d& distorted) const {
  switch (kind_) {
    case Kind::kIdeal:
      return distorted;
    case Kind::kBrownConrady:
      return undistort_brown_conrady(distorted);
    case Kind::kTsai:
      break;
  }
  const double r2 = distorted.squaredNorm();
  if (!(r2 < fold_r2_)) return std::nullopt;
  return distorted * (1 + kappa_ * r2);
}

Eigen::Matrix2d Lens::jacobian(const Eigen::Vector2d& ideal) const {
  switch (kind_) {
    case Kind::kIdeal:
      return Eigen::Matrix2d::Identity();
    case Kind::kBrownConrady:
      return brown_conrady_jacobian(ideal);
    case Kind::kTsai:
      break;
  }
  const Eigen::Vector2d d = distort(ideal).value_or(ideal);
  const Eigen::Matrix2d ideal_by_distorted =
      (1 + kappa_ * d.squaredNorm()) * Eigen::Matrix2d::Identity() + 2 * kappa_ * d * d.transpose();
  return ideal_by_distorted.inverse();
}

double Lens::radial(double r2) const {
  return 1 + r2 * (coefficients_.k1 + r2 * (coefficients_.k2 + r2 * coefficients_.k3));
}

Eigen::Vector2d Lens::brown_conrady(const Eigen::Vector2d& ideal) const {
  const double x = ideal.x(), y = ideal.y(), r2 = ideal.squaredNorm();
  const double p1 = coefficients_.p1, p2 = coefficients_.p2;
  return ideal * radial(r2) + Eigen::Vector2d(2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                                              p1 * (r2 + 2 * y * y) + 2 * p2 * x * y);
}

Eigen::Matrix2d Lens::brown_conrady_jacobian(const Eigen::Vector2d& ideal) const {
  const double x = ideal.x(), y = ideal.y(), r2 = ideal.squaredNorm();
  const double p1 = coefficients_.p1, p2 = coefficients_.p2;
  const double radial_by_r2 =
      coefficients_.k1 + r2 * (2 * coefficients_.k2 + r2 * 3 * coefficients_.k3);
  const double mixed = 2 * x * y * radial_by_r2 + 2 * p1 * x + 2 * p2 * y;
  Eigen::Matrix2d j;
  j << radial(r2) + 2 * x * x * radial_by_r2 + 2 * p1 * y + 6 * p2 * x, mixed,  //
      mixed, radial(r2) + 2 * y * y * radial_by_r2 + 6 * p1 * y + 2 * p2 * x;
  return j;
}

std::optional<Eigen::Vector2d> Lens::undistort_brown_conrady(
    const Eigen::Vector2d& distorted) const {
  const double target = distorted.norm();
  if (target == 0 && coefficients_.p1 == 0 && coefficients_.p2 == 0) return distorted;
  // The radial part alone is monotone up to the fold: bracketed Newton cannot miss its solution.
  double low = 0, high = std::isfinite(fold_r2_) ? std::sqrt(fold_r2_) : std::max(target, 1e-3);
  const auto distorted_radius = [&](double r) { return r * radial(r * r); };
  while (!std::isfinite(fold_r2_) && distorted_radius(high) < target && high < 1e9) high *= 2;
  const bool tangential = coefficients_.p1 != 0 || coefficients_.p2 != 0;
  if (!tangential && !(distorted_radius(high) > target)) return std::nullopt;
  double r = std::min(target, high);
  for (int i = 0; i < kMaxIterations; ++i) {
    const double error = distorted_radius(r) - target;
    (error > 0 ? high : low) = r;
    const double r2 = r * r;
    const double slope =
        1 + r2 * (3 * coefficients_.k1 + r2 * (5 * coefficients_.k2 + r2 * 7 * coefficients_.k3));
    double next = r - error / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::abs(next - r);
    r = next;
    if (step <= kConverged * std::max(1.0, r)) break;
  }
  Eigen::Vector2d ideal = target > 0 ? Eigen::Vector2d(distorted * (r / target)) : distorted;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::Vector2d error = brown_conrady(ideal) - distorted;
    const Eigen::Vector2d step = brown_conrady_jacobian(ideal).inverse() * error;
    if (!step.allFinite()) return std::nullopt;
    ideal -= step;
    if (step.norm() > kConverged * std::max(1.0, ideal.norm())) continue;
    // a solution beyond the fold is some other point's
    const auto there = distort(ideal);
    if (there && (*there - distorted).norm() <= 1e-10 * std::max(1.0, target)) return ideal;
    return std::nullopt;
  }
  return std::nullopt;
}

std::string Lens::fingerprint() const {
  const Distortion& d = coefficients_;
  switch (kind_) {
    case Kind::kIdeal:
      return "ideal";
    case Kind::kBrownConrady:
      return "brown-conrady " + number_text({d.k1, d.k2, d.p1, d.p2, d.k3});
    case Kind::kTsai:
      break;
  }
  return "tsai " + number_text({kappa_});
}

}  // namespace plaza
