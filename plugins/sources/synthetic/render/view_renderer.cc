#include "plugins/sources/synthetic/render/view_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plaza/core/error.h"
#include "plugins/sources/synthetic/common/pixel_random.h"

namespace plaza::synthetic {
namespace {

constexpr int kTile = 8;
constexpr std::size_t kMostLights = 8;
constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kContactReach = 1.1f;  // metres over which a body darkens what is near
constexpr float kMirrorReach = 3.0f;   // metres over which a floor mirrors a body
constexpr float kFoldReach = 0.5f;     // the same for a body's own surface

/// A ball around what moves of a body in one exposure: of the whole, or of one segment.
using Ball = Eigen::Vector4f;

struct BodyBalls {
  Ball whole;
  std::vector<Ball> segments;
  std::array<Eigen::AlignedBox3f, kSegmentCount> boxes;
};

Ball ball_of(const Eigen::AlignedBox3f& box) {
  const Vec3 c = box.center();
  return {c.x(), c.y(), c.z(), 0.5f * box.diagonal().norm()};
}

BodyBalls balls_of(const MovingBody& body) {
  BodyBalls out;
  Eigen::AlignedBox3f whole;
  const auto& segment = body.mesh->main_segment();
  for (std::size_t v = 0; v < body.open.size(); ++v) {
    out.boxes[segment[v]].extend(body.open[v]);
    out.boxes[segment[v]].extend(body.close[v]);
  }
  for (auto& box : out.boxes) {
    if (box.isEmpty()) continue;
    // triangles reach from one segment's vertices to the next one's
    box.min() -= Vec3::Constant(0.03f);
    box.max() += Vec3::Constant(0.03f);
    whole.extend(box);
    out.segments.push_back(ball_of(box));
  }
  out.whole = ball_of(whole);
  return out;
}

/// Whether a ball may touch the round cone from one ball to another.
bool in_cone(const Ball& from, const Ball& to, const Ball& b) {
  const Vec3 axis = to.head<3>() - from.head<3>();
  const Vec3 offset = b.head<3>() - from.head<3>();
  const float t = std::clamp(offset.dot(axis) / axis.squaredNorm(), 0.0f, 1.0f);
  const float reach = b.w() + from.w() + t * (to.w() - from.w()) + 0.02f;
  return (offset - t * axis).squaredNorm() <= 1.05f * reach * reach;
}

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

struct ViewRenderer::Canvas {
  cv::Mat image;
  std::vector<BodyBalls> bodies;
  std::vector<std::uint32_t>
      shaded;  // per tile: bit l + 1: light l may be kept off, bit 0: ambient
  std::vector<std::uint8_t> mirrors;  // per tile
  std::vector<std::uint8_t> covered;  // per tile
};

ViewRenderer::ViewRenderer(const StaticView& view, const StageScene& stage, const Lights& lights,
                           const AmbientField& ambient, RenderOptions options)
    : view_(view),
      stage_(stage),
      lights_(lights),
      ambient_(ambient),
      options_(options),
      tiles_x_((view.width() + kTile - 1) / kTile),
      tiles_y_((view.height() + kTile - 1) / kTile) {
  if (view.lights > kMostLights) throw InternalError("a stage has too many lamps");
  for (int ty = 0; ty < tiles_y_; ++ty) {
    for (int tx = 0; tx < tiles_x_; ++tx) {
      Eigen::AlignedBox3f box;
      std::uint8_t glossy = 0;
      for (int y = ty * kTile; y < std::min(view.height(), (ty + 1) * kTile); ++y) {
        for (int x = tx * kTile; x < std::min(view.width(), (tx + 1) * kTile); ++x) {
          const auto pixel = static_cast<std::size_t>(y * view.width() + x);
          if (view.sky(pixel)) continue;
          box.extend(view.point[pixel]);
          if (view.mirror[pixel] > 0) glossy = 1;
        }
      }
      tile_balls_.push_back(box.isEmpty() ? Ball(0, 0, 0, -1) : ball_of(box));
      tile_glossy_.push_back(glossy);
    }
  }
}

cv::Mat ViewRenderer::empty(const LightGains& gains) const {
  cv::Mat image(view_.height(), view_.width(), CV_32FC3);
  auto* out = image.ptr<Vec3>();
  for (std::size_t pixel = 0; pixel < view_.pixels(); ++pixel) {
    Rgb light = gains.ambient * view_.ambient[pixel];
    for (std::size_t l = 0; l < view_.lights; ++l) {
      light += gains.direct[l] * view_.direct[pixel * view_.lights + l] * lights_.colour(l);
    }
    out[pixel] =
        view_.albedo[pixel].cwiseProduct(light) / kPi + gains.ambient * view_.mirrored[pixel];
  }
  return image;
}

void ViewRenderer::choose_tiles(const PeopleScene& people, Canvas& canvas) const {
  for (const MovingBody& body : people.bodies()) canvas.bodies.push_back(balls_of(body));
  const std::size_t count = tile_balls_.size();
  canvas.shaded.assign(count, 0);
  canvas.mirrors.assign(count, options_.everywhere ? 1 : 0);
  canvas.covered.assign(count, options_.everywhere ? 1 : 0);
  const Vec3& eye = view_.rays().origin();
  std::vector<Ball> lights;
  for (std::size_t l = 0; l < view_.lights; ++l) lights.push_back(lights_.ball(l));
  for (std::size_t t = 0; t < count; ++t) {
    const Ball& tile = tile_balls_[t];
    if (tile.w() < 0) continue;
    const Vec3 c = tile.head<3>();
    for (const BodyBalls& body : canvas.bodies) {
      const float near = kContactReach + tile.w();
      const auto touches = [&](const Ball& b) {
        const float reach = near + b.w();
        return (b.head<3>() - c).squaredNorm() < reach * reach;
      };
      if (touches(body.whole) && std::any_of(body.segments.begin(), body.segments.end(), touches)) {
        canvas.shaded[t] |= 1;
      }
      for (std::size_t l = 0; l < view_.lights; ++l) {
        const auto keeps_off = [&](const Ball& b) { return in_cone(tile, lights[l], b); };
        if ((canvas.shaded[t] & (2u << l)) == 0 && keeps_off(body.whole) &&
            std::any_of(body.segments.begin(), body.segments.end(), keeps_off)) {
          canvas.shaded[t] |= 2u << l;
        }
      }
      if (tile_glossy_[t] != 0) {
        // mirrored upwards from the floor: as wide as the roughness spreads
        const Vec3 view = (c - eye).normalized();
        const Vec3 up(view.x(), view.y(), std::abs(view.z()));
        const Vec3 end = c + kMirrorReach * up;
        const Ball far(end.x(), end.y(), end.z(), tile.w() + 0.45f * kMirrorReach);
        if (in_cone(tile, far, body.whole)) canvas.mirrors[t] = 1;
      }
    }
  }
  // where the segments appear
  for (const BodyBalls& body : canvas.bodies) {
    for (const auto& box : body.boxes) {
      if (box.isEmpty()) continue;
      Eigen::AlignedBox2d seen;
      bool behind = false;
      for (int corner = 0; corner < 8; ++corner) {
        const auto at = view_.rays().project(
            box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)).cast<double>());
        behind = behind || !at;
        if (at) seen.extend(*at);
      }
      if (behind) {  // at the edge of what the lens shows: anywhere
        if ((box.center() - eye).norm() > 12) continue;
        seen = {Eigen::Vector2d(-1, -1), Eigen::Vector2d(view_.width(), view_.height())};
      }
      const auto tile = [](double px, int last) {
        return std::clamp(static_cast<int>(std::floor(std::clamp(px, -1e6, 1e6) / kTile)), -1,
                          last + 1);
      };
      for (int ty = std::max(0, tile(seen.min().y() - 1.5, tiles_y_));
           ty <= std::min(tiles_y_ - 1, tile(seen.max().y() + 1.5, tiles_y_)); ++ty) {
        for (int tx = std::max(0, tile(seen.min().x() - 1.5, tiles_x_));
             tx <= std::min(tiles_x_ - 1, tile(seen.max().x() + 1.5, tiles_x_)); ++tx) {
          canvas.covered[static_cast<std::size_t>(ty * tiles_x_ + tx)] = 1;
        }
      }
    }
  }
}

cv::Mat ViewRenderer::render(const PeopleScene& people, const LightGains& gains,
                             std::uint32_t key) const {
  Canvas canvas;
  canvas.image = empty(gains);
  if (people.bodies().empty()) return canvas.image;
  choose_tiles(people, canvas);
  if (options_.shadows) cast_shadows(people, gains, key, canvas);
  if (options_.reflections) mirror_people(people, gains, key + 1, canvas);
  draw_people(people, gains, key + 2, canvas);
  return canvas.image;
}

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

namespace {

/// A point of a body as light sees it.
struct BodyPoint {
  Vec3 place, normal;
  const BodySurface* surface = nullptr;
};

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

}  // namespace

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
