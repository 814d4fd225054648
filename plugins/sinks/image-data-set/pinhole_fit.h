#pragma once

#include <optional>

#include "plaza/geometry/camera.h"

namespace plaza::data_set {

/// The intrinsic numbers of a camera, found from what it projects: exact for pinhole cameras with
/// or without Brown-Conrady distortion. Nothing for cameras of another kind (Tsai's lens, skewed
/// pixels), whose points a pinhole camera would miss by more than `tolerance_px` somewhere in the
/// image.
std::optional<PinholeIntrinsics> fit_pinhole(const Camera& camera, double tolerance_px = 1e-4);

}  // namespace plaza::data_set
