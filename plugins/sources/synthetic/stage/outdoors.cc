#include <algorithm>
#include <cmath>
#include <numbers>

#include "plugins/sources/synthetic/people/random.h"
#include "plugins/sources/synthetic/stage/stage_model.h"

namespace plaza::synthetic {
namespace {

float f(double x) { return static_cast<float>(x); }

constexpr double kGroundReach = 60;    // metres beyond the area that are drawn
constexpr double kHedgeDistance = 13;  // from the area; people come from nearer
constexpr double kHouseDistance = 24;

void add_tree(StageModel& m, const Eigen::Vector2d& at, Random& draw) {
  const float trunk = f(draw.uniform(1.8, 2.6));
  const Vec3 base(f(at.x()), f(at.y()), 0);
  m.next_part();
  m.add_cylinder(base, 0.16f, 0.11f, trunk + 1, Material::kBark);
  m.next_part();
  const float size = f(draw.uniform(1.5, 2.4));
  m.add_blob(base + Vec3(0, 0, trunk + 0.8f * size), {size, size, 0.95f * size}, 0.35f,
             Material::kHedge);
}

/// Pieces of hedge and low wall with gaps between them.
void add_border(StageModel& m, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                Random& draw) {
  const Eigen::Vector2d along = (to - from).normalized();
  const double length = (to - from).norm();
  for (double at = 0; at < length;) {
    const double piece = std::min(length - at, draw.uniform(3, 7));
    const Eigen::Vector2d a = from + at * along, b = from + (at + piece - 0.4) * along;
    const bool hedge = draw.chance(0.6);
    const float half = hedge ? 0.45f : 0.15f;
    const float height = hedge ? f(draw.uniform(1.0, 1.5)) : 0.6f;
    m.next_part();
    m.add_box({f(std::min(a.x(), b.x())) - half, f(std::min(a.y(), b.y())) - half, 0},
              {f(std::max(a.x(), b.x())) + half, f(std::max(a.y(), b.y())) + half, height},
              hedge ? Material::kHedge : Material::kConcrete);
    at += piece + (draw.chance(0.3) ? 1.5 : 0);
  }
}

/// Around the whole place.
void add_borders(StageModel& m, const Rectangle& area, Random& draw) {
  const Rectangle ring = area.grown(kHedgeDistance);
  const Eigen::Vector2d c10(ring.high.x(), ring.low.y()), c01(ring.low.x(), ring.high.y());
  add_border(m, ring.low, c10, draw);
  add_border(m, c10, ring.high, draw);
  add_border(m, c01, ring.high, draw);
  add_border(m, ring.low, c01, draw);
}

void add_trees(StageModel& m, const Rectangle& area, Random& draw) {
  for (int i = 0; i < 14; ++i) {
    const double angle = 2 * std::numbers::pi * (i + draw.uniform(-0.3, 0.3)) / 14;
    const double distance = area.size().norm() / 2 + kHedgeDistance + draw.uniform(3, 7);
    add_tree(m, area.center() + distance * Eigen::Vector2d(std::cos(angle), std::sin(angle)), draw);
  }
}

/// Three houses along each side of the place.
void add_houses(StageModel& m, const Rectangle& area, Random& draw) {
  const Rectangle street = area.grown(kHouseDistance);
  const Eigen::Vector2d c = area.center();
  const double depth = 8;
  for (int side = 0; side < 4; ++side) {
    const int away = side / 2, along = 1 - away;  // the axes from the place to the side, and of it
    const double front = side % 2 == 0 ? street.low[away] - depth : street.high[away];
    for (int i = -1; i <= 1; ++i) {
      const double half = draw.uniform(5, 7.5);
      const double middle = i * 17 + draw.uniform(-2, 2);
      const float height = f(draw.uniform(6, 11));
      Eigen::Vector2d low, high;
      low[away] = front;
      high[away] = front + depth;
      low[along] = c[along] + middle - half;
      high[along] = c[along] + middle + half;
      m.next_part();
      m.add_box({f(low.x()), f(low.y()), 0}, {f(high.x()), f(high.y()), height}, Material::kFacade);
    }
  }
}

Sun shining(Random& draw) {
  Sun sun;
  const double azimuth = draw.uniform(0, 2 * std::numbers::pi);
  const double elevation = draw.uniform(28, 50) * std::numbers::pi / 180;
  sun.towards = Vec3(f(std::cos(elevation) * std::cos(azimuth)),
                     f(std::cos(elevation) * std::sin(azimuth)), f(std::sin(elevation)));
  sun.radius_rad = 0.006f;  // the sun's own 0.0047, and a little haze
  sun.irradiance = Rgb(3.0f, 2.75f, 2.35f);
  return sun;
}

}  // namespace

void build_outdoors(StageModel& model, std::uint64_t seed) {
  Random draw(mix(seed, 0x0d00));
  const Rectangle& area = model.layout.area;
  const Rectangle far = area.grown(kGroundReach);
  model.add_quad({f(far.low.x()), f(far.low.y()), 0}, {f(far.size().x()), 0, 0},
                 {0, f(far.size().y()), 0}, Material::kGround);
  add_borders(model, area, draw);
  add_trees(model, area, draw);
  add_houses(model, area, draw);
  model.sun = shining(draw);
  model.sky_zenith = Rgb(0.16f, 0.27f, 0.52f);
  model.sky_horizon = Rgb(0.55f, 0.62f, 0.72f);
}

}  // namespace plaza::synthetic
