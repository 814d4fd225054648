#include "plugins/sources/synthetic/body/body_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "plugins/sources/synthetic/body/surface_nets.h"

namespace plaza::synthetic {

namespace {

constexpr float kAlbedoSteps = 32768;
constexpr float kBumpSteps = 256;
constexpr float kGlossSteps = 512;

template <class Integer>
Integer steps(float value) {
  using Limits = std::numeric_limits<Integer>;
  return static_cast<Integer>(std::clamp(std::round(value), static_cast<float>(Limits::min()),
                                         static_cast<float>(Limits::max())));
}

}  // namespace

BodyMesh::Texel BodyMesh::pack(const BodySurface& surface) {
  Texel out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    out.albedo[k] = steps<std::uint16_t>(kAlbedoSteps * surface.albedo[axis]);
    out.bump[k] = steps<std::int8_t>(kBumpSteps * surface.bump[axis]);
  }
  out.gloss = steps<std::uint8_t>(kGlossSteps * surface.gloss);
  return out;
}

BodyMesh::BodyMesh(const Proportions& proportions, const Look& look, float edge_m)
    : clothes_(BodyShape(proportions, look), look), bind_(clothes_.shape().bind_pose()) {
  const BodyShape& shape = clothes_.shape();
  ClosedSurface surface =
      surface_nets([&](const Vec3& p) { return shape.distance(p); }, shape.bounds(), edge_m);
  triangles_ = std::move(surface.triangles);
  rest_ = std::move(surface.vertices);
  rest_normals_.reserve(rest_.size());
  weights_.reserve(rest_.size());
  constexpr float kStep = 0.006f;
  for (Vec3& p : rest_) {
    Vec3 gradient;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = kStep * Vec3::Unit(k);
      gradient[k] = shape.distance(p + step) - shape.distance(p - step);
    }
    const float length = gradient.norm();
    rest_normals_.push_back(length > 1e-6f ? Vec3(gradient / length) : Vec3(0, 0, 1));
    // the mean of crossings cuts corners; one step along the gradient puts it onto the surface
    const float miss = std::clamp(shape.distance(p), -0.5f * edge_m, 0.5f * edge_m);
    p -= miss * rest_normals_.back();
    weights_.push_back(shape.weights(p));
  }
  divide_into_patches();
  constexpr float kPart = 1.0f / kDivisions;
  texels_.reserve(triangles_.size() * kDivisions * kDivisions);
  for (const auto& t : triangles_) {
    const Vec3 &a = rest_[t[0]], ab = rest_[t[1]] - a, ac = rest_[t[2]] - a;
    for (int i = 0; i < kDivisions; ++i) {
      for (int k = 0; k < 2 * (kDivisions - i) - 1; ++k) {  // upright and inverted parts in turn
        const int column = k / 2;
        const float third = k % 2 == 0 ? 1.0f / 3 : 2.0f / 3;
        const float u = (static_cast<float>(i) + third) * kPart;
        const float v = (static_cast<float>(column) + third) * kPart;
        texels_.push_back(pack(clothes_.at(a + u * ab + v * ac)));
      }
    }
  }
}

void BodyMesh::divide_into_patches() {
  constexpr float kWidth = 0.16f;  // metres
  std::map<std::array<int, 4>, std::uint16_t> known;
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    const Eigen::Vector3i cell = (rest_[v] / kWidth).array().floor().cast<int>();
    const std::uint8_t segment = weights_[v].segment[0];
    const auto [place, fresh] = known.try_emplace({segment, cell.x(), cell.y(), cell.z()},
                                                  static_cast<std::uint16_t>(known.size()));
    if (fresh) patch_segments_.push_back(segment);
    patches_.push_back(place->second);
  }
}

BodySurface BodyMesh::surface(std::uint32_t triangle, float u, float v) const {
  const float x = u * kDivisions, y = v * kDivisions;
  const int i = std::clamp(static_cast<int>(x), 0, kDivisions - 1);
  const int j = std::clamp(static_cast<int>(y), 0, kDivisions - 1 - i);
  const bool inverted =
      x - static_cast<float>(i) + y - static_cast<float>(j) > 1 && j < kDivisions - 1 - i;
  // rows before this one hold 2 D - 1, 2 D - 3, ... parts
  const int at = i * (2 * kDivisions - i) + 2 * j + (inverted ? 1 : 0);
  const Texel& texel = texels_[triangle * kDivisions * kDivisions + static_cast<std::size_t>(at)];
  BodySurface out;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    out.albedo[axis] = static_cast<float>(texel.albedo[k]) / kAlbedoSteps;
    out.bump[axis] = static_cast<float>(texel.bump[k]) / kBumpSteps;
  }
  out.gloss = static_cast<float>(texel.gloss) / kGlossSteps;
  return out;
}

std::array<BodyMesh::Transform, kSegmentCount> BodyMesh::moves(const BodyPose& pose) const {
  std::array<Transform, kSegmentCount> out;
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const Eigen::Isometry3d world_from_bind =
        pose.world_from_segment[s] * bind_.world_from_segment[s].inverse();
    out[s] = world_from_bind.matrix().topRows<3>().cast<float>();
  }
  return out;
}

void BodyMesh::place(const BodyPose& pose, std::span<Vec3> positions) const {
  const auto move = moves(pose);
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    const SkinWeights& w = weights_[v];
    const Eigen::Vector4f rest = rest_[v].homogeneous();
    Vec3 sum = w.weight[0] * (move[w.segment[0]] * rest);
    for (std::size_t k = 1; k < w.weight.size(); ++k) {
      if (w.weight[k] > 0) sum += w.weight[k] * (move[w.segment[k]] * rest);
    }
    positions[v] = sum;
  }
}

void BodyMesh::turn(const BodyPose& pose, std::span<Vec3> normals) const {
  const auto move = moves(pose);
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    const SkinWeights& w = weights_[v];
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < w.weight.size(); ++k) {
      if (w.weight[k] > 0)
        sum += w.weight[k] * (move[w.segment[k]].leftCols<3>() * rest_normals_[v]);
    }
    normals[v] = sum.normalized();
  }
}

}  // namespace plaza::synthetic
