#pragma once

#include <cstdint>

#include "plugins/sources/synthetic/body/body_shape.h"
#include "plugins/sources/synthetic/body/look.h"

namespace plaza::synthetic {

/// What is seen at a point of a body's surface.
struct BodySurface {
  Rgb albedo = Rgb::Zero();
  Vec3 bump = Vec3::Zero();  ///< added to the unit normal, in the bind pose's axes: folds of cloth
  float gloss = 0;           ///< share of light mirrored towards grazing views: hair, leather
};

/// Colours and folds of one person's surface, as a function of the place in the bind pose, so that
/// seams are sharp whatever the mesh's resolution.
class Clothes {
 public:
  Clothes(BodyShape shape, const Look& look);
  const BodyShape& shape() const { return shape_; }
  BodySurface at(const Vec3& rest) const;

 private:
  Rgb top(const Vec3& p, const BodyShape::ArmPlace& arm, bool on_sleeve) const;
  Rgb face(const Vec3& p) const;
  Rgb front(const Vec3& p, const Rgb& plain) const;
  Rgb back(const Vec3& p, const Rgb& plain) const;

  BodyShape shape_;
  Look look_;
  float phase_;  // of repeated patterns, [0, 1)
};

}  // namespace plaza::synthetic
