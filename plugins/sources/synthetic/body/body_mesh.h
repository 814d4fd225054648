#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plugins/sources/synthetic/body/body_shape.h"
#include "plugins/sources/synthetic/body/clothes.h"
#include "plugins/sources/synthetic/people/person.h"

namespace plaza::synthetic {

/// A clothed body as a closed mesh that follows its segments by linear-blend skinning.
class BodyMesh {
 public:
  /// About 6000 triangles with the default edge length.
  BodyMesh(const Proportions& proportions, const Look& look, float edge_m = 0.030f);

  std::size_t vertex_count() const { return rest_.size(); }
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }
  /// In the bind pose; what textures depend on.
  const std::vector<Vec3>& rest() const { return rest_; }
  const Clothes& clothes() const { return clothes_; }
  /// What is seen at a point of a triangle, given by its barycentric coordinates of the second and
  /// third corner: baked at the centres of kDivisions^2 equal parts of each triangle.
  BodySurface surface(std::uint32_t triangle, float u, float v) const;
  /// Which patch of the surface each vertex belongs to: of one segment, 0.16 m wide in bind pose.
  const std::vector<std::uint16_t>& patches() const { return patches_; }
  /// The segment that a patch follows most.
  const std::vector<std::uint8_t>& patch_segments() const { return patch_segments_; }

  /// World positions of all vertices; the span holds vertex_count() entries.
  void place(const BodyPose& pose, std::span<Vec3> positions) const;
  /// Unit normals of all vertices, in the world's axes.
  void turn(const BodyPose& pose, std::span<Vec3> normals) const;

 private:
  static constexpr int kDivisions = 4;
  using Transform = Eigen::Matrix<float, 3, 4>;
  /// A BodySurface in a third of the room: pictures are drawn from a hundred thousand of a
  /// person's.
  struct Texel {
    std::array<std::uint16_t, 3> albedo;  // in 1 / kAlbedoSteps
    std::array<std::int8_t, 3> bump;      // in 1 / kBumpSteps
    std::uint8_t gloss;                   // in 1 / kGlossSteps
  };
  static Texel pack(const BodySurface& surface);
  void divide_into_patches();
  std::array<Transform, kSegmentCount> moves(const BodyPose& pose) const;

  Clothes clothes_;
  BodyPose bind_;
  std::vector<Texel> texels_;
  std::vector<std::uint16_t> patches_;
  std::vector<std::uint8_t> patch_segments_;
  std::vector<Vec3> rest_;
  std::vector<Vec3> rest_normals_;
  std::vector<SkinWeights> weights_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace plaza::synthetic
