#include <algorithm>
#include <vector>

#include "plugins/sources/synthetic/people/random.h"
#include "plugins/sources/synthetic/stage/stage_model.h"

namespace plaza::synthetic {
namespace {

constexpr float kWallThickness = 0.12f;
constexpr float kCorridorDepth = 1.8f;
constexpr float kCorridorSide = 2.5f;

float f(double x) { return static_cast<float>(x); }

/// One wall from `from` along `along` (its whole length), with openings for the doors on it.
void add_wall(StageModel& model, const Eigen::Vector2d& from, const Eigen::Vector2d& along,
              const Eigen::Vector2d& inward) {
  const double height = model.layout.wall_height_m;
  const double length = along.norm();
  const Eigen::Vector2d unit = along / length;
  struct Opening {
    double from, to, height;
  };
  std::vector<Opening> openings;
  for (const Door& door : model.layout.doors) {
    const Eigen::Vector2d offset = door.center_m - from;
    if (door.inward.dot(inward) < 0.9 || std::abs(offset.dot(inward)) > 0.2) continue;
    const double centre = offset.dot(unit);
    openings.push_back({centre - door.width_m / 2, centre + door.width_m / 2, door.height_m});
  }
  std::sort(openings.begin(), openings.end(),
            [](const Opening& a, const Opening& b) { return a.from < b.from; });
  const auto panel = [&](double a, double b, double low, double high) {
    if (b - a < 1e-3 || high - low < 1e-3) return;
    const Eigen::Vector2d p = from + a * unit;
    const Eigen::Vector2d u = (b - a) * unit;
    model.add_quad({f(p.x()), f(p.y()), f(low)}, {f(u.x()), f(u.y()), 0}, {0, 0, f(high - low)},
                   Material::kWall);
  };
  double at = 0;
  for (const Opening& o : openings) {
    panel(at, o.from, 0, height);
    panel(o.from, o.to, o.height, height);
    at = o.to;
  }
  panel(at, length, 0, height);
}

/// The door's frame, and what one sees of the corridor through it.
void add_doorway(StageModel& model, const Door& door) {
  const Eigen::Vector2d out = -door.inward;
  const Eigen::Vector2d side(-out.y(), out.x());
  const auto at = [&](double o, double s, double z) {
    const Eigen::Vector2d p = door.center_m + o * out + s * side;
    return Vec3(f(p.x()), f(p.y()), f(z));
  };
  const auto quad = [&](const Vec3& a, const Vec3& b, const Vec3& c, Material material) {
    model.add_quad(a, b - a, c - a, material);
  };
  const double w = door.width_m / 2, h = door.height_m, t = kWallThickness;
  quad(at(0, -w, 0), at(t, -w, 0), at(0, -w, h), Material::kDoorFrame);
  quad(at(0, w, 0), at(0, w, h), at(t, w, 0), Material::kDoorFrame);
  quad(at(0, -w, h), at(t, -w, h), at(0, w, h), Material::kDoorFrame);
  for (const double s : {-1.0, 1.0}) {  // casing on the wall, 7 cm wide
    const Vec3 a = at(-0.015, s * w, 0), b = at(-0.015, s * (w + 0.07), 0);
    quad(a, b, a + Vec3(0, 0, f(h) + 0.07f), Material::kDoorFrame);
  }
  const Vec3 lintel = at(-0.015, -w, h);
  quad(lintel, at(-0.015, w, h), lintel + Vec3(0, 0, 0.07f), Material::kDoorFrame);
  const double d = t + kCorridorDepth, s = w + kCorridorSide, top = 2.5;
  quad(at(0, -w, 0), at(t, -w, 0), at(0, w, 0), Material::kCorridor);  // the threshold
  quad(at(t, -s, 0), at(d, -s, 0), at(t, s, 0), Material::kCorridor);
  quad(at(d, -s, 0), at(d, s, 0), at(d, -s, top), Material::kCorridor);
  quad(at(t, -s, 0), at(d, -s, 0), at(t, -s, top), Material::kCorridor);
  quad(at(t, s, 0), at(t, s, top), at(d, s, 0), Material::kCorridor);
  quad(at(t, -s, top), at(t, s, top), at(d, -s, top), Material::kCeiling);
  for (const double k : {-1.0, 1.0}) {  // the wall's other side
    quad(at(t, k * w, 0), at(t, k * s, 0), at(t, k * w, top), Material::kCorridor);
  }
  quad(at(t, -w, h), at(t, w, h), at(t, -w, top), Material::kCorridor);
}

}  // namespace

void build_room(StageModel& model, std::uint64_t seed) {
  const Rectangle& room = *model.layout.walls;
  const float height = f(model.layout.wall_height_m);
  const Vec3 low(f(room.low.x()), f(room.low.y()), 0);
  const Vec3 size(f(room.size().x()), f(room.size().y()), 0);
  model.add_quad(low, {size.x(), 0, 0}, {0, size.y(), 0}, Material::kFloor);
  model.next_part();
  model.add_quad(low + Vec3(0, 0, height), {0, size.y(), 0}, {size.x(), 0, 0}, Material::kCeiling);
  const Eigen::Vector2d dx(room.size().x(), 0), dy(0, room.size().y());
  model.next_part();
  add_wall(model, room.low, dx, {0, 1});
  model.next_part();
  add_wall(model, room.low + dx, dy, {-1, 0});
  model.next_part();
  add_wall(model, room.high, -dx, {0, -1});
  model.next_part();
  add_wall(model, room.low + dy, -dy, {1, 0});
  for (const Door& door : model.layout.doors) {
    model.next_part();
    add_doorway(model, door);
  }
  // four panels below the ceiling, none quite like the others
  Random draw(mix(seed, 0x11647));
  const float blue = f(draw.uniform(0.78, 0.95));
  const Vec3 centre = low + 0.5f * size;
  for (const float sx : {-1.0f, 1.0f}) {
    for (const float sy : {-1.0f, 1.0f}) {
      Lamp lamp;
      lamp.centre = centre + Vec3(0.25f * sx * size.x(), 0.26f * sy * size.y(), height - 0.02f);
      lamp.half_u = {0.30f, 0, 0};
      lamp.half_v = {0, 0.60f, 0};
      lamp.normal = {0, 0, -1};
      lamp.radiance = f(draw.uniform(0.75, 1.25)) * 6.0f * Rgb(1.0f, 0.97f, blue);
      model.lamps.push_back(lamp);
    }
  }
}

}  // namespace plaza::synthetic
