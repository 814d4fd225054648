#include "plugins/sources/synthetic/render/static_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plugins/sources/synthetic/common/pixel_random.h"

namespace plaza::synthetic {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr std::uint32_t kAmbientRays = 8;
constexpr std::uint32_t kMirrorRays = 6;
constexpr std::uint32_t kShadowRays = 4;

/// Lamps are no triangles; in a mirror they are seen all the same.
Rgb lamps_along(const StageModel& model, const Vec3& p, const Vec3& direction, float reach) {
  Rgb sum = Rgb::Zero();
  for (const Lamp& lamp : model.lamps) {
    const float cosine = direction.dot(lamp.normal);
    if (cosine >= 0) continue;
    const float t = (lamp.centre - p).dot(lamp.normal) / cosine;
    if (t <= 0 || t > reach + 0.1f) continue;
    const Vec3 q = p + t * direction - lamp.centre;
    if (std::abs(q.dot(lamp.half_u)) <= lamp.half_u.squaredNorm() &&
        std::abs(q.dot(lamp.half_v)) <= lamp.half_v.squaredNorm()) {
      sum += lamp.radiance;
    }
  }
  return sum;
}

/// Hammersley's points.
Eigen::Vector2f offset_of(int i, int n) {
  float radical = 0, scale = 0.5f;
  for (int k = i; k > 0; k /= 2) {
    radical += scale * static_cast<float>(k % 2);
    scale *= 0.5f;
  }
  const auto count = static_cast<float>(n);
  return {(static_cast<float>(i) + 0.5f) / count, std::fmod(radical + 0.5f / count, 1.0f)};
}

}  // namespace

StaticView::StaticView(const PixelRays& rays, const StageScene& stage, const Lights& lights_of,
                       const AmbientField& field, int samples, std::uint32_t seed)
    : lights(lights_of.count()), rays_(rays), samples_(samples) {
  const std::size_t count = static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  const auto n = static_cast<std::size_t>(samples);
  for (int i = 0; i < samples; ++i) offsets_.push_back(offset_of(i, samples));
  depth.assign(count * n, kNothing);
  sample_albedo_.assign(count * n, Rgb::Zero());
  sample_part_.assign(count * n, ~0u);
  point.assign(count, Vec3::Zero());
  normal.assign(count, Vec3::Zero());
  part.assign(count, ~0u);
  albedo.assign(count, Rgb::Zero());
  ambient.assign(count, Rgb::Zero());
  direct.assign(count * lights, 0.0f);
  mirrored.assign(count, Rgb::Zero());
  mirror.assign(count, 0.0f);
  roughness.assign(count, 0.0f);
  trace_samples(stage);
  smoother_ = std::make_unique<const SurfaceSmoother>(*this);
  light(stage, lights_of, field, seed);
  blend_edges();
  sample_albedo_ = {};
  sample_part_ = {};
}

void StaticView::trace_samples(const StageScene& stage) {
  const StageModel& model = stage.model();
  std::size_t pixel = 0;
  for (int y = 0; y < height(); ++y) {
    for (int x = 0; x < width(); ++x, ++pixel) {
      Rgb beyond = Rgb::Zero();
      for (int i = 0; i < samples_; ++i) {
        const std::size_t at =
            pixel * static_cast<std::size_t>(samples_) + static_cast<std::size_t>(i);
        const Eigen::Vector2f& offset = sample_offset(i);
        const Vec3 d = rays_.direction(x, y, offset.x(), offset.y());
        if (d.isZero()) continue;
        const auto hit = stage.trace(rays_.origin(), d, kNothing);
        if (!hit) {
          beyond += model.sky(d);
          continue;
        }
        depth[at] = hit->distance;
        const Vec3 n = hit->normal.dot(d) > 0 ? Vec3(-hit->normal) : hit->normal;
        sample_albedo_[at] =
            model.look(hit->triangle, rays_.origin() + hit->distance * d, n).albedo;
        sample_part_[at] = model.parts[hit->triangle];
      }
      mirrored[pixel] = beyond / static_cast<float>(samples_);
      const Vec3 d = rays_.direction(x, y, 0.5f, 0.5f);
      const auto hit = d.isZero() ? std::nullopt : stage.trace(rays_.origin(), d, kNothing);
      if (!hit) continue;
      point[pixel] = rays_.origin() + hit->distance * d;
      normal[pixel] = hit->normal.dot(d) > 0 ? Vec3(-hit->normal) : hit->normal;
      part[pixel] = model.parts[hit->triangle];
      const SurfaceLook look = model.look(hit->triangle, point[pixel], normal[pixel]);
      const float facing = std::clamp(-d.dot(normal[pixel]), 0.0f, 1.0f);
      if (look.mirror > 0 && normal[pixel].z() > 0.7f) {  // floors and table tops
        mirror[pixel] = look.mirror + (1 - look.mirror) * std::pow(1 - facing, 5.0f);
        roughness[pixel] = look.roughness;
      }
    }
  }
}

void StaticView::light(const StageScene& stage, const Lights& lights_of, const AmbientField& field,
                       std::uint32_t seed) {
  std::vector<Rgbw> reflected(pixels(), Rgbw::Zero()), gleam(reflected), shadow(reflected);
  for (std::size_t l = 0; l < lights; ++l) {
    std::fill(shadow.begin(), shadow.end(), Rgbw::Zero());
    for (std::size_t pixel = 0; pixel < pixels(); ++pixel) {
      if (sky(pixel)) continue;
      const Vec3 p = point[pixel] + 1e-3f * normal[pixel];
      const float full = lights_of.irradiance(l, p, normal[pixel]);
      direct[pixel * lights + l] = full;
      if (full <= 0) continue;
      const std::uint32_t key = hash32(static_cast<std::uint32_t>(pixel * lights + l) ^ seed);
      float open = 0;
      for (std::uint32_t k = 0; k < kShadowRays; ++k) {
        const float a = (static_cast<float>(k) + to_unit(hash32(key + 2 * k))) / kShadowRays;
        const TowardsLight to = lights_of.sample(l, p, a, to_unit(hash32(key + 2 * k + 1)));
        if (!stage.blocked(p, to.direction, to.distance)) open += 1.0f / kShadowRays;
      }
      shadow[pixel].w() = 1 - open;
    }
    if (lights_of.soft()) smoother_->smooth(2, shadow);
    for (std::size_t pixel = 0; pixel < pixels(); ++pixel) {
      direct[pixel * lights + l] *= 1 - shadow[pixel].w();
    }
  }
  for (std::size_t pixel = 0; pixel < pixels(); ++pixel) {
    if (sky(pixel)) continue;
    const Vec3& n = normal[pixel];
    const Vec3 p = point[pixel] + 1e-3f * n;
    const std::uint32_t key = hash32(static_cast<std::uint32_t>(pixel) ^ hash32(seed + 1));
    for (std::uint32_t k = 0; k < kAmbientRays; ++k) {
      const float a = (static_cast<float>(k) + to_unit(hash32(key + 8 * k))) / kAmbientRays;
      const Vec3 d = cosine_direction(n, a, to_unit(hash32(key + 8 * k + 1)));
      reflected[pixel].head<3>() += field.incoming(p, d, key + 8 * k + 2) * (kPi / kAmbientRays);
    }
    if (mirror[pixel] <= 0) continue;
    const Vec3 view = (point[pixel] - rays_.origin()).normalized();
    for (std::uint32_t k = 0; k < kMirrorRays; ++k) {
      const std::uint32_t mine = key + 64 + 8 * k;
      Vec3 jitter(to_unit(hash32(mine)) - 0.5f, to_unit(hash32(mine + 1)) - 0.5f,
                  to_unit(hash32(mine + 2)) - 0.5f);
      const Vec3 micro = (n + 2 * roughness[pixel] * jitter).normalized();
      Vec3 d = view - 2 * view.dot(micro) * micro;
      if (d.dot(n) < 0.02f) d = view - 2 * view.dot(n) * n;
      const auto hit = stage.trace(p, d, kNothing);
      gleam[pixel].head<3>() += (mirror[pixel] / kMirrorRays) *
                                (field.incoming(p, d, mine + 3) +
                                 lamps_along(stage.model(), p, d, hit ? hit->distance : kNothing));
    }
  }
  for (int twice = 0; twice < 2; ++twice) {  // close to a bell
    smoother_->smooth(6, reflected);
    smoother_->smooth(3, gleam);
  }
  for (std::size_t pixel = 0; pixel < pixels(); ++pixel) {
    ambient[pixel] = reflected[pixel].head<3>();
    mirrored[pixel] += gleam[pixel].head<3>();
  }
}

/// At the border between two things each sample is lit as its own thing is nearby.
void StaticView::blend_edges() {
  const auto n = static_cast<std::size_t>(samples_);
  const auto white = [&](std::size_t pixel) {
    Rgb e = ambient[pixel];
    for (std::size_t l = 0; l < lights; ++l) e += Rgb::Constant(direct[pixel * lights + l]);
    return e;
  };
  std::size_t pixel = 0;
  for (int y = 0; y < height(); ++y) {
    for (int x = 0; x < width(); ++x, ++pixel) {
      if (sky(pixel)) {
        // the centre sees the sky, samples may not: their light is added as if it were the sky's
        continue;
      }
      Rgb sum = Rgb::Zero();
      const Rgb own = white(pixel);
      for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t of = sample_part_[pixel * n + i];
        Rgb lit = own;
        if (of != part[pixel] && of != ~0u) {
          for (int k = 0; k < 9; ++k) {
            const int nx = x + k % 3 - 1, ny = y + k / 3 - 1;
            if (nx < 0 || ny < 0 || nx >= width() || ny >= height()) continue;
            const std::size_t other =
                static_cast<std::size_t>(ny) * static_cast<std::size_t>(width()) +
                static_cast<std::size_t>(nx);
            if (part[other] == of) {
              lit = white(other);
              break;
            }
          }
        }
        sum += sample_albedo_[pixel * n + i].cwiseProduct(lit);
      }
      albedo[pixel] = sum.cwiseQuotient(own.cwiseMax(1e-6f)) / static_cast<float>(n);
    }
  }
}

}  // namespace plaza::synthetic
