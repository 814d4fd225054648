#include "models/cylinder/cylinder.h"

#include <array>

namespace plaza {

Declaration<Cylinder::Options> Cylinder::declare() {
  Parameters<Options> p;
  const auto length = [&p](const char* name, double Options::*member) {
    return p.value(name, member).unit("m").above(0).at_most(10);
  };
  length("legs_m", &Options::legs_m)
      .meaning("height of the lowest cylinder")
      .source("thesis 4.4.1");
  length("torso_m", &Options::torso_m)
      .meaning("height of the cylinder above the legs")
      .source("thesis 4.4.1");
  length("head_m", &Options::head_m)
      .meaning("height of the cylinder above the torso")
      .source("thesis 4.4.1");
  length("legs_radius_m", &Options::legs_radius_m)
      .meaning("radius of the legs; the thesis gives no radii");
  length("torso_radius_m", &Options::torso_radius_m).meaning("radius of the torso");
  length("head_radius_m", &Options::head_radius_m).meaning("radius of the head");
  length("box_radius_m", &Options::box_radius_m)
      .meaning("radius of the one cylinder that boxes of observations are drawn around");
  p.value("contour_step_px", &Options::contour_step_px)
      .unit("px")
      .above(0)
      .at_most(50)
      .meaning("distance of neighbouring contour points; 1: pixel by pixel")
      .source("thesis 4.2");
  Declaration<Options> d("cylinder", "A standing person as three cylinders: legs, torso, head.");
  return d.source("thesis 4.3.1, 4.4.1").parameters(std::move(p));
}

Cylinder::Cylinder(const Options& options, const BuildContext& /*context*/) : options_(options) {}

Silhouette Cylinder::do_silhouette(const Pose& pose, const Camera& camera) const {
  const Options& o = options_;
  const double hips = o.legs_m * pose.scale;
  const double shoulders = hips + o.torso_m * pose.scale;
  const double crown = shoulders + o.head_m * pose.scale;
  const auto cylinder = [&](double radius_m, double bottom_m, double top_m) {
    return cylinder_prism(pose.position_m, radius_m * pose.scale, bottom_m, top_m, camera);
  };
  const std::array<Prism, 3> solids{cylinder(o.legs_radius_m, 0, hips),
                                    cylinder(o.torso_radius_m, hips, shoulders),
                                    cylinder(o.head_radius_m, shoulders, crown)};
  return silhouette_of(solids, camera, o.contour_step_px);
}

Body Cylinder::do_body() const {
  return {.height_m = options_.legs_m + options_.torso_m + options_.head_m,
          .radius_m = options_.box_radius_m};
}

}  // namespace plaza
