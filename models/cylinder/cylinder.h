#pragma once

#include "plaza/component/declaration.h"

namespace plaza {

/// A standing person as three upright cylinders about one axis: legs, torso and head (thesis 4.3.1,
/// Figure 4.3; 4.4.1 gives the heights). The silhouette is the boundary of their union in the
/// image. Headings make no difference.
class Cylinder final : public ShapeModel {
 public:
  struct Options {
    double legs_m = 0.85;
    double torso_m = 0.60;
    double head_m = 0.30;
    double legs_radius_m = 0.18;
    double torso_radius_m = 0.25;
    double head_radius_m = 0.12;
    double box_radius_m = 0.30;
    double contour_step_px = 1;
  };
  static Declaration<Options> declare();
  Cylinder(const Options& options, const BuildContext& context);

 private:
  Silhouette do_silhouette(const Pose& pose, const Camera& camera) const override;
  /// All three heights together, and the radius that boxes are drawn with.
  Body do_body() const override;

  Options options_;
};

}  // namespace plaza
