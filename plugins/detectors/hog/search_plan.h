#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "plaza/geometry/scene.h"

namespace plaza {

/// One image scale and the part of the image where people are that large.
struct SearchLevel {
  double body_height_px = 0;  ///< of the people that this level looks for
  cv::Rect region;            ///< pixels, inside the image, with room around the bodies
};

struct SearchPlanOptions {
  double scale_step = 1.1;      ///< ratio of neighbouring levels' body heights, > 1
  double min_height_px = 30.0;  ///< smaller bodies are not looked for
  double height_spread =
      0.1;                ///< people are up to this share taller or smaller than the scene's body
  double margin_m = 0.0;  ///< how far outside the area people are looked for
  double room = 0.5;      ///< room around bodies, as a share of their height
};

/// Where to look for people of which size: on the ground, a person's place says how large they
/// appear, so each scale needs only a strip of the image. A pyramid over the whole image would
/// search several times as many windows, and find people who float or sink.
///
/// Levels by rising height; scales at which nobody can be seen are left out.
std::vector<SearchLevel> plan_search(const Camera& camera, const Scene& scene,
                                     const SearchPlanOptions& options);

}  // namespace plaza
