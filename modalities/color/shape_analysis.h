#pragma once

#include <opencv2/core/mat.hpp>

#include "modalities/common/body_scale.h"

/// Shape analysis of a foreground mask (thesis 7.2): what can't be a person, nor a part of one, at
/// the place where it is seen, is no foreground.
namespace plaza::color {

struct ShapeOptions {
  double least_height_m = 0;  ///< of a connected piece; 0: pieces are as they are
  double least_column_m = 0;  ///< of an upright run of pixels; 0: runs are as they are
  double most_hole = 0;       ///< share of a body's box that a hole may have to be filled; 0: none

  bool any() const { return least_height_m > 0 || least_column_m > 0 || most_hole > 0; }
};

/// The mask (8-bit, 0 or 255) as it is when in this order
/// 1. holes, surrounded by a piece (8-neighbours) at least half as high as a body, are filled,
///    where they are as small as that;
/// 2. upright runs of pixels that would be lower than `least_column_m` if they stood where their
///    lower ends are, shadows and reflections that lie on the ground, are taken out;
/// 3. pieces (8-neighbours) that would be lower than `least_height_m` are taken out.
/// Where nobody can be seen, all stays as it is. The input isn't written to; with nothing asked for
/// it is what is returned.
cv::Mat analysed(const cv::Mat& mask, const BodyScale& scale, const ShapeOptions& options);

}  // namespace plaza::color
