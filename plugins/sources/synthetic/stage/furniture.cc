#include <algorithm>
#include <cmath>

#include "plugins/sources/synthetic/people/random.h"
#include "plugins/sources/synthetic/stage/stage_model.h"

namespace plaza::synthetic {
namespace {

float f(double x) { return static_cast<float>(x); }

void table(StageModel& m, const Vec3& low, const Vec3& high, Random& draw) {
  const Vec3 size = high - low;
  const float top = high.z() - 0.03f;
  m.add_box({low.x(), low.y(), top - 0.03f}, {high.x(), high.y(), top}, Material::kWood);
  m.next_part();
  for (const float x : {low.x() + 0.04f, high.x() - 0.08f}) {
    for (const float y : {low.y() + 0.04f, high.y() - 0.08f}) {
      m.add_box({x, y, 0}, {x + 0.04f, y + 0.04f, top - 0.03f}, Material::kMetal);
    }
  }
  m.next_part();  // a set of drawers below
  m.add_box({low.x() + 0.10f, low.y() + 0.08f, 0.05f},
            {low.x() + 0.10f + std::min(0.42f, 0.4f * size.x()), high.y() - 0.1f, top - 0.05f},
            Material::kBoard);
  for (int i = 0; i < 4; ++i) {  // a closed laptop and sheets of paper on top
    m.next_part();
    const bool laptop = i == 0;
    const Vec3 thing = laptop ? Vec3(0.33f, 0.23f, 0.025f) : Vec3(0.21f, 0.20f, 0.006f);
    const float x = low.x() + f(draw.uniform(0.05, 0.95)) * (size.x() - thing.x());
    const float y = low.y() + f(draw.uniform(0.05, 0.95)) * (size.y() - thing.y());
    m.add_box({x, y, top}, Vec3(x, y, top) + thing, laptop ? Material::kMetal : Material::kPaper);
  }
}

void couch(StageModel& m, const Vec3& low, const Vec3& high, const Vec3& room_centre) {
  const bool along_x = high.x() - low.x() > high.y() - low.y();
  const int across = along_x ? 1 : 0;
  const int along = 1 - across;
  m.add_box(low, {high.x(), high.y(), 0.40f}, Material::kFabric);
  m.next_part();  // the back rest is on the side away from the room's middle
  Vec3 back_low = low, back_high = high;
  if (low[across] + high[across] < 2 * room_centre[across]) {
    back_high[across] = low[across] + 0.18f;
  } else {
    back_low[across] = high[across] - 0.18f;
  }
  m.add_box(back_low, back_high, Material::kFabric);
  m.next_part();
  const float arm = std::min(high.z(), 0.56f);
  Vec3 first_high(high.x(), high.y(), arm), second_low = low;
  first_high[along] = low[along] + 0.14f;
  second_low[along] = high[along] - 0.14f;
  m.add_box(low, first_high, Material::kFabric);
  m.add_box(second_low, {high.x(), high.y(), arm}, Material::kFabric);
}

void plant(StageModel& m, const Vec3& low, const Vec3& high, Random& draw) {
  const Vec3 centre = 0.5f * (low + high);
  const float radius = 0.5f * std::min(high.x() - low.x(), high.y() - low.y());
  m.add_cylinder({centre.x(), centre.y(), 0}, 0.5f * radius, 0.65f * radius, 0.32f, Material::kPot);
  m.next_part();
  m.add_cylinder({centre.x(), centre.y(), 0.3f}, 0.02f, 0.015f, 0.5f * high.z(), Material::kBark);
  m.next_part();
  for (int leaf = 0; leaf < 90; ++leaf) {
    const float angle = f(draw.uniform(0, 6.283));
    const float lift = f(draw.uniform(0.35, 1.0));
    const float reach = radius * f(draw.uniform(0.3, 0.8));
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    const Vec3 start = Vec3(centre.x(), centre.y(), lift * (high.z() - 0.12f)) + 0.2f * reach * out;
    const Vec3 blade = 0.7f * reach * out + Vec3(0, 0, f(draw.uniform(-0.10, 0.10)));
    const Vec3 side = 0.05f * Vec3(-out.y(), out.x(), f(draw.uniform(-0.4, 0.4)));
    m.add_quad(start - side, blade, 2 * side, Material::kLeaves);
  }
}

void cabinet(StageModel& m, const Vec3& low, const Vec3& high, const Vec3& room_centre) {
  m.add_box(low, high, Material::kBoard);
  m.next_part();  // handles on the side towards the room
  const int across = high.x() - low.x() > high.y() - low.y() ? 1 : 0;
  const int along = 1 - across;
  const bool at_high = low[across] + high[across] < 2 * room_centre[across];
  for (const float share : {0.44f, 0.56f}) {
    Vec3 p;
    p[along] = low[along] + share * (high[along] - low[along]);
    p[across] = at_high ? high[across] - 0.013f : low[across] + 0.013f;
    p.z() = 0.55f * high.z();
    const Vec3 half(0.014f, 0.014f, 0.08f);
    m.add_box(p - half, p + half, Material::kMetal);
  }
}

}  // namespace

void build_furniture(StageModel& model, const Furniture& furniture, std::uint64_t seed) {
  const Rectangle& foot = furniture.footprint;
  const Vec3 low(f(foot.low.x()), f(foot.low.y()), 0);
  const Vec3 high(f(foot.high.x()), f(foot.high.y()), f(furniture.height_m));
  const Eigen::Vector2d middle = model.layout.area.center();
  const Vec3 room_centre(f(middle.x()), f(middle.y()), 0);
  Random draw(mix(mix(seed, 0xf021), model.parts.size()));
  switch (furniture.kind) {
    case FurnitureKind::kTable:
      return table(model, low, high, draw);
    case FurnitureKind::kCabinet:
      return cabinet(model, low, high, room_centre);
    case FurnitureKind::kCouch:
      return couch(model, low, high, room_centre);
    case FurnitureKind::kPlant:
      return plant(model, low, high, draw);
    case FurnitureKind::kBox:
      return model.add_box(low, high, Material::kCardboard);
  }
}

}  // namespace plaza::synthetic
