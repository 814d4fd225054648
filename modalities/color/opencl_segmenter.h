#pragma once

#include <memory>

#include "modalities/color/segmenter.h"

namespace plaza::color {

/// The same segmentation by OpenCL, through OpenCV's buffers and queues. Integer steps are the
/// CPU's; strengths differ from the CPU's by at most kOpenclTolerance steps, since OpenCL leaves
/// the last bits of division and square root to the device, and a label can differ only where a
/// strength, or a neighbour's, is that close to its threshold.
/// Throws UserError when there is no device or when it refuses the program, with its own words.
std::unique_ptr<Segmenter> make_opencl_segmenter(const Background& background,
                                                 const Criterion& criterion,
                                                 const LabelFieldOptions& options);

inline constexpr int kOpenclTolerance = 1;  ///< steps of 1/64

}  // namespace plaza::color
