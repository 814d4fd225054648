#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "modalities/color/row_kernels.h"

namespace plaza::color {

struct LabelFieldOptions {
  double threshold = 4;        ///< strength of change, >= 0
  double neighbourhood = 0.5;  ///< per neighbour, >= 0
  double previous = 0.4;       ///< per pixel of the window, >= 0
  int iterations = 4;          ///< >= 1
};

/// The same in 16-bit steps.
struct LabelFieldSteps {
  explicit LabelFieldSteps(const LabelFieldOptions& options);
  std::uint16_t threshold, neighbourhood, previous;
  /// The threshold with no foreground around: at `threshold` itself half of the neighbours and,
  /// where there is a previous mask, half of its window are foreground.
  std::uint16_t start(bool with_previous) const;
};

/// Labels of the Markov random field over the pixels (Griesser et al. 2005, after T. Aach and A.
/// Kaup, "Bayesian algorithms for adaptive change detection in image sequences using Markov random
/// fields", 1995): foreground is compact and stays where it was.
///
/// With Gibbs potentials between pixels that touch, the Bayesian test of one pixel given its
/// neighbours is a threshold on its strength of change that falls with every foreground neighbour
/// and with every foreground pixel that the previous mask had in the 3 x 3 window:
///     foreground  <=>  strength > threshold + neighbourhood * (4 - n) + previous * (4.5 - m),
/// n of 8 neighbours now, m of 9 pixels before. The first labels have n = 4 everywhere; then all
/// pixels are labelled anew at once from the labels before, until none changes or `iterations` such
/// rounds are done. Beyond the border the outermost labels are repeated.
///
/// `strength` is 16-bit (see Criterion), `previous` an 8-bit mask of 0 and 255 or empty. Gives an
/// 8-bit mask of 0 and 255. `rounds`, if given, gets the number of rounds in which labels changed.
cv::Mat solve_labels(const cv::Mat& strength, const cv::Mat& previous,
                     const LabelFieldOptions& options,
                     const RowKernels& kernels = fastest_kernels(), int* rounds = nullptr);

}  // namespace plaza::color
