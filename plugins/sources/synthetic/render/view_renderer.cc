#include "plugins/sources/synthetic/render/view_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plaza/core/error.h"
#include "plugins/sources/synthetic/render/view_canvas.h"

namespace plaza::synthetic {
namespace {

/// Whether a ball may touch the round cone from one ball to another.
bool in_cone(const Ball& from, const Ball& to, const Ball& b) {
  const Vec3 axis = to.head<3>() - from.head<3>();
  const Vec3 offset = b.head<3>() - from.head<3>();
  const float t = std::clamp(offset.dot(axis) / axis.squaredNorm(), 0.0f, 1.0f);
  const float reach = b.w() + from.w() + t * (to.w() - from.w()) + 0.02f;
  return (offset - t * axis).squaredNorm() <= 1.05f * reach * reach;
}

}  // namespace

ViewRenderer::ViewRenderer(const StaticView& view, const StageScene& stage, const Lights& lights,
                           const AmbientField& ambient, RenderOptions options)
    : view_(view),
      stage_(stage),
      lights_(lights),
      ambient_(ambient),
      options_(options),
      grid_(view.width(), view.height()) {
  if (view.lights > kMostLights) throw InternalError("a stage has too many lamps");
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    Eigen::AlignedBox3f box;
    std::uint8_t glossy = 0;
    grid_.each_pixel(tile, [&](int, int, std::size_t pixel) {
      if (view.sky(pixel)) return;
      box.extend(view.point[pixel]);
      if (view.mirror[pixel] > 0) glossy = 1;
    });
    tile_balls_.push_back(box.isEmpty() ? Ball(0, 0, 0, -1) : ball_of(box));
    tile_glossy_.push_back(glossy);
  }
}

cv::Mat ViewRenderer::empty(const LightGains& gains) const {
  cv::Mat image(view_.height(), view_.width(), CV_32FC3);
  auto* out = image.ptr<Vec3>();
  for (std::size_t pixel = 0; pixel < view_.pixels(); ++pixel) {
    Rgb light = gains.ambient * view_.ambient[pixel];
    const float left = gains.shadow.left(view_.point[pixel]);
    for (std::size_t l = 0; l < view_.lights; ++l) {
      light += left * gains.direct[l] * view_.direct[pixel * view_.lights + l] * lights_.colour(l);
    }
    out[pixel] =
        view_.albedo[pixel].cwiseProduct(light) / kPi + gains.ambient * view_.mirrored[pixel];
  }
  return image;
}

void ViewRenderer::choose_tiles(const PeopleScene& people, Canvas& canvas) const {
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
    for (const BodyBounds& body : people.bounds()) {
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
  // where the surface appears
  for (const BodyBounds& body : people.bounds()) {
    for (const auto& box : body.patches) {
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
      for (int ty = std::max(0, tile(seen.min().y() - 1.5, grid_.down));
           ty <= std::min(grid_.down - 1, tile(seen.max().y() + 1.5, grid_.down)); ++ty) {
        for (int tx = std::max(0, tile(seen.min().x() - 1.5, grid_.across));
             tx <= std::min(grid_.across - 1, tile(seen.max().x() + 1.5, grid_.across)); ++tx) {
          canvas.covered[static_cast<std::size_t>(ty * grid_.across + tx)] = 1;
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

}  // namespace plaza::synthetic
