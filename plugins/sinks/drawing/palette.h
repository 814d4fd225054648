#pragma once

#include <opencv2/core/types.hpp>

#include "plaza/data/track.h"

namespace plaza::drawing {

/// A colour in OpenCV's order, blue, green, red, each in [0, 255].
using Color = cv::Scalar;

/// The colour of a person, the same in every view, plan and run.
///
/// Hues go round in steps of the golden angle, so that any few consecutive ids are far apart, at
/// middle lightness of OKLCH (B. Ottosson, "A perceptual color space for image processing", 2020),
/// so that all of them can be told from black as well as from white.
Color color_of(TrackId id);

/// Black or white, whichever has the higher contrast to `background` (WCAG 2.1 relative luminance).
Color ink_on(const Color& background);

/// `share` of `a`, the rest `b`; `share` in [0, 1].
Color mix(const Color& a, const Color& b, double share);

/// The colours of a picture that are not people's.
struct Theme {
  Color paper;  ///< behind everything
  Color floor;  ///< the tracking area in a plan
  Color grid;
  Color border;  ///< of the area
  Color text;
  Color quiet_text;
  Color camera;
};

/// Around images, where a bright frame would blind.
const Theme& dark_theme();
/// For pictures in documents.
const Theme& light_theme();

}  // namespace plaza::drawing
