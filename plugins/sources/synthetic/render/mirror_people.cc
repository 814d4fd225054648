// What glossy floors mirror of people.
#include <array>

#include "plugins/sources/synthetic/common/pixel_random.h"
#include "plugins/sources/synthetic/render/view_canvas.h"
#include "plugins/sources/synthetic/render/view_renderer.h"

namespace plaza::synthetic {
namespace {

constexpr int kSmoothing = 3;  // px

}  // namespace

RayQuery ViewRenderer::mirrored_ray(std::size_t pixel, std::uint32_t random) const {
  const Vec3& n = view_.normal[pixel];
  const Vec3 jitter(to_unit(random) - 0.5f, to_unit(hash32(random + 1)) - 0.5f,
                    to_unit(hash32(random + 2)) - 0.5f);
  const Vec3 micro = (n + 2 * view_.roughness[pixel] * jitter).normalized();
  const Vec3 view = (view_.point[pixel] - view_.rays().origin()).normalized();
  RayQuery ray;
  ray.direction = view - 2 * view.dot(micro) * micro;
  if (ray.direction.dot(n) < 0.02f) ray.direction = view - 2 * view.dot(n) * n;
  ray.origin = view_.point[pixel] + 2e-3f * n;
  ray.reach = kMirrorReach;
  ray.time = to_unit(hash32(random + 3));
  return ray;
}

void ViewRenderer::mirror_people(const PeopleScene& people, const LightGains& gains,
                                 std::uint32_t key, Canvas& canvas) const {
  // what is mirrored is faint and blurred: one pixel of 2 x 2 looks, w counts them; and only one of
  // 4 x 4 where none of these sees anybody
  std::vector<Rgbw> change(view_.pixels(), Rgbw::Zero());
  std::vector<std::uint8_t> seen(grid_.count(), 0);
  std::vector<std::size_t> pixels;
  std::vector<RayQuery> queries;
  std::array<std::optional<RayHit>, kTilePixels> hits;
  const std::uint32_t mixed = hash32(key);
  const auto look = [&](std::size_t tile, bool first) {
    pixels.clear();
    queries.clear();
    grid_.each_pixel(tile, [&](int x, int y, std::size_t pixel) {
      if (!is_scout(x, y) || is_forerunner(x, y) != first || view_.mirror[pixel] <= 0) return;
      queries.push_back(mirrored_ray(pixel, hash32(static_cast<std::uint32_t>(pixel) ^ mixed)));
      pixels.push_back(pixel);
    });
    people.trace(queries, hits);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (!hits[i]) continue;
      seen[tile] = 1;
      const std::size_t pixel = pixels[i];
      const BodyPoint at = body_point(people.bodies()[hits[i]->geometry], *hits[i],
                                      queries[i].origin, queries[i].direction);
      Rgb light = gains.ambient * ambient_.irradiance(at.place, at.normal);
      for (std::size_t l = 0; l < view_.lights; ++l) {
        light += gains.direct_at(l, at.place) * lights_.irradiance(l, at.place, at.normal) *
                 lights_.colour(l);
      }
      change[pixel].head<3>() = view_.mirror[pixel] * at.surface.albedo.cwiseProduct(light) / kPi -
                                gains.ambient * view_.mirrored[pixel];
    }
  };
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (canvas.mirrors[tile] != 0) look(tile, true);
  }
  const std::vector<std::uint8_t> nearby = grid_.with_neighbours(seen);
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (canvas.mirrors[tile] != 0 && nearby[tile] != 0) look(tile, false);
  }
  // pixels that look share out what they see among those that don't, on the same surface
  const std::vector<std::uint8_t> around = grid_.with_neighbours(seen);
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (around[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int x, int y, std::size_t pixel) {
      if (is_scout(x, y) && view_.mirror[pixel] > 0) change[pixel].w() = 1;
    });
  }
  const std::vector<std::uint8_t> changed = view_.smoother().smooth(kSmoothing, around, change);
  auto* out = canvas.image.ptr<Vec3>();
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (changed[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int, int, std::size_t pixel) {
      const Rgbw& c = change[pixel];
      if (c.w() <= 0 || view_.mirror[pixel] <= 0) return;
      out[pixel] = (out[pixel] + Rgb(c.head<3>() / c.w())).cwiseMax(0.0f);
    });
  }
}

}  // namespace plaza::synthetic
