// What people take from the light of the stage, and what its floors mirror of them.
#include <algorithm>
#include <array>
#include <cmath>

#include "plugins/sources/synthetic/common/pixel_random.h"
#include "plugins/sources/synthetic/render/view_canvas.h"
#include "plugins/sources/synthetic/render/view_renderer.h"

namespace plaza::synthetic {

Rgb ViewRenderer::lost_to_others(const PeopleScene& people, const Vec3& p, const Vec3& n,
                                 std::uint32_t mask, std::uint32_t random,
                                 std::size_t pixel) const {
  Rgb lost = Rgb::Zero();
  const float time = to_unit(hash32(random + 101));
  const float a = to_unit(hash32(random + 102)), b = to_unit(hash32(random + 103));
  if ((mask & 1u) == 0 && people.blocked(p, cosine_direction(n, a, b), kContactReach, time)) {
    lost += view_.ambient[pixel];
  }
  for (std::size_t l = 0; l < view_.lights; ++l) {
    const float light = view_.direct[pixel * view_.lights + l];
    if ((mask & (2u << l)) != 0 || light <= 0) continue;
    const TowardsLight to = lights_.sample(l, p, a, b);
    if (people.blocked(p, to.direction, to.distance, time)) lost += light * lights_.colour(l);
  }
  return lost;
}

void ViewRenderer::cast_shadows(const PeopleScene& people, const LightGains& gains,
                                std::uint32_t key, Canvas& canvas) const {
  const int w = view_.width();
  std::vector<Rgb> lost(view_.pixels(), Rgb::Zero());  // irradiance that people keep off
  std::vector<std::uint8_t> active(view_.pixels(), 0);
  auto* out = canvas.image.ptr<Vec3>();
  std::vector<float> weight(view_.lights + 1);
  for (int y = 0; y < view_.height(); ++y) {
    for (int x = 0; x < w; ++x) {
      const std::uint32_t mask =
          canvas.shaded[static_cast<std::size_t>((y / kTile) * tiles_x_ + x / kTile)];
      if (mask == 0 && !options_.everywhere) continue;
      const auto pixel = static_cast<std::size_t>(y * w + x);
      if (view_.sky(pixel)) continue;
      active[pixel] = 1;
      const Vec3& n = view_.normal[pixel];
      const Vec3 p = view_.point[pixel] + 2e-3f * n;
      const std::uint32_t random = hash32(static_cast<std::uint32_t>(pixel) ^ hash32(key));
      const Rgb ambient = gains.ambient * view_.ambient[pixel];
      if (!lights_.soft()) {
        // the sun's shadows are sharp: all samples of the pixel, and no smoothing
        const float sun = gains.direct[0] * view_.direct[pixel * view_.lights];
        if ((mask & 2u) != 0 && sun > 0) {
          int blocked = 0;
          for (int i = 0; i < view_.samples(); ++i) {
            const std::size_t s =
                pixel * static_cast<std::size_t>(view_.samples()) + static_cast<std::size_t>(i);
            if (view_.depth[s] >= StaticView::kNothing) continue;
            const Eigen::Vector2f at = sample_offset(i, view_.samples());
            const Vec3 q = view_.rays().origin() +
                           view_.depth[s] * view_.rays().direction(x, y, at.x(), at.y()) +
                           2e-3f * n;
            const std::uint32_t mine = random + 16 + 4 * static_cast<std::uint32_t>(i);
            const TowardsLight to =
                lights_.sample(0, q, to_unit(hash32(mine)), to_unit(hash32(mine + 1)));
            const float time = (static_cast<float>(i) + to_unit(hash32(mine + 2))) /
                               static_cast<float>(view_.samples());
            blocked += people.blocked(q, to.direction, to.distance, time) ? 1 : 0;
          }
          if (blocked > 0) {
            const Rgb kept =
                (sun * static_cast<float>(blocked) / static_cast<float>(view_.samples())) *
                lights_.colour(0);
            out[pixel] -= view_.albedo[pixel].cwiseProduct(kept) / kPi;
          }
        }
      }
      if (options_.everywhere) {
        lost[pixel] += lost_to_others(people, p, n, mask, random, pixel);
      }
      float total = 0;
      weight[0] = (mask & 1u) != 0 ? luminance(ambient) : 0.0f;
      total = weight[0];
      for (std::size_t l = 0; l < view_.lights; ++l) {
        const bool wanted = lights_.soft() && (mask & (2u << l)) != 0;
        weight[l + 1] = wanted ? gains.direct[l] * view_.direct[pixel * view_.lights + l] : 0.0f;
        total += weight[l + 1];
      }
      if (total <= 0) continue;
      // neighbours choose different lights: the ranks of a 4 x 4 square, turned at random
      static constexpr std::array<std::uint8_t, 16> kRank = {0, 8,  2, 10, 12, 4, 14, 6,
                                                             3, 11, 1, 9,  15, 7, 13, 5};
      const float rank =
          (static_cast<float>(kRank[static_cast<std::size_t>((y & 3) * 4 + (x & 3))]) +
           to_unit(random)) /
          16;
      float choice = rank * total;
      std::size_t which = 0;
      while (which < view_.lights && (choice >= weight[which] || weight[which] <= 0)) {
        choice -= weight[which];
        ++which;
      }
      if (weight[which] <= 0) continue;
      const float time = to_unit(hash32(random + 1));
      const float a = to_unit(hash32(random + 2)), b = to_unit(hash32(random + 3));
      if (which == 0) {
        const auto hit = people.trace(p, cosine_direction(n, a, b), kContactReach, time);
        if (hit) {
          const float near = 1 - hit->distance * hit->distance / (kContactReach * kContactReach);
          lost[pixel] += ambient * (0.85f * near * total / weight[0]);
        }
      } else {
        const TowardsLight to = lights_.sample(which - 1, p, a, b);
        if (people.blocked(p, to.direction, to.distance, time)) {
          lost[pixel] += total * lights_.colour(which - 1);
        }
      }
    }
  }
  smooth_over_surface(view_, active, 3, lost);
  for (std::size_t pixel = 0; pixel < view_.pixels(); ++pixel) {
    if (active[pixel] == 0) continue;
    out[pixel] = (out[pixel] - view_.albedo[pixel].cwiseProduct(lost[pixel]) / kPi).cwiseMax(0.0f);
  }
}

BodyPoint body_point(const MovingBody& body, const RayHit& hit, const Vec3& origin,
                     const Vec3& direction, float time) {
  BodyPoint out;
  const auto& t = body.mesh->triangles()[hit.triangle];
  const float w = 1 - hit.u - hit.v;
  const auto mean = [&](const std::vector<Vec3>& of) {
    return Vec3(w * of[t[0]] + hit.u * of[t[1]] + hit.v * of[t[2]]);
  };
  out.surface = &body.mesh->surface(hit.triangle, hit.u, hit.v);
  const float c = std::cos(body.heading_rad), s = std::sin(body.heading_rad);
  const Vec3& bump = out.surface->bump;
  out.normal =
      ((1 - time) * mean(body.open_normals) + time * mean(body.close_normals)).normalized();
  out.normal += Vec3(c * bump.x() - s * bump.y(), s * bump.x() + c * bump.y(), bump.z());
  out.normal.normalize();
  out.place = origin + hit.distance * direction;
  return out;
}

void ViewRenderer::mirror_people(const PeopleScene& people, const LightGains& gains,
                                 std::uint32_t key, Canvas& canvas) const {
  const int w = view_.width();
  std::vector<Rgb> change(view_.pixels(), Rgb::Zero());
  std::vector<std::uint8_t> active(view_.pixels(), 0);
  for (int y = 0; y < view_.height(); ++y) {
    for (int x = 0; x < w; ++x) {
      if (canvas.mirrors[static_cast<std::size_t>((y / kTile) * tiles_x_ + x / kTile)] == 0)
        continue;
      const auto pixel = static_cast<std::size_t>(y * w + x);
      if (view_.mirror[pixel] <= 0) continue;
      active[pixel] = 1;
      const std::uint32_t random = hash32(static_cast<std::uint32_t>(pixel) ^ hash32(key));
      const Vec3& n = view_.normal[pixel];
      const Vec3 jitter(to_unit(random) - 0.5f, to_unit(hash32(random + 1)) - 0.5f,
                        to_unit(hash32(random + 2)) - 0.5f);
      const Vec3 micro = (n + 2 * view_.roughness[pixel] * jitter).normalized();
      const Vec3 view = (view_.point[pixel] - view_.rays().origin()).normalized();
      Vec3 d = view - 2 * view.dot(micro) * micro;
      if (d.dot(n) < 0.02f) d = view - 2 * view.dot(n) * n;
      const Vec3 p = view_.point[pixel] + 2e-3f * n;
      const float time = to_unit(hash32(random + 3));
      const auto hit = people.trace(p, d, kMirrorReach, time);
      if (!hit) continue;
      const BodyPoint at = body_point(people.bodies()[hit->geometry], *hit, p, d, time);
      Rgb light = gains.ambient * ambient_.irradiance(at.place, at.normal);
      for (std::size_t l = 0; l < view_.lights; ++l) {
        light += gains.direct[l] * lights_.irradiance(l, at.place, at.normal) * lights_.colour(l);
      }
      change[pixel] = view_.mirror[pixel] * at.surface->albedo.cwiseProduct(light) / kPi -
                      gains.ambient * view_.mirrored[pixel];
    }
  }
  smooth_over_surface(view_, active, 2, change);
  auto* out = canvas.image.ptr<Vec3>();
  for (std::size_t pixel = 0; pixel < view_.pixels(); ++pixel) {
    if (active[pixel] != 0) out[pixel] = (out[pixel] + change[pixel]).cwiseMax(0.0f);
  }
}

}  // namespace plaza::synthetic
