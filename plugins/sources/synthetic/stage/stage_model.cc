#include "plugins/sources/synthetic/stage/stage_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plugins/sources/synthetic/common/texture_noise.h"
#include "plugins/sources/synthetic/people/random.h"

namespace plaza::synthetic {

void StageModel::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                              Material material) {
  triangles.push_back({a, b, c});
  materials.push_back(material);
  parts.push_back(part_);
}

void StageModel::add_quad(const Vec3& corner, const Vec3& u, const Vec3& v, Material material) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.push_back(corner);
  vertices.push_back(corner + u);
  vertices.push_back(corner + u + v);
  vertices.push_back(corner + v);
  add_triangle(first, first + 1, first + 2, material);
  add_triangle(first, first + 2, first + 3, material);
}

void StageModel::add_box(const Vec3& low, const Vec3& high, Material material) {
  const Vec3 s = high - low;
  const Vec3 x(s.x(), 0, 0), y(0, s.y(), 0), z(0, 0, s.z());
  add_quad(low, y, x, material);
  add_quad(low + z, x, y, material);
  add_quad(low, x, z, material);
  add_quad(low + y, z, x, material);
  add_quad(low, z, y, material);
  add_quad(low + x, y, z, material);
}

void StageModel::add_cylinder(const Vec3& base, float radius, float top_radius, float height,
                              Material material) {
  constexpr std::uint32_t kSides = 14;
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const float a = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kSides;
    const Vec3 out(std::cos(a), std::sin(a), 0);
    vertices.push_back(base + radius * out);
    vertices.push_back(base + top_radius * out + Vec3(0, 0, height));
  }
  vertices.push_back(base);
  vertices.push_back(base + Vec3(0, 0, height));
  const std::uint32_t low = first + 2 * kSides;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % kSides);
    add_triangle(a, b, b + 1, material);
    add_triangle(a, b + 1, a + 1, material);
    add_triangle(low, b, a, material);
    add_triangle(low + 1, a + 1, b + 1, material);
  }
}

void StageModel::add_blob(const Vec3& centre, const Vec3& radii, float lumps, Material material) {
  constexpr std::uint32_t kRings = 12, kSides = 20;
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    const float polar = std::numbers::pi_v<float> * static_cast<float>(ring) / kRings;
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const float a = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kSides;
      const Vec3 out(std::sin(polar) * std::cos(a), std::sin(polar) * std::sin(a), std::cos(polar));
      const float size = 1 + lumps * fractal_noise(2.5f * out + centre, seed, 3);
      vertices.push_back(centre + size * radii.cwiseProduct(out));
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t next = (i + 1) % kSides;
      const std::uint32_t a = first + ring * kSides, b = a + kSides;
      add_triangle(a + i, b + i, b + next, material);
      add_triangle(a + i, b + next, a + next, material);
    }
  }
}

Rgb StageModel::sky(const Vec3& direction) const {
  const float up = std::max(direction.z(), 0.0f);
  const Rgb clear = sky_horizon + (sky_zenith - sky_horizon) * std::sqrt(up);
  if (up < 0.02f || sky_zenith.isZero()) return clear;
  // clouds on a plane overhead
  const Vec3 place(2.2f * direction.x() / (up + 0.12f), 2.2f * direction.y() / (up + 0.12f), 0);
  const float cloud =
      std::max(0.0f, fractal_noise(place, seed ^ 0xc10du, 4)) * std::min(1.0f, 6 * up);
  return clear + 0.9f * cloud * (Rgb::Constant(1.15f * sky_horizon.maxCoeff()) - clear);
}

StageModel build_stage(const Stage& stage, std::uint64_t seed) {
  StageModel model;
  model.layout = stage;
  model.seed = static_cast<std::uint32_t>(mix(seed, 0x57a6e));
  if (stage.walls) {
    build_room(model, seed);
  } else {
    build_outdoors(model, seed);
  }
  for (const Furniture& furniture : stage.furniture) {
    model.next_part();
    build_furniture(model, furniture, seed);
  }
  return model;
}

}  // namespace plaza::synthetic
