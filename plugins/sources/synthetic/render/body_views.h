#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "plaza/geometry/box.h"
#include "plugins/sources/synthetic/render/rays.h"
#include "plugins/sources/synthetic/render/static_view.h"

namespace plaza::synthetic {

/// How one body appears in one view, in the middle of the exposure.
struct BodyView {
  std::size_t body = 0;   ///< index into the bodies given
  Box box;                ///< of the whole body, hidden parts and parts beyond the image included
  double visibility = 0;  ///< visible share of its pixels, of those beyond the image too
};

/// By drawing every body's triangles into a depth image of its own and comparing them with each
/// other and with the stage. Bodies that the camera cannot project (behind it) or that have no
/// pixel on the image are left out.
std::vector<BodyView> body_views(std::span<const MovingBody> bodies, const StaticView& view);

}  // namespace plaza::synthetic
