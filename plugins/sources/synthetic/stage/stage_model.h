#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "plugins/sources/synthetic/world/stage.h"

namespace plaza::synthetic {

using Vec3 = Eigen::Vector3f;
using Rgb = Eigen::Vector3f;

enum class Material : std::uint8_t {
  kFloor,
  kWall,
  kCeiling,
  kDoorFrame,
  kCorridor,
  kWood,
  kBoard,  ///< coated chipboard: desks, cabinets
  kMetal,
  kFabric,
  kCardboard,
  kPot,
  kLeaves,
  kPaper,
  kGround,  ///< outdoors: slabs, and grass farther away
  kFacade,
  kHedge,
  kBark,
  kConcrete,
};

/// What is seen at a point of a surface.
struct SurfaceLook {
  Rgb albedo = Rgb::Zero();
  float mirror = 0;     ///< Fresnel reflectance at normal incidence; 0: matt
  float roughness = 0;  ///< slope of the mirroring micro-facets
};

/// A rectangle that shines to one side, evenly.
struct Lamp {
  Vec3 centre = Vec3::Zero();
  Vec3 half_u = Vec3::Zero();  ///< from the centre to the middle of a side
  Vec3 half_v = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< the side that shines
  Rgb radiance = Rgb::Zero();
};

/// A disc at infinity.
struct Sun {
  Vec3 towards = Vec3::UnitZ();
  float radius_rad = 0.0047f;
  Rgb irradiance = Rgb::Zero();  ///< on a surface that faces it
};

/// The place as triangles, textures and lights. Immutable after it has been built.
class StageModel {
 public:
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Material> materials;   ///< of each triangle
  std::vector<std::uint32_t> parts;  ///< of each triangle: which thing it belongs to
  std::vector<Lamp> lamps;
  std::optional<Sun> sun;
  Rgb sky_zenith = Rgb::Zero();  ///< radiance; black indoors
  Rgb sky_horizon = Rgb::Zero();
  std::uint32_t seed = 0;
  Stage layout;

  /// `normal`: the triangle's, turned towards the viewer.
  SurfaceLook look(std::uint32_t triangle, const Vec3& p, const Vec3& normal) const;
  /// About the mean of look().albedo over the triangle's material: for light that is reflected.
  Rgb mean_albedo(std::uint32_t triangle) const;
  /// Radiance that comes from where nothing stands.
  Rgb sky(const Vec3& direction) const;

  // what places are built from
  void add_quad(const Vec3& corner, const Vec3& u, const Vec3& v, Material material);
  void add_box(const Vec3& low, const Vec3& high, Material material);
  /// Upright, closed.
  void add_cylinder(const Vec3& base, float radius, float top_radius, float height,
                    Material material);
  /// A lumpy ball: a tree's crown.
  void add_blob(const Vec3& centre, const Vec3& radii, float lumps, Material material);
  void next_part() { ++part_; }

 private:
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, Material material);
  std::uint32_t part_ = 0;
};

/// The room or the open ground that a stage describes. `seed` chooses among floors, paints,
/// posters and the hour of the day.
StageModel build_stage(const Stage& stage, std::uint64_t seed);

void build_room(StageModel& model, std::uint64_t seed);
void build_outdoors(StageModel& model, std::uint64_t seed);
/// Draws one thing within its footprint and height.
void build_furniture(StageModel& model, const Furniture& furniture, std::uint64_t seed);

}  // namespace plaza::synthetic
