// The samples that people themselves take of a picture.
#include <algorithm>
#include <array>
#include <cmath>

#include "plugins/sources/synthetic/common/pixel_random.h"
#include "plugins/sources/synthetic/render/view_canvas.h"
#include "plugins/sources/synthetic/render/view_renderer.h"

namespace plaza::synthetic {
namespace {

constexpr float kFoldReach = 0.5f;  // the same for a body's own surface

}  // namespace

/// What the samples of a pixel that hit people add up to.
struct ViewRenderer::Cover {
  Rgb radiance = Rgb::Zero();  // with all light
  float light = 0, lost = 0;   // luminance of the light, and of what is kept off
  float depth = 0;             // of the first hit
  std::uint16_t body = 0;
  std::uint8_t hits = 0, taken = 0;
};

/// What a pixel's first sample met.
struct ViewRenderer::First {
  float depth = 0;
  std::uint16_t body = 0;
  bool hit = false;
};

void ViewRenderer::shade(const PeopleScene& people, const LightGains& gains, std::size_t pixel,
                         int x, int y, int sample, std::uint32_t random, Cover& cover) const {
  const int n = view_.samples();
  ++cover.taken;
  const Eigen::Vector2f offset = sample_offset(sample, n);
  const Vec3 d = view_.rays().direction(x, y, offset.x(), offset.y());
  if (d.isZero()) return;
  const float reach =
      view_.depth[pixel * static_cast<std::size_t>(n) + static_cast<std::size_t>(sample)];
  // moments in another order than places, so that moving edges are sampled in both
  const int turn = static_cast<int>((random >> 8) % static_cast<std::uint32_t>(n));
  const std::uint32_t mine = random + 16 * static_cast<std::uint32_t>(sample + 1);
  const auto stratum = [&](int k, std::uint32_t key) {
    return (static_cast<float>(k % n) + to_unit(hash32(key))) / static_cast<float>(n);
  };
  const float time = stratum(sample * 3 + turn, mine);
  const auto hit = people.trace(view_.rays().origin(), d, reach, time);
  if (!hit) return;
  const MovingBody& body = people.bodies()[hit->geometry];
  const BodyPoint at = body_point(body, *hit, view_.rays().origin(), d, time);
  std::array<float, kMostLights + 1> weight{};
  const Rgb ambient = gains.ambient * ambient_.irradiance(at.place, at.normal);
  Rgb light = ambient;
  float total = weight[0] = luminance(ambient);
  for (std::size_t l = 0; l < view_.lights; ++l) {
    weight[l + 1] = gains.direct[l] * lights_.irradiance(l, at.place, at.normal);
    light += weight[l + 1] * lights_.colour(l);
    total += weight[l + 1];
  }
  const float grazing = std::pow(1 - std::clamp(-d.dot(at.normal), 0.0f, 1.0f), 4.0f);
  const Rgb albedo = at.surface->albedo + Rgb::Constant(at.surface->gloss * (0.3f + grazing));
  cover.radiance += albedo.cwiseProduct(light) / kPi;
  cover.light += total;
  if (cover.hits++ == 0) {
    cover.body = static_cast<std::uint16_t>(hit->geometry);
    cover.depth = hit->distance;
  }
  if (!options_.shadows || total <= 0) return;
  float choice = total * stratum(sample * 5 + turn, mine + 1);
  std::size_t which = 0;
  while (which < view_.lights && choice >= weight[which]) choice -= weight[which++];
  // off the surface, on the side the camera sees
  const Vec3 side = hit->normal.dot(d) > 0 ? Vec3(-hit->normal) : hit->normal;
  const Vec3 p = at.place + 6e-3f * side;
  const float a = to_unit(hash32(mine + 2)), b = to_unit(hash32(mine + 3));
  if (which == 0) {
    const Vec3 up = cosine_direction(at.normal, a, b);
    if (up.dot(side) <= 0) return;
    const auto near = people.trace(p, up, kFoldReach, time);
    if (near) cover.lost += 0.8f * total * (1 - near->distance / kFoldReach);
    return;
  }
  const TowardsLight to = lights_.sample(which - 1, p, a, b);
  if (to.direction.dot(side) <= 0 || people.blocked(p, to.direction, to.distance, time) ||
      stage_.blocked(p, to.direction, to.distance)) {
    cover.lost += total;
  }
}

void ViewRenderer::draw_people(const PeopleScene& people, const LightGains& gains,
                               std::uint32_t key, Canvas& canvas) const {
  const int w = view_.width(), n = view_.samples();
  std::vector<Cover> cover(view_.pixels());
  const auto each_covered_pixel = [&](const auto& body) {
    for (int y = 0; y < view_.height(); ++y) {
      for (int x = 0; x < w; ++x) {
        if (canvas.covered[static_cast<std::size_t>((y / kTile) * tiles_x_ + x / kTile)] == 0) {
          x |= kTile - 1;
          continue;
        }
        const auto pixel = static_cast<std::size_t>(y * w + x);
        body(x, y, pixel, hash32(static_cast<std::uint32_t>(pixel) ^ hash32(key)));
      }
    }
  };
  const auto first_sample = [&](std::uint32_t random) {
    return static_cast<int>(random % static_cast<std::uint32_t>(n));
  };
  std::vector<First> first(view_.pixels());
  each_covered_pixel([&](int x, int y, std::size_t pixel, std::uint32_t random) {
    Cover& c = cover[pixel];
    shade(people, gains, pixel, x, y, first_sample(random), random, c);
    if (c.hits > 0) first[pixel] = {.depth = c.depth, .body = c.body, .hit = true};
  });
  // all samples where a body's edge may be, half of them inside of it, none where none is near
  each_covered_pixel([&](int x, int y, std::size_t pixel, std::uint32_t random) {
    int hits = 0, same = 0, seen = 0;
    for (int ny = std::max(0, y - 1); ny <= std::min(view_.height() - 1, y + 1); ++ny) {
      for (int nx = std::max(0, x - 1); nx <= std::min(w - 1, x + 1); ++nx) {
        const First& o = first[static_cast<std::size_t>(ny * w + nx)];
        ++seen;
        if (!o.hit) continue;
        ++hits;
        const First& own = first[pixel];
        if (own.hit && o.body == own.body && std::abs(o.depth - own.depth) < 0.06f) ++same;
      }
    }
    if (hits == 0) return;
    const int step = same == seen ? 2 : 1;
    for (int k = step; k < n; k += step) {
      shade(people, gains, pixel, x, y, (first_sample(random) + k) % n, random, cover[pixel]);
    }
  });
  auto* out = canvas.image.ptr<Vec3>();
  for (int y = 0; y < view_.height(); ++y) {
    for (int x = 0; x < w; ++x) {
      const auto pixel = static_cast<std::size_t>(y * w + x);
      const Cover& c = cover[pixel];
      if (c.hits == 0) continue;
      float light = 0, lost = 0;  // shading is smoothed over the same body nearby, texture is not
      for (int ny = std::max(0, y - 2); ny <= std::min(view_.height() - 1, y + 2); ++ny) {
        for (int nx = std::max(0, x - 2); nx <= std::min(w - 1, x + 2); ++nx) {
          const Cover& o = cover[static_cast<std::size_t>(ny * w + nx)];
          if (o.hits == 0 || o.body != c.body || std::abs(o.depth - c.depth) > 0.06f) continue;
          const float near =
              1.0f / static_cast<float>(1 + (nx - x) * (nx - x) + (ny - y) * (ny - y));
          light += near * o.light;
          lost += near * o.lost;
        }
      }
      const float open = light > 0 ? std::clamp(1 - lost / light, 0.0f, 1.0f) : 1.0f;
      const auto taken = static_cast<float>(c.taken);
      const float share = static_cast<float>(c.hits) / taken;
      out[pixel] = (1 - share) * out[pixel] + (open / taken) * c.radiance;
    }
  }
}

}  // namespace plaza::synthetic
