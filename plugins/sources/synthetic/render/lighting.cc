#include "plugins/sources/synthetic/render/lighting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "plugins/sources/synthetic/common/pixel_random.h"

namespace plaza::synthetic {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kFar = 1e4f;
constexpr std::uint32_t kProbeRays = 96;  // per direction of a probe

}  // namespace

void tangent_frame(const Vec3& n, Vec3& u, Vec3& v) {
  // Duff et al., "Building an orthonormal basis, revisited", 2017
  const float sign = std::copysign(1.0f, n.z());
  const float a = -1 / (sign + n.z());
  const float b = n.x() * n.y() * a;
  u = {1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
  v = {b, sign + n.y() * n.y() * a, -n.y()};
}

Vec3 cosine_direction(const Vec3& n, float a, float b) {
  Vec3 u, v;
  tangent_frame(n, u, v);
  const float r = std::sqrt(a);
  const float phi = 2 * kPi * b;
  return r * std::cos(phi) * u + r * std::sin(phi) * v + std::sqrt(std::max(0.0f, 1 - a)) * n;
}

Lights::Lights(std::shared_ptr<const StageModel> stage) : stage_(std::move(stage)) {
  for (const Lamp& lamp : stage_->lamps)
    colours_.push_back(lamp.radiance / luminance(lamp.radiance));
  if (stage_->sun) colours_.push_back(stage_->sun->irradiance / luminance(stage_->sun->irradiance));
}

float Lights::irradiance(std::size_t light, const Vec3& p, const Vec3& n) const {
  if (light >= stage_->lamps.size()) {
    return luminance(stage_->sun->irradiance) * std::max(0.0f, n.dot(stage_->sun->towards));
  }
  const Lamp& lamp = stage_->lamps[light];
  const Vec3 d = lamp.centre - p;
  const float squared = d.squaredNorm();
  // a louvre narrows the beam: radiance falls with the cosine
  const float beam = std::max(0.0f, -lamp.normal.dot(d)) / std::sqrt(squared);
  const float cosines = std::max(0.0f, n.dot(d)) * std::max(0.0f, -lamp.normal.dot(d)) * beam;
  const float area = 4 * lamp.half_u.norm() * lamp.half_v.norm();
  // never more than from right below the lamp's surface
  return luminance(lamp.radiance) * std::min(kPi, area * cosines / (squared * squared));
}

TowardsLight Lights::sample(std::size_t light, const Vec3& p, float a, float b) const {
  TowardsLight out;
  if (light >= stage_->lamps.size()) {
    const Sun& sun = *stage_->sun;
    Vec3 u, v;
    tangent_frame(sun.towards, u, v);
    const float r = std::tan(sun.radius_rad) * std::sqrt(a);
    out.direction =
        (sun.towards + r * std::cos(2 * kPi * b) * u + r * std::sin(2 * kPi * b) * v).normalized();
    out.distance = kFar;
    return out;
  }
  const Lamp& lamp = stage_->lamps[light];
  const Vec3 d = lamp.centre + (2 * a - 1) * lamp.half_u + (2 * b - 1) * lamp.half_v - p;
  out.distance = d.norm();
  out.direction = d / out.distance;
  return out;
}

Eigen::Vector4f Lights::ball(std::size_t light) const {
  if (light >= stage_->lamps.size()) {
    const Vec3 centre = 200.0f * stage_->sun->towards;
    return {centre.x(), centre.y(), centre.z(), 200.0f * stage_->sun->radius_rad};
  }
  const Lamp& lamp = stage_->lamps[light];
  return {lamp.centre.x(), lamp.centre.y(), lamp.centre.z(),
          std::hypot(lamp.half_u.norm(), lamp.half_v.norm())};
}

AmbientField::AmbientField(const StageScene& stage, const Lights& lights)
    : stage_(stage), lights_(lights) {
  const Stage& layout = stage.model().layout;
  const Rectangle reach = layout.walls ? layout.walls->grown(2.2) : layout.area.grown(9);
  const float top = layout.walls ? static_cast<float>(layout.wall_height_m) : 3.0f;
  low_ = {static_cast<float>(reach.low.x()), static_cast<float>(reach.low.y()), 0.15f};
  const Vec3 high(static_cast<float>(reach.high.x()), static_cast<float>(reach.high.y()),
                  top - 0.3f);
  const float spacing = layout.walls ? 0.9f : 3.0f;
  for (int k = 0; k < 3; ++k) {
    size_[k] = std::max(2, static_cast<int>(std::ceil((high[k] - low_[k]) / spacing)) + 1);
    step_[k] = (high[k] - low_[k]) / static_cast<float>(size_[k] - 1);
  }
  // once with direct light alone, for the mean; then with that mean as what has been reflected more
  // than once
  for (int pass = 0; pass < 3; ++pass) {
    cubes_.clear();
    Rgb sum = Rgb::Zero();
    const std::uint32_t rays = pass == 2 ? kProbeRays : 8;
    for (int z = 0; z < size_.z(); ++z) {
      for (int y = 0; y < size_.y(); ++y) {
        for (int x = 0; x < size_.x(); ++x) {
          const Vec3 p =
              low_ + step_.cwiseProduct(
                         Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)));
          Cube& cube = cubes_.emplace_back();
          for (int side = 0; side < 6; ++side) {
            const Vec3 n = (side % 2 == 0 ? 1.0f : -1.0f) * Vec3(Vec3::Unit(side / 2));
            Rgb& total = cube[static_cast<std::size_t>(side)];
            total.setZero();
            for (std::uint32_t i = 0; i < rays; ++i) {
              const std::uint32_t key = hash32(static_cast<std::uint32_t>(cubes_.size() * 6) +
                                               static_cast<std::uint32_t>(side)) +
                                        i * 0x9e3779b9u;
              const float a =
                  (static_cast<float>(i) + to_unit(hash32(key))) / static_cast<float>(rays);
              total += incoming(p, cosine_direction(n, a, to_unit(hash32(key + 1))), key + 2);
            }
            total *= kPi / static_cast<float>(rays);
            sum += total;
          }
        }
      }
    }
    mean_ = sum / static_cast<float>(6 * cubes_.size());
  }
}

Rgb AmbientField::incoming(const Vec3& p, const Vec3& direction, std::uint32_t key) const {
  const StageModel& model = stage_.model();
  const std::optional<RayHit> hit = stage_.trace(p, direction, kFar);
  if (!hit) return model.sky(direction);
  Vec3 n = hit->normal;
  if (n.dot(direction) > 0) n = -n;
  const Vec3 q = p + hit->distance * direction + 1e-3f * n;
  const Rgb albedo = model.mean_albedo(hit->triangle);
  Rgb light = mean_;
  const auto which = std::min(
      lights_.count() - 1,
      static_cast<std::size_t>(to_unit(hash32(key)) * static_cast<float>(lights_.count())));
  const float full = lights_.irradiance(which, q, n);
  if (full > 0) {
    const TowardsLight to =
        lights_.sample(which, q, to_unit(hash32(key + 1)), to_unit(hash32(key + 2)));
    if (!stage_.blocked(q, to.direction, to.distance)) {
      light += static_cast<float>(lights_.count()) * full * lights_.colour(which);
    }
  }
  return albedo.cwiseProduct(light) / kPi;
}

Rgb AmbientField::irradiance(const Vec3& p, const Vec3& n) const {
  Vec3 g = (p - low_).cwiseQuotient(step_);
  Eigen::Vector3i base;
  for (int k = 0; k < 3; ++k) {
    g[k] = std::clamp(g[k], 0.0f, static_cast<float>(size_[k] - 1) - 1e-4f);
    base[k] = std::min(static_cast<int>(g[k]), size_[k] - 2);
    g[k] -= static_cast<float>(base[k]);
  }
  const Vec3 squared = n.cwiseProduct(n);
  Rgb sum = Rgb::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    float weight = 1;
    Eigen::Vector3i at = base;
    for (int k = 0; k < 3; ++k) {
      const bool upper = ((corner >> k) & 1) != 0;
      weight *= upper ? g[k] : 1 - g[k];
      at[k] += upper ? 1 : 0;
    }
    const auto index = static_cast<std::size_t>((at.z() * size_.y() + at.y()) * size_.x() + at.x());
    const Cube& cube = cubes_[index];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      sum += weight * squared[axis] * cube[2 * k + (n[axis] < 0 ? 1 : 0)];
    }
  }
  return sum;
}

}  // namespace plaza::synthetic
