#include "plugins/sources/synthetic/render/body_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plaza::synthetic {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();
// A body that touches the stage or another one is not hidden by it.
constexpr float kTouch = 0.02f;

/// Distances from the camera over a window of pixels, which may reach beyond the image.
struct DepthWindow {
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<float> depth;
  float& at(int x, int y) {
    return depth[static_cast<std::size_t>(y - top) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x - left)];
  }
};

struct Corner {
  float x, y, depth;
};

void draw_triangle(const Corner& a, const Corner& b, const Corner& c, DepthWindow& window) {
  const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area == 0) return;
  const int x0 = std::max(window.left, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x}))));
  const int x1 = std::min(window.left + window.width - 1,
                          static_cast<int>(std::floor(std::max({a.x, b.x, c.x}))));
  const int y0 = std::max(window.top, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}))));
  const int y1 = std::min(window.top + window.height - 1,
                          static_cast<int>(std::floor(std::max({a.y, b.y, c.y}))));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const auto px = static_cast<float>(x), py = static_cast<float>(y);
      const float u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
      const float v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
      const float w = 1 - u - v;
      if (u < 0 || v < 0 || w < 0) continue;
      float& depth = window.at(x, y);
      depth = std::min(depth, u * a.depth + v * b.depth + w * c.depth);
    }
  }
}

/// A body in the middle of the exposure, or nothing where the camera can't see it.
std::optional<std::pair<Box, DepthWindow>> draw_body(const MovingBody& body,
                                                     const StaticView& view) {
  std::vector<Corner> corners;
  corners.reserve(body.open.size());
  Eigen::AlignedBox2d seen;
  for (std::size_t v = 0; v < body.open.size(); ++v) {
    const Vec3 p = 0.5f * (body.open[v] + body.close[v]);
    const auto pixel = view.rays().project(p.cast<double>());
    if (!pixel) return std::nullopt;
    seen.extend(*pixel);
    corners.push_back({static_cast<float>(pixel->x()), static_cast<float>(pixel->y()),
                       (p - view.rays().origin()).norm()});
  }
  // so near that most of it is beyond the image: no more than three images wide and high
  const Eigen::AlignedBox2d limit(Eigen::Vector2d(-view.width(), -view.height()),
                                  Eigen::Vector2d(2 * view.width(), 2 * view.height()));
  const Eigen::AlignedBox2d within = seen.intersection(limit);
  if (within.isEmpty()) return std::nullopt;
  DepthWindow window;
  window.left = static_cast<int>(std::floor(within.min().x()));
  window.top = static_cast<int>(std::floor(within.min().y()));
  window.width = static_cast<int>(std::ceil(within.max().x())) - window.left + 1;
  window.height = static_cast<int>(std::ceil(within.max().y())) - window.top + 1;
  window.depth.assign(
      static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height), kFar);
  for (const auto& t : body.mesh->triangles()) {
    draw_triangle(corners[t[0]], corners[t[1]], corners[t[2]], window);
  }
  const Box box{seen.min().x(), seen.min().y(), seen.sizes().x(), seen.sizes().y()};
  return std::pair(box, std::move(window));
}

}  // namespace

std::vector<BodyView> body_views(std::span<const MovingBody> bodies, const StaticView& view) {
  std::vector<BodyView> out;
  std::vector<DepthWindow> windows;
  std::vector<float> nearest(view.pixels(), kFar);
  const auto on_image = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < view.width() && y < view.height();
  };
  const auto pixel_of = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width()) +
           static_cast<std::size_t>(x);
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    auto drawn = draw_body(bodies[i], view);
    if (!drawn) continue;
    BodyView body;
    body.body = i;
    body.box = drawn->first;
    DepthWindow& window = drawn->second;
    for (int y = window.top; y < window.top + window.height; ++y) {
      for (int x = window.left; x < window.left + window.width; ++x) {
        if (on_image(x, y))
          nearest[pixel_of(x, y)] = std::min(nearest[pixel_of(x, y)], window.at(x, y));
      }
    }
    out.push_back(body);
    windows.push_back(std::move(window));
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    DepthWindow& window = windows[i];
    std::int64_t all = 0, visible = 0, inside = 0;
    for (int y = window.top; y < window.top + window.height; ++y) {
      for (int x = window.left; x < window.left + window.width; ++x) {
        const float depth = window.at(x, y);
        if (depth == kFar) continue;
        ++all;
        if (!on_image(x, y)) continue;
        ++inside;
        const std::size_t pixel = pixel_of(x, y);
        const float wall =
            view.sky(pixel) ? kFar : (view.point[pixel] - view.rays().origin()).norm();
        if (depth <= nearest[pixel] && depth <= wall + kTouch) ++visible;
      }
    }
    out[i].visibility = all > 0 ? static_cast<double>(visible) / static_cast<double>(all) : 0;
    if (inside == 0) windows[i].width = 0;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (windows[i].width > 0) out[kept++] = out[i];
  }
  out.resize(kept);
  return out;
}

}  // namespace plaza::synthetic
