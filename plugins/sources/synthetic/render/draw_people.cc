// The samples that people themselves take of a picture.
#include <algorithm>
#include <array>
#include <cmath>

#include "plugins/sources/synthetic/common/pixel_random.h"
#include "plugins/sources/synthetic/render/view_canvas.h"
#include "plugins/sources/synthetic/render/view_renderer.h"

namespace plaza::synthetic {
namespace {

constexpr float kFoldReach = 0.5f;   // kContactReach for a body's own surface
constexpr float kSameDepth = 0.06f;  // metres between samples of one surface in neighbouring pixels

}  // namespace

/// What the samples of a pixel that hit people add up to.
struct ViewRenderer::Cover {
  Rgb radiance = Rgb::Zero();    // with all light
  Rgb irradiance = Rgb::Zero();  // of the last sample that was lit, by all light
  float light = 0, lost = 0;     // luminance of the light, and of what is kept off
  float depth = 0;               // of the first hit
  float grazing = 0;             // how far from along the normal that one was seen, to the fourth
  float lit_depth = 0;           // of the last sample that was lit
  std::uint16_t body = 0, lit_body = 0;
  std::uint8_t hits = 0, taken = 0;
};

/// Samples that are taken at once.
struct ViewRenderer::Batch {
  struct Sample {
    std::size_t pixel = 0;
    std::uint32_t random = 0;
    float rank = 0;
  };
  std::vector<RayQuery> rays;
  std::vector<Sample> samples;
  std::vector<std::optional<RayHit>> hits;
};

BodyPoint body_point(const MovingBody& body, const RayHit& hit, const Vec3& origin,
                     const Vec3& direction) {
  BodyPoint out;
  const auto& t = body.mesh->triangles()[hit.triangle];
  const float w = 1 - hit.u - hit.v;
  out.surface = body.mesh->surface(hit.triangle, hit.u, hit.v);
  const Vec3& bump = out.surface.bump;
  const float c = body.heading.x(), s = body.heading.y();
  out.normal = (w * body.normals[t[0]] + hit.u * body.normals[t[1]] + hit.v * body.normals[t[2]])
                   .normalized();
  out.normal += Vec3(c * bump.x() - s * bump.y(), s * bump.x() + c * bump.y(), bump.z());
  out.normal.normalize();
  out.place = origin + hit.distance * direction;
  return out;
}

void ViewRenderer::aim_at_people(std::size_t pixel, int x, int y, int sample, std::uint32_t random,
                                 Batch& batch) const {
  const int n = view_.samples();
  const Eigen::Vector2f& offset = view_.sample_offset(sample);
  RayQuery ray;
  ray.origin = view_.rays().origin();
  ray.direction = view_.rays().direction(x, y, offset.x(), offset.y());
  // where the lens shows nothing a ray without reach stands for the sample
  ray.reach =
      ray.direction.isZero(0)
          ? 0
          : view_.depth[pixel * static_cast<std::size_t>(n) + static_cast<std::size_t>(sample)];
  if (ray.reach == 0) ray.direction = Vec3::UnitZ();
  // moments in another order than places, so that moving edges are sampled in both
  const int turn = static_cast<int>((random >> 8) % static_cast<std::uint32_t>(n));
  const std::uint32_t mine = random + 16 * static_cast<std::uint32_t>(sample + 1);
  ray.time =
      (static_cast<float>((sample * 3 + turn) % n) + to_unit(hash32(mine))) / static_cast<float>(n);
  batch.rays.push_back(ray);
  batch.samples.push_back(
      {.pixel = pixel,
       .random = mine,
       .rank = (static_cast<float>(rank_in_square(x, y)) + to_unit(hash32(mine + 1))) / 16});
}

void ViewRenderer::take(const PeopleScene& people, const LightGains& gains, Batch& batch,
                        std::vector<Cover>& cover) const {
  batch.hits.resize(batch.rays.size());
  people.trace(batch.rays, batch.hits);
  for (std::size_t i = 0; i < batch.rays.size(); ++i) {
    const Batch::Sample& sample = batch.samples[i];
    Cover& c = cover[sample.pixel];
    ++c.taken;
    if (batch.hits[i]) {
      shade(people, gains, batch.rays[i], *batch.hits[i], sample.rank, sample.random, c);
    }
  }
  batch.rays.clear();
  batch.samples.clear();
}

void ViewRenderer::shade(const PeopleScene& people, const LightGains& gains, const RayQuery& ray,
                         const RayHit& hit, float rank, std::uint32_t random, Cover& cover) const {
  const MovingBody& body = people.bodies()[hit.geometry];
  const auto index = static_cast<std::uint16_t>(hit.geometry);
  const auto albedo = [&](const BodySurface& surface) {
    return Rgb(surface.albedo + Rgb::Constant(surface.gloss * (0.3f + cover.grazing)));
  };
  if (cover.hits++ == 0) {
    cover.body = index;
    cover.depth = hit.distance;
  } else if (cover.lit_body == index && std::abs(cover.lit_depth - hit.distance) < kSameDepth) {
    // texture differs between samples of a pixel, light hardly
    const BodySurface surface = body.mesh->surface(hit.triangle, hit.u, hit.v);
    cover.radiance += albedo(surface).cwiseProduct(cover.irradiance) / kPi;
    return;
  }
  const BodyPoint at = body_point(body, hit, ray.origin, ray.direction);
  const float slant = 1 - std::clamp(-ray.direction.dot(at.normal), 0.0f, 1.0f);
  cover.grazing = slant * slant * slant * slant;
  std::array<float, kMostLights + 1> weight;
  cover.irradiance = gains.ambient * ambient_.irradiance(at.place, at.normal);
  float total = weight[0] = luminance(cover.irradiance);
  for (std::size_t l = 0; l < view_.lights; ++l) {
    weight[l + 1] = gains.direct_at(l, at.place) * lights_.irradiance(l, at.place, at.normal);
    cover.irradiance += weight[l + 1] * lights_.colour(l);
    total += weight[l + 1];
  }
  cover.lit_body = index;
  cover.lit_depth = hit.distance;
  cover.radiance += albedo(at.surface).cwiseProduct(cover.irradiance) / kPi;
  cover.light += total;
  if (!options_.shadows || total <= 0) return;
  float choice = total * rank;
  std::size_t which = 0;
  while (which < view_.lights && choice >= weight[which]) choice -= weight[which++];
  // off the surface, on the side the camera sees
  const Vec3 side = hit.normal.dot(ray.direction) > 0 ? Vec3(-hit.normal) : hit.normal;
  const Vec3 p = at.place + 6e-3f * side;
  const float a = to_unit(hash32(random + 2)), b = to_unit(hash32(random + 3));
  if (which == 0) {
    const Vec3 up = cosine_direction(at.normal, a, b);
    if (up.dot(side) <= 0) return;
    const auto near = people.trace(p, up, kFoldReach, ray.time);
    if (near) cover.lost += 0.8f * total * (1 - near->distance / kFoldReach);
    return;
  }
  const TowardsLight to = lights_.sample(which - 1, p, a, b);
  if (to.direction.dot(side) <= 0 || people.blocked(p, to.direction, to.distance, ray.time) ||
      stage_.blocked(p, to.direction, to.distance)) {
    cover.lost += total;
  }
}

void ViewRenderer::draw_people(const PeopleScene& people, const LightGains& gains,
                               std::uint32_t key, Canvas& canvas) const {
  const int w = view_.width(), h = view_.height(), n = view_.samples();
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
  };
  const std::uint32_t mixed = hash32(key);
  const auto random_of = [&](std::size_t pixel) {
    return hash32(static_cast<std::uint32_t>(pixel) ^ mixed);
  };
  const auto first_sample = [&](std::uint32_t random) {
    return static_cast<int>(random % static_cast<std::uint32_t>(n));
  };
  std::vector<Cover> cover(view_.pixels());
  std::vector<std::uint8_t> met(grid_.count(), 0);
  Batch batch;
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (canvas.covered[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int x, int y, std::size_t pixel) {
      const std::uint32_t random = random_of(pixel);
      aim_at_people(pixel, x, y, first_sample(random), random, batch);
    });
    take(people, gains, batch, cover);
    grid_.each_pixel(tile, [&](int, int, std::size_t pixel) {
      if (cover[pixel].hits > 0) met[tile] = 1;
    });
  }
  // all samples where a body's edge may be, half of them inside of it, none where none is near
  struct First {
    float depth = 0;
    std::uint16_t body = 0;
    bool hit = false;
  };
  std::vector<First> first(view_.pixels());
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (met[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int, int, std::size_t pixel) {
      const Cover& c = cover[pixel];
      if (c.hits > 0) first[pixel] = {.depth = c.depth, .body = c.body, .hit = true};
    });
  }
  const std::vector<std::uint8_t> nearby = grid_.with_neighbours(met);
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (nearby[tile] == 0 || canvas.covered[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int x, int y, std::size_t pixel) {
      int hits = 0, same = 0, seen = 0;
      const First& own = first[pixel];
      for (int ny = std::max(0, y - 1); ny <= std::min(h - 1, y + 1); ++ny) {
        for (int nx = std::max(0, x - 1); nx <= std::min(w - 1, x + 1); ++nx) {
          const First& o = first[at(nx, ny)];
          ++seen;
          if (!o.hit) continue;
          ++hits;
          if (own.hit && o.body == own.body && std::abs(o.depth - own.depth) < kSameDepth) ++same;
        }
      }
      if (hits == 0) return;
      const std::uint32_t random = random_of(pixel);
      const int step = same == seen ? 2 : 1;
      for (int k = step; k < n; k += step) {
        aim_at_people(pixel, x, y, (first_sample(random) + k) % n, random, batch);
      }
    });
    take(people, gains, batch, cover);
  }
  auto* out = canvas.image.ptr<Vec3>();
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (nearby[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int x, int y, std::size_t pixel) {
      const Cover& c = cover[pixel];
      if (c.hits == 0) return;
      float light = 0, lost = 0;  // shading is smoothed over the same body nearby, texture is not
      for (int ny = std::max(0, y - 2); ny <= std::min(h - 1, y + 2); ++ny) {
        for (int nx = std::max(0, x - 2); nx <= std::min(w - 1, x + 2); ++nx) {
          const Cover& o = cover[at(nx, ny)];
          if (o.hits == 0 || o.body != c.body || std::abs(o.depth - c.depth) > kSameDepth) continue;
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
    });
  }
}

}  // namespace plaza::synthetic
