#pragma once

#include <opencv2/core/mat.hpp>

#include "modalities/common/body_scale.h"

namespace plaza::color {

/// The mask (8-bit, 0 or 255) without the shadows that people's feet stand on: from the lower end
/// of each upright run of its pixels upwards, as long as a pixel may be the background in shadow,
/// and at most `most_m` metres high if it stood where that end is. What comes first from below is
/// the shoe, where there is one; what is as dark and as colourless higher up stays.
///
/// A pixel may be shadow when every channel, in the mean of the 3 x 3 pixels around, is what is
/// left of the background's when some light goes: between a third of it and all, blue at least as
/// much as green and green as red, since the sky still shines where the sun doesn't, and no two
/// neighbours in that order more than a sixth apart (after T. Horprasert, D. Harwood and L. S.
/// Davis, "A statistical approach for real-time robust background subtraction and shadow
/// detection", ICCV Frame-Rate Workshop 1999, whose light is white).
///
/// `image` and `background` are 8-bit BGR of the mask's size. Runs that end at the image's border
/// stay as they are, and all where nobody can be seen.
cv::Mat without_shadows(const cv::Mat& mask, const cv::Mat& image, const cv::Mat& background,
                        const BodyScale& scale, double most_m);

}  // namespace plaza::color
