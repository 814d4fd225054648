#include "models/box-parallelepiped/box_parallelepiped.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace plaza {

Declaration<BoxParallelepiped::Options> BoxParallelepiped::declare() {
  Parameters<Options> p;
  const auto length = [&p](const char* name, double Options::*member) {
    return p.value(name, member).unit("m").above(0).at_most(100);
  };
  length("length_m", &Options::length_m).meaning("along the heading; a passenger car by default");
  length("width_m", &Options::width_m).meaning("across the heading");
  length("height_m", &Options::height_m).meaning("above the ground");
  p.value("contour_step_px", &Options::contour_step_px)
      .unit("px")
      .above(0)
      .at_most(50)
      .meaning("distance of neighbouring contour points; 1: pixel by pixel")
      .source("thesis 4.2");
  Declaration<Options> d("box-parallelepiped", "An upright box on the ground, such as a car.");
  return d.source("thesis 7.2").parameters(std::move(p));
}

BoxParallelepiped::BoxParallelepiped(const Options& options, const BuildContext& /*context*/)
    : options_(options) {}

Silhouette BoxParallelepiped::do_silhouette(const Pose& pose, const Camera& camera) const {
  const Eigen::Rotation2Dd world_from_body(pose.heading_rad);
  const double x = 0.5 * options_.length_m * pose.scale, y = 0.5 * options_.width_m * pose.scale;
  Prism box{{}, 0, options_.height_m * pose.scale};
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(x, y), Eigen::Vector2d(-x, y),
                                        Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, -y)}) {
    box.base_m.emplace_back(pose.position_m + world_from_body * corner);
  }
  return silhouette_of({&box, 1}, camera, options_.contour_step_px);
}

Body BoxParallelepiped::do_body() const {
  return {.height_m = options_.height_m,
          .radius_m = std::sqrt(options_.length_m * options_.width_m / std::numbers::pi)};
}

}  // namespace plaza
