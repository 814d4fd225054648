#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "plugins/sources/synthetic/render/static_view.h"

namespace plaza::synthetic {

/// A stage has no more lights than this.
inline constexpr std::size_t kMostLights = 8;

/// Factors on the light of one moment: lamps age, clouds pass.
struct LightGains {
  std::vector<float> direct;  ///< of each light
  float ambient = 1;
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
  struct Tile;
  struct Canvas;
  struct Cover;
  struct First;
  void choose_tiles(const PeopleScene& people, Canvas& canvas) const;
  void cast_shadows(const PeopleScene& people, const LightGains& gains, std::uint32_t key,
                    Canvas& canvas) const;
  /// What the light that `mask` rules out loses all the same: nothing, if the mask is right.
  Rgb lost_to_others(const PeopleScene& people, const Vec3& p, const Vec3& n, std::uint32_t mask,
                     std::uint32_t random, std::size_t pixel) const;
  void mirror_people(const PeopleScene& people, const LightGains& gains, std::uint32_t key,
                     Canvas& canvas) const;
  /// Takes one sample of a pixel.
  void shade(const PeopleScene& people, const LightGains& gains, std::size_t pixel, int x, int y,
             int sample, std::uint32_t random, Cover& cover) const;
  void draw_people(const PeopleScene& people, const LightGains& gains, std::uint32_t key,
                   Canvas& canvas) const;

  const StaticView& view_;
  const StageScene& stage_;
  const Lights& lights_;
  const AmbientField& ambient_;
  RenderOptions options_;
  int tiles_x_, tiles_y_;
  std::vector<Eigen::Vector4f> tile_balls_;  // of the points seen in each tile; radius < 0: none
  std::vector<std::uint8_t> tile_glossy_;
};

}  // namespace plaza::synthetic
