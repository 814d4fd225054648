#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "plugins/sources/synthetic/render/band_shadow.h"
#include "plugins/sources/synthetic/render/static_view.h"

namespace plaza::synthetic {

/// A stage has no more lights than this.
inline constexpr std::size_t kMostLights = 8;

/// Factors on the light of one moment: lamps age, clouds pass.
struct LightGains {
  std::vector<float> direct;  ///< of each light
  float ambient = 1;
  BandShadow shadow;

  /// On light number `light` where it meets `p`.
  float direct_at(std::size_t light, const Vec3& p) const { return direct[light] * shadow.left(p); }
};

struct RenderOptions {
  bool shadows = true;      ///< people keep light from the stage and from each other
  bool reflections = true;  ///< people are mirrored in glossy floors
  /// Looks at every pixel instead of those alone that people can change: slow, for tests.
  bool everywhere = false;
};

/// Draws people into one camera's view of the stage. A pure function of its arguments.
class ViewRenderer {
 public:
  ViewRenderer(const StaticView& view, const StageScene& stage, const Lights& lights,
               const AmbientField& ambient, RenderOptions options);

  /// Radiance of every pixel, linear red, green, blue (CV_32FC3).
  cv::Mat render(const PeopleScene& people, const LightGains& gains, std::uint32_t key) const;
  /// The stage alone.
  cv::Mat empty(const LightGains& gains) const;

 private:
  struct Canvas;
  struct Cover;
  struct Shade;
  struct Batch;
  void choose_tiles(const PeopleScene& people, Canvas& canvas) const;
  void cast_shadows(const PeopleScene& people, const LightGains& gains, std::uint32_t key,
                    Canvas& canvas) const;
  /// What the light that `mask` rules out loses all the same: nothing, if the mask is right.
  Rgb lost_to_others(const PeopleScene& people, const Vec3& p, const Vec3& n, std::uint32_t mask,
                     std::uint32_t random, std::size_t pixel) const;
  void mirror_people(const PeopleScene& people, const LightGains& gains, std::uint32_t key,
                     Canvas& canvas) const;
  RayQuery mirrored_ray(std::size_t pixel, std::uint32_t random) const;
  /// Adds the ray that asks for one pixel whether people keep off light, of those that `mask` has.
  void aim_at_light(std::uint32_t mask, int x, int y, std::size_t pixel, Shade& shade) const;
  /// Shoots the rays that were added. How many of them are kept off.
  int shoot(Shade& shade) const;
  void cast_sun(const PeopleScene& people, const LightGains& gains, std::uint32_t key, int x, int y,
                std::size_t pixel, cv::Mat& image) const;
  /// Adds the ray of one sample of a pixel.
  void aim_at_people(std::size_t pixel, int x, int y, int sample, std::uint32_t random,
                     Batch& batch) const;
  /// Shoots the rays that were added and adds up what they met.
  void take(const PeopleScene& people, const LightGains& gains, Batch& batch,
            std::vector<Cover>& cover) const;
  void shade(const PeopleScene& people, const LightGains& gains, const RayQuery& ray,
             const RayHit& hit, float rank, std::uint32_t random, Cover& cover) const;
  void draw_people(const PeopleScene& people, const LightGains& gains, std::uint32_t key,
                   Canvas& canvas) const;

  const StaticView& view_;
  const StageScene& stage_;
  const Lights& lights_;
  const AmbientField& ambient_;
  RenderOptions options_;
  TileGrid grid_;
  std::vector<Eigen::Vector4f> tile_balls_;  // of the points seen in each tile; radius < 0: none
  std::vector<std::uint8_t> tile_glossy_;
};

}  // namespace plaza::synthetic
