#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "plugins/sources/synthetic/render/rays.h"

namespace plaza::synthetic {

inline float luminance(const Rgb& c) { return 0.2126f * c.x() + 0.7152f * c.y() + 0.0722f * c.z(); }

/// Two unit vectors that make a right-handed frame with `n`.
void tangent_frame(const Vec3& n, Vec3& u, Vec3& v);
/// A direction of the hemisphere about `n`, its density proportional to the cosine.
Vec3 cosine_direction(const Vec3& n, float a, float b);

/// A point of a light as seen from somewhere.
struct TowardsLight {
  Vec3 direction = Vec3::Zero();  ///< unit
  float distance = 0;
};

/// The lamps and the sun of a stage, one after the other.
class Lights {
 public:
  explicit Lights(std::shared_ptr<const StageModel> stage);
  std::size_t count() const { return colours_.size(); }
  /// Colour of unit luminance.
  const Rgb& colour(std::size_t light) const { return colours_[light]; }
  /// Irradiance (luminance) of a surface at `p` with normal `n` when nothing is in the way.
  float irradiance(std::size_t light, const Vec3& p, const Vec3& n) const;
  /// A point of the light for two numbers in [0, 1).
  TowardsLight sample(std::size_t light, const Vec3& p, float a, float b) const;
  /// A ball that holds the light; the sun's is far away.
  Eigen::Vector4f ball(std::size_t light) const;
  bool soft() const { return !stage_->sun; }

 private:
  std::shared_ptr<const StageModel> stage_;
  std::vector<Rgb> colours_;
};

/// Light that has been reflected before, on a grid of places and for six directions of the normal
/// (J. McTaggart, "Half-Life 2 shading": ambient cubes): what lights the shaded sides of people.
class AmbientField {
 public:
  AmbientField(const StageScene& stage, const Lights& lights);
  /// Irradiance of a surface at `p` with normal `n`.
  Rgb irradiance(const Vec3& p, const Vec3& n) const;
  /// Radiance that arrives at `p` against `direction` (pointing away from p): the stage's surfaces
  /// lit by one sample of one light and by the mean of this field, or the sky.
  Rgb incoming(const Vec3& p, const Vec3& direction, std::uint32_t key) const;

 private:
  using Cube = std::array<Rgb, 6>;
  const StageScene& stage_;
  const Lights& lights_;
  Vec3 low_, step_;
  Eigen::Vector3i size_;
  Rgb mean_ = Rgb::Zero();
  std::vector<Cube> cubes_;
};

}  // namespace plaza::synthetic
