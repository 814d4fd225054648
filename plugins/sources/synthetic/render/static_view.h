#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "plugins/sources/synthetic/render/lighting.h"
#include "plugins/sources/synthetic/render/pixel_rays.h"
#include "plugins/sources/synthetic/render/rays.h"
#include "plugins/sources/synthetic/render/surface_smoother.h"

namespace plaza::synthetic {

/// What one camera sees of the stage without people, traced once. Arrays by pixel, row by row.
class StaticView {
 public:
  /// `samples`: rays per pixel. Everything referred to must outlive the view.
  StaticView(const PixelRays& rays, const StageScene& stage, const Lights& lights,
             const AmbientField& ambient, int samples, std::uint32_t seed);

  int width() const { return rays_.width(); }
  int height() const { return rays_.height(); }
  int samples() const { return samples_; }
  /// Place of a sample within its pixel, both coordinates in [0, 1) from the upper left corner.
  const Eigen::Vector2f& sample_offset(int sample) const {
    return offsets_[static_cast<std::size_t>(sample)];
  }
  const PixelRays& rays() const { return rays_; }
  std::size_t pixels() const { return point.size(); }

  std::vector<float> depth;  ///< metres along the ray of each sample; kNothing: the sky
  std::vector<Vec3> point;   ///< where the ray through the pixel's centre ends
  std::vector<Vec3> normal;  ///< there, towards the camera; zero: the sky
  std::vector<std::uint32_t> part;
  std::vector<Rgb>
      albedo;  ///< mean over the pixel, such that albedo x irradiance / pi is its radiance
  std::vector<Rgb> ambient;   ///< irradiance by reflected light and sky
  std::vector<float> direct;  ///< irradiance (luminance) by each light, lights() per pixel
  std::vector<Rgb> mirrored;  ///< radiance seen in a glossy surface, or of the sky
  std::vector<float> mirror;  ///< Fresnel reflectance towards the camera
  std::vector<float> roughness;
  std::size_t lights = 0;
  /// By the surfaces seen here.
  const SurfaceSmoother& smoother() const { return *smoother_; }

  static constexpr float kNothing = 1e4f;
  bool sky(std::size_t pixel) const { return normal[pixel].isZero(); }
  /// Whether two pixels show the same smooth surface.
  bool same_surface(std::size_t a, std::size_t b) const {
    return part[a] == part[b] && normal[a].dot(normal[b]) > 0.9f &&
           std::abs((point[a] - point[b]).dot(normal[a])) < 0.03f;
  }

 private:
  void trace_samples(const StageScene& stage);
  void light(const StageScene& stage, const Lights& lights, const AmbientField& field,
             std::uint32_t seed);
  void blend_edges();

  const PixelRays& rays_;
  int samples_;
  std::vector<Eigen::Vector2f> offsets_;
  std::unique_ptr<const SurfaceSmoother> smoother_;
  std::vector<Rgb> sample_albedo_;  // while the view is made
  std::vector<std::uint32_t> sample_part_;
};

}  // namespace plaza::synthetic
