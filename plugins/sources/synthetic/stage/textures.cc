#include <algorithm>
#include <array>
#include <cmath>

#include "plugins/sources/synthetic/common/texture_noise.h"
#include "plugins/sources/synthetic/stage/stage_model.h"

namespace plaza::synthetic {
namespace {

float fract(float x) { return x - std::floor(x); }
/// Distance to the nearer border of a unit cell.
float to_seam(float x) { return std::min(fract(x), 1 - fract(x)); }
std::uint32_t cell_hash(float x, float y, std::uint32_t seed) {
  const auto ix = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(x)));
  const auto iy = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(y)));
  return hash32(ix * 0x9e3779b1u ^ hash32(iy ^ seed));
}

/// Where a thing was spilled and not quite cleaned, or feet have worn the floor.
float stains(const Vec3& p, std::uint32_t seed) {
  const float blot = fractal_noise(1.1f * p, seed ^ 0x57u, 4);
  const float drop = value_noise(4.3f * p, seed ^ 0x91u);
  return 1 + 0.10f * blot - 0.22f * std::clamp((drop - 0.68f) / 0.06f, 0.0f, 1.0f);
}

SurfaceLook parquet(const Vec3& p, std::uint32_t seed) {
  const float row = p.x() / 0.11f;
  const float along = (p.y() + 0.8f * to_unit(cell_hash(row, 0, seed))) / 0.8f;
  const std::uint32_t plank = cell_hash(row, along, seed ^ 0x3u);
  const float tone = 0.78f + 0.44f * to_unit(plank);
  const Vec3 fibre(55 * p.x(), 3.5f * p.y(), 90 * to_unit(plank));
  const float grain = 1 + 0.16f * fractal_noise(fibre, seed, 3);
  const bool seam = std::min(0.11f * to_seam(row), 0.8f * to_seam(along)) < 0.0022f;
  SurfaceLook out;
  out.albedo = Rgb(0.36f, 0.225f, 0.125f) * (tone * grain * (seam ? 0.45f : 1) * stains(p, seed));
  out.mirror = 0.025f;
  out.roughness = 0.12f;
  return out;
}

SurfaceLook linoleum(const Vec3& p, std::uint32_t seed) {
  const float speckle = fractal_noise(38.0f * p, seed, 3);
  const bool seam = std::min(to_seam(p.x() / 1.2f), to_seam(p.y() / 1.2f)) < 0.003f;
  SurfaceLook out;
  out.albedo =
      Rgb(0.30f, 0.31f, 0.32f) * ((1 + 0.22f * speckle) * stains(p, seed) * (seam ? 0.6f : 1.0f));
  out.mirror = 0.025f;
  out.roughness = 0.12f;
  return out;
}

SurfaceLook carpet(const Vec3& p, std::uint32_t seed) {
  const float tile = 0.88f + 0.24f * to_unit(cell_hash(p.x() / 0.5f, p.y() / 0.5f, seed));
  const float pile = fractal_noise(70.0f * p, seed, 2);
  SurfaceLook out;
  out.albedo = Rgb(0.13f, 0.15f, 0.19f) * (tile * (1 + 0.30f * pile) * stains(p, seed));
  return out;
}

/// A poster's picture: (u, v) in [0, 1].
Rgb poster(float u, float v, std::uint32_t key) {
  const Rgb paper(0.62f, 0.60f, 0.56f);
  const auto hue = [&](std::uint32_t k) {
    return Rgb(0.08f + 0.5f * to_unit(hash32(key + k)), 0.08f + 0.4f * to_unit(hash32(key + k + 1)),
               0.08f + 0.5f * to_unit(hash32(key + k + 2)));
  };
  if (u < 0.04f || u > 0.96f || v < 0.03f || v > 0.97f) return paper;
  if (key % 3 == 0) {  // a photograph: sky over hills
    const float hill = 0.4f + 0.2f * fractal_noise({3 * u, 0.5f, 0}, key, 3);
    return v > hill ? Rgb(0.25f, 0.38f, 0.60f) : Rgb(hue(1) * (0.6f + 0.8f * v));
  }
  if (v > 0.80f) return hue(4);  // a headline over columns of text and a diagram
  if (u > 0.55f && v < 0.5f) {
    return std::hypot(u - 0.75f, 0.7f * (v - 0.25f)) < 0.14f ? hue(7) : paper;
  }
  const bool ink = fract(v * 24) < 0.45f && to_unit(cell_hash(u * 40, v * 24, key)) > 0.2f;
  return ink ? Rgb(paper * 0.35f) : paper;
}

/// A light switch beside every door, on the side away from its hinges.
bool on_switch(const Vec3& p, float along, const Vec3& normal, const Stage& stage) {
  for (const Door& door : stage.doors) {
    const bool x_wall = std::abs(normal.x()) > 0.5f;
    const bool same =
        x_wall ? door.inward.x() * normal.x() > 0.5 : door.inward.y() * normal.y() > 0.5;
    const double centre = x_wall ? door.center_m.y() : door.center_m.x();
    const float u = along - static_cast<float>(centre + door.width_m / 2 + 0.2);
    if (same && std::abs(u) < 0.045f && std::abs(p.z() - 1.08f) < 0.07f) return true;
  }
  return false;
}

SurfaceLook wall(const Vec3& p, const Vec3& normal, std::uint32_t part, std::uint32_t seed,
                 const Stage& stage) {
  SurfaceLook out;
  const bool x_wall = std::abs(normal.x()) > 0.5f;
  const float along = x_wall ? p.y() : p.x();
  const std::uint32_t key = hash32(seed ^ (part * 0x632bu));
  if (p.z() < 0.09f) {
    out.albedo = Rgb(0.20f, 0.16f, 0.12f);  // skirting
    return out;
  }
  if (on_switch(p, along, normal, stage)) {
    out.albedo = std::abs(p.z() - 1.08f) < 0.03f ? Rgb(0.4f, 0.4f, 0.4f) : Rgb(0.75f, 0.75f, 0.73f);
    return out;
  }
  const Eigen::Vector2d middle = stage.area.center();
  const float local = along - static_cast<float>(x_wall ? middle.y() : middle.x());
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t k = hash32(key + 17 * i);
    const float width = 0.45f + 0.4f * to_unit(k);
    const float height = width * (0.9f + 0.5f * to_unit(hash32(k)));
    const float from = -1.9f + 1.5f * static_cast<float>(i) + 0.5f * to_unit(hash32(k + 1));
    const float bottom = 1.15f + 0.3f * to_unit(hash32(k + 2));
    const float u = (local - from) / width, v = (p.z() - bottom) / height;
    if (u > 0 && u < 1 && v > 0 && v < 1) {
      out.albedo = poster(u, v, k);
      return out;
    }
  }
  const float paint =
      1 + 0.03f * fractal_noise(2.0f * p, seed, 3) + 0.02f * value_noise(60.0f * p, seed);
  const float scuffs = 1 - 0.10f * std::max(0.0f, 1 - p.z() / 0.6f) *
                               (0.5f + 0.5f * value_noise(3.0f * p, seed ^ 5u));
  out.albedo = Rgb(0.50f, 0.49f, 0.46f) * (paint * scuffs);
  if (seed % 2 == 0 && p.z() < 1.02f) {
    out.albedo = out.albedo.cwiseProduct(Rgb(0.70f, 0.80f, 0.84f));  // painted up to the hip
  }
  return out;
}

/// Slabs in and around the area, grass beyond an uneven border.
SurfaceLook ground(const Vec3& p, const Stage& stage, std::uint32_t seed) {
  SurfaceLook out;
  const auto off = static_cast<float>(stage.area.distance({p.x(), p.y()}));
  if (off > 4.5f + 1.2f * value_noise(0.35f * p, seed ^ 0x77u)) {
    const float blades = fractal_noise(9.0f * p, seed, 4);
    const float patch = fractal_noise(0.4f * p, seed ^ 0x9u, 3);
    out.albedo = Rgb(0.10f + 0.04f * patch, 0.155f + 0.02f * patch, 0.045f) * (1 + 0.45f * blades);
    return out;
  }
  const float x = p.x() / 0.5f;
  const float y = p.y() / 0.5f + (std::fmod(std::abs(std::floor(x)), 2.0f) > 0.5f ? 0.5f : 0.0f);
  const float tone = 0.85f + 0.3f * to_unit(cell_hash(x, y, seed));
  const bool seam = std::min(to_seam(x), to_seam(y)) < 0.012f;
  const float grit = 1 + 0.14f * fractal_noise(25.0f * p, seed, 3);
  out.albedo = Rgb(0.30f, 0.28f, 0.255f) * (tone * grit * stains(p, seed) * (seam ? 0.55f : 1.0f));
  return out;
}

SurfaceLook facade(const Vec3& p, const Vec3& normal, std::uint32_t part, std::uint32_t seed) {
  static constexpr std::array<std::array<float, 3>, 4> kPaints = {
      {{0.48f, 0.44f, 0.36f}, {0.36f, 0.19f, 0.13f}, {0.42f, 0.42f, 0.41f}, {0.50f, 0.47f, 0.44f}}};
  SurfaceLook out;
  const auto& c = kPaints[hash32(part ^ seed) % kPaints.size()];
  out.albedo = Rgb(c[0], c[1], c[2]) * (1 + 0.08f * fractal_noise(1.5f * p, seed, 4));
  if (normal.z() > 0.5f) return out;
  const float u = fract((std::abs(normal.x()) > 0.5f ? p.y() : p.x()) / 2.4f);
  const float v = fract((p.z() - 0.4f) / 3.0f);
  if (u < 0.3f || u > 0.75f || v < 0.28f || v > 0.8f) return out;
  const bool frame =
      u < 0.33f || u > 0.72f || v < 0.32f || v > 0.76f || std::abs(u - 0.525f) < 0.015f;
  out.albedo = frame ? Rgb(0.55f, 0.55f, 0.53f) : Rgb(0.05f, 0.06f, 0.075f);
  return out;
}

/// `tone` with noise of `depth` in features of size 1 / `scale`.
SurfaceLook matt(const Rgb& tone, const Vec3& p, float scale, float depth, std::uint32_t seed) {
  SurfaceLook out;
  out.albedo = tone * (1 + depth * fractal_noise(scale * p, seed, 3));
  return out;
}

}  // namespace

SurfaceLook StageModel::look(std::uint32_t triangle, const Vec3& p, const Vec3& normal) const {
  const std::uint32_t part = parts[triangle];
  switch (materials[triangle]) {
    case Material::kFloor:
      return seed % 3 == 0 ? parquet(p, seed) : seed % 3 == 1 ? linoleum(p, seed) : carpet(p, seed);
    case Material::kWall:
      return wall(p, normal, part, seed, layout);
    case Material::kCeiling:
      return matt({0.60f, 0.60f, 0.59f}, p, 3, 0.03f, seed);
    case Material::kDoorFrame:
      return matt({0.42f, 0.33f, 0.22f}, p, 9, 0.08f, seed);
    case Material::kCorridor:
      return matt({0.42f, 0.42f, 0.40f}, p, 2, 0.06f, seed);
    case Material::kWood: {
      const Vec3 fibre(4 * p.x(), 45 * p.y(), 20 * p.z());
      SurfaceLook out = matt({0.44f, 0.31f, 0.18f}, fibre, 1, 0.16f, seed);
      out.mirror = 0.02f;
      out.roughness = 0.15f;
      return out;
    }
    case Material::kBoard:
      return matt({0.52f, 0.52f, 0.50f}, p, 5, 0.04f, seed);
    case Material::kMetal:
      return matt({0.16f, 0.16f, 0.17f}, p, 12, 0.08f, seed);
    case Material::kFabric:
      return matt({0.20f, 0.075f, 0.065f}, p, 45, 0.22f, seed);
    case Material::kCardboard: {
      SurfaceLook out = matt({0.40f, 0.29f, 0.18f}, p, 14, 0.10f, seed);
      const float across = (std::abs(normal.x()) > 0.5f ? p.y() : p.x()) / 0.5f;
      if (std::abs(fract(across) - 0.5f) < 0.05f) out.albedo *= 1.25f;  // tape
      return out;
    }
    case Material::kPot:
      return matt({0.36f, 0.15f, 0.08f}, p, 10, 0.10f, seed);
    case Material::kLeaves:
      return matt({0.06f, 0.13f, 0.035f}, p, 7, 0.55f, seed);
    case Material::kPaper:
      return matt({0.68f, 0.68f, 0.66f}, p, 60, 0.12f, seed);
    case Material::kGround:
      return ground(p, layout, seed);
    case Material::kFacade:
      return facade(p, normal, part, seed);
    case Material::kHedge:
      return matt({0.055f, 0.105f, 0.035f}, p, 9, 0.6f, seed);
    case Material::kBark:
      return matt({0.13f, 0.095f, 0.07f}, p, 12, 0.3f, seed);
    case Material::kConcrete:
      return matt({0.34f, 0.33f, 0.31f}, p, 6, 0.15f, seed);
  }
  return {};
}

Rgb StageModel::mean_albedo(std::uint32_t triangle) const {
  switch (materials[triangle]) {
    case Material::kFloor:
      return seed % 3 == 0   ? Rgb(0.35f, 0.22f, 0.12f)
             : seed % 3 == 1 ? Rgb(0.29f, 0.30f, 0.31f)
                             : Rgb(0.13f, 0.15f, 0.19f);
    case Material::kWall:
      return {0.45f, 0.44f, 0.42f};
    case Material::kCeiling:
      return {0.60f, 0.60f, 0.59f};
    case Material::kGround:
      return {0.20f, 0.20f, 0.14f};
    case Material::kFacade:
      return {0.38f, 0.34f, 0.30f};
    case Material::kHedge:
    case Material::kLeaves:
      return {0.06f, 0.11f, 0.035f};
    case Material::kBoard:
    case Material::kPaper:
      return {0.52f, 0.52f, 0.50f};
    case Material::kFabric:
      return {0.20f, 0.075f, 0.065f};
    default:
      return {0.33f, 0.29f, 0.23f};
  }
}

}  // namespace plaza::synthetic
