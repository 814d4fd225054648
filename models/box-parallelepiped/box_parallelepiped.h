#pragma once

#include "plaza/component/declaration.h"

namespace plaza {

/// An upright box on the ground, for what is not a person: cars, trolleys, pallets (the thesis's
/// outlook, 7.2, asks for other objects). Its length lies along the pose's heading.
class BoxParallelepiped final : public ShapeModel {
 public:
  struct Options {
    double length_m = 4.5;
    double width_m = 1.8;
    double height_m = 1.5;
    double contour_step_px = 1;
  };
  static Declaration<Options> declare();
  BoxParallelepiped(const Options& options, const BuildContext& context);

 private:
  Silhouette do_silhouette(const Pose& pose, const Camera& camera) const override;
  /// The box's height, and the radius of the circle of the same area as its base.
  Body do_body() const override;

  Options options_;
};

}  // namespace plaza
