// What people take from the light of the stage.
#include <algorithm>
#include <array>
#include <cmath>

#include "plugins/sources/synthetic/common/pixel_random.h"
#include "plugins/sources/synthetic/render/view_canvas.h"
#include "plugins/sources/synthetic/render/view_renderer.h"

namespace plaza::synthetic {
namespace {

constexpr int kSmoothing = 4;  // px
constexpr int kDark = 2;       // blocked rays of scouts that call for more

/// The pixel of a square of 2 x 2 that lies across from the scout.
bool is_second(int x, int y) { return is_scout(x ^ 1, y ^ 1); }

}  // namespace

/// Light that people keep off the stage: irradiance by pixel, and the rays that find it.
struct ViewRenderer::Shade {
  const PeopleScene& people;
  const LightGains& gains;
  std::uint32_t key;
  std::vector<Rgbw> lost;  // w counts the rays

  // of one tile
  std::vector<RayQuery> towards_light = {}, around = {};
  std::vector<std::pair<std::size_t, Rgb>> light = {}, near = {};  // pixel, what a ray may find
};

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

void ViewRenderer::aim_at_light(std::uint32_t mask, int x, int y, std::size_t pixel,
                                Shade& shade) const {
  std::array<float, kMostLights + 1> weight;
  weight[0] = (mask & 1u) != 0 ? shade.gains.ambient * luminance(view_.ambient[pixel]) : 0.0f;
  float total = weight[0];
  const float left = shade.gains.shadow.left(view_.point[pixel]);
  for (std::size_t l = 0; l < view_.lights; ++l) {
    const bool wanted = lights_.soft() && (mask & (2u << l)) != 0;
    weight[l + 1] =
        wanted ? left * shade.gains.direct[l] * view_.direct[pixel * view_.lights + l] : 0.0f;
    total += weight[l + 1];
  }
  if (total <= 0) return;
  // neighbours choose different lights: the scouts of a square one of each quarter of the light,
  // and so do the seconds
  const std::uint32_t random = hash32(static_cast<std::uint32_t>(pixel) ^ shade.key);
  const int quarter = rank_in_square(x, y) / 4;
  float choice = 0.25f * (static_cast<float>(quarter) + to_unit(random)) * total;
  std::size_t which = 0;
  while (which < view_.lights && (choice >= weight[which] || weight[which] <= 0)) {
    choice -= weight[which];
    ++which;
  }
  if (weight[which] <= 0) return;
  const Vec3& n = view_.normal[pixel];
  RayQuery ray;
  ray.origin = view_.point[pixel] + 2e-3f * n;
  ray.time = to_unit(hash32(random + 1));
  const float a = to_unit(hash32(random + 2)), b = to_unit(hash32(random + 3));
  if (which == 0) {
    ray.direction = cosine_direction(n, a, b);
    ray.reach = kContactReach;
    shade.around.push_back(ray);
    shade.near.emplace_back(
        pixel, view_.ambient[pixel] * (shade.gains.ambient * 0.85f * total / weight[0]));
  } else {
    const TowardsLight to = lights_.sample(which - 1, ray.origin, a, b);
    ray.direction = to.direction;
    ray.reach = to.distance;
    shade.towards_light.push_back(ray);
    shade.light.emplace_back(pixel, total * lights_.colour(which - 1));
  }
}

int ViewRenderer::shoot(Shade& shade) const {
  int count = 0;
  std::array<std::uint8_t, kTilePixels> blocked;
  shade.people.blocked(shade.towards_light, blocked);
  for (std::size_t i = 0; i < shade.light.size(); ++i) {
    if (blocked[i] == 0) continue;
    shade.lost[shade.light[i].first].head<3>() += shade.light[i].second;
    ++count;
  }
  std::array<std::optional<RayHit>, kTilePixels> hits;
  shade.people.trace(shade.around, hits);
  for (std::size_t i = 0; i < shade.near.size(); ++i) {
    if (!hits[i]) continue;
    const float far = hits[i]->distance / kContactReach;
    shade.lost[shade.near[i].first].head<3>() += (1 - far * far) * shade.near[i].second;
    ++count;
  }
  shade.towards_light.clear();
  shade.around.clear();
  shade.light.clear();
  shade.near.clear();
  return count;
}

void ViewRenderer::cast_sun(const PeopleScene& people, const LightGains& gains, std::uint32_t key,
                            int x, int y, std::size_t pixel, cv::Mat& image) const {
  const float sun = gains.direct_at(0, view_.point[pixel]) * view_.direct[pixel * view_.lights];
  if (sun <= 0) return;
  const std::uint32_t random = hash32(static_cast<std::uint32_t>(pixel) ^ key);
  const Vec3 off = 2e-3f * view_.normal[pixel];
  int blocked = 0;
  for (int i = 0; i < view_.samples(); ++i) {
    const std::size_t s =
        pixel * static_cast<std::size_t>(view_.samples()) + static_cast<std::size_t>(i);
    if (view_.depth[s] >= StaticView::kNothing) continue;
    const Eigen::Vector2f at = view_.sample_offset(i);
    const Vec3 q =
        view_.rays().origin() + view_.depth[s] * view_.rays().direction(x, y, at.x(), at.y()) + off;
    const std::uint32_t mine = random + 16 + 4 * static_cast<std::uint32_t>(i);
    const TowardsLight to = lights_.sample(0, q, to_unit(hash32(mine)), to_unit(hash32(mine + 1)));
    const float time =
        (static_cast<float>(i) + to_unit(hash32(mine + 2))) / static_cast<float>(view_.samples());
    blocked += people.blocked(q, to.direction, to.distance, time) ? 1 : 0;
  }
  if (blocked == 0) return;
  const Rgb kept =
      (sun * static_cast<float>(blocked) / static_cast<float>(view_.samples())) * lights_.colour(0);
  image.ptr<Vec3>()[pixel] -= view_.albedo[pixel].cwiseProduct(kept) / kPi;
}

void ViewRenderer::cast_shadows(const PeopleScene& people, const LightGains& gains,
                                std::uint32_t key, Canvas& canvas) const {
  Shade shade{.people = people,
              .gains = gains,
              .key = hash32(key),
              .lost = std::vector<Rgbw>(view_.pixels(), Rgbw::Zero())};
  // a quarter of the pixels, and half of them around where these find more than a trace of shadow
  std::vector<std::uint8_t> shaded(grid_.count(), 0), dark(grid_.count(), 0);
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    const std::uint32_t mask = canvas.shaded[tile];
    if (mask == 0 && !options_.everywhere) continue;
    grid_.each_pixel(tile, [&](int x, int y, std::size_t pixel) {
      if (view_.sky(pixel)) return;
      if (options_.everywhere) {
        const Vec3& n = view_.normal[pixel];
        shade.lost[pixel].head<3>() +=
            lost_to_others(people, view_.point[pixel] + 2e-3f * n, n, mask,
                           hash32(static_cast<std::uint32_t>(pixel) ^ shade.key), pixel);
        if (!shade.lost[pixel].isZero(0)) shaded[tile] = 1;
      }
      // the sun's shadows are sharp: all samples of the pixel, and no smoothing
      if (!lights_.soft() && (mask & 2u) != 0) {
        cast_sun(people, gains, shade.key, x, y, pixel, canvas.image);
      }
      if (is_scout(x, y)) aim_at_light(mask, x, y, pixel, shade);
    });
    const int blocked = shoot(shade);
    if (blocked > 0) shaded[tile] = 1;
    if (blocked >= kDark) dark[tile] = 1;
  }
  const std::vector<std::uint8_t> around_dark = grid_.with_neighbours(dark);
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (around_dark[tile] == 0 || canvas.shaded[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int x, int y, std::size_t pixel) {
      if (is_second(x, y) && !view_.sky(pixel)) {
        aim_at_light(canvas.shaded[tile], x, y, pixel, shade);
      }
    });
    if (shoot(shade) > 0) shaded[tile] = 1;
  }
  const std::vector<std::uint8_t> around = grid_.with_neighbours(shaded);
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (around[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int x, int y, std::size_t pixel) {
      if (is_scout(x, y) || (around_dark[tile] != 0 && is_second(x, y))) shade.lost[pixel].w() = 1;
    });
  }
  const std::vector<std::uint8_t> changed = view_.smoother().smooth(kSmoothing, around, shade.lost);
  auto* out = canvas.image.ptr<Vec3>();
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    if (changed[tile] == 0) continue;
    grid_.each_pixel(tile, [&](int, int, std::size_t pixel) {
      const Rgbw& lost = shade.lost[pixel];
      if (lost.w() <= 0) return;
      const Rgb kept = view_.albedo[pixel].cwiseProduct(lost.head<3>()) / (kPi * lost.w());
      out[pixel] = (out[pixel] - kept).cwiseMax(0.0f);
    });
  }
}

}  // namespace plaza::synthetic
