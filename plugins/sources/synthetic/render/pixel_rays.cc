#include "plugins/sources/synthetic/render/pixel_rays.h"

#include <cmath>
#include <numbers>

#include "plugins/sources/synthetic/people/random.h"

namespace plaza::synthetic {

CalibrationError::CalibrationError(const Camera& camera, double rms_px, std::uint64_t seed)
    : middle_(0.5 * camera.width(), 0.5 * camera.height()), reach_px_(middle_.norm()) {
  Random draw(mix(seed, 0xca11b));
  const double angle = draw.uniform(0, 2 * std::numbers::pi);
  offset_ = draw.uniform(0.6, 1.0) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  turn_ = draw.uniform(-1, 1);
  scale_ = draw.uniform(-1, 1);
  cubic_ = draw.uniform(-1, 1);
  double sum = 0;
  int count = 0;
  for (double y = 0.05; y < 1; y += 0.1) {
    for (double x = 0.05; x < 1; x += 0.1) {
      sum += raw(2 * middle_.cwiseProduct(Eigen::Vector2d(x, y))).squaredNorm();
      ++count;
    }
  }
  gain_ = rms_px / std::sqrt(sum / count);
}

Eigen::Vector2d CalibrationError::raw(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d q = (pixel - middle_) / reach_px_;
  return offset_ + turn_ * Eigen::Vector2d(-q.y(), q.x()) + scale_ * q +
         cubic_ * 2 * q.squaredNorm() * q;
}

Eigen::Vector2d CalibrationError::at(const Eigen::Vector2d& pixel) const {
  return gain_ * raw(pixel);
}

PixelRays::PixelRays(const Camera& camera, const CalibrationError& error)
    : camera_(camera),
      error_(error),
      width_(camera.width()),
      height_(camera.height()),
      origin_(camera.centre().cast<float>()) {
  corners_.reserve(static_cast<std::size_t>(width_ + 1) * static_cast<std::size_t>(height_ + 1));
  for (int y = 0; y <= height_; ++y) {
    for (int x = 0; x <= width_; ++x) {
      const Eigen::Vector2d pixel(x - 0.5, y - 0.5);
      const std::optional<Ray> ray = camera.ray(pixel + error.at(pixel));
      corners_.push_back(ray ? Eigen::Vector3f(ray->direction.cast<float>())
                             : Eigen::Vector3f::Zero());
    }
  }
}

Eigen::Vector3f PixelRays::direction(int x, int y, float dx, float dy) const {
  const std::size_t row = static_cast<std::size_t>(width_ + 1);
  const std::size_t at = static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x);
  const Eigen::Vector3f& a = corners_[at];
  const Eigen::Vector3f& b = corners_[at + 1];
  const Eigen::Vector3f& c = corners_[at + row];
  const Eigen::Vector3f& d = corners_[at + row + 1];
  if (a.isZero() || b.isZero() || c.isZero() || d.isZero()) return Eigen::Vector3f::Zero();
  const Eigen::Vector3f top = a + dx * (b - a);
  const Eigen::Vector3f low = c + dx * (d - c);
  return (top + dy * (low - top)).normalized();
}

std::optional<Eigen::Vector2d> PixelRays::project(const Eigen::Vector3d& x_world) const {
  const std::optional<Eigen::Vector2d> declared = camera_.project(x_world);
  if (!declared) return std::nullopt;
  // pixel + error(pixel) = declared; the error is smooth and small, so this converges at once
  Eigen::Vector2d pixel = *declared;
  for (int i = 0; i < 4; ++i) pixel = *declared - error_.at(pixel);
  return pixel;
}

}  // namespace plaza::synthetic
