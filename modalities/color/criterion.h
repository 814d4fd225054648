#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "modalities/color/background.h"
#include "modalities/color/row_kernels.h"

namespace plaza::color {

struct CriterionOptions {
  double darkness = 100;        ///< grey levels, >= 0
  double least_noise_px = 2.5;  ///< grey levels, > 0
};

/// The extended collinearity criterion (A. Griesser, S. De Roeck, A. Neubeck and L. Van Gool,
/// "GPU-based foreground-background segmentation using an extended colinearity criterion", VMV
/// 2005; thesis 5.4.1).
///
/// All colours of the 3 x 3 window around a pixel are stacked into one vector, f in the image and b
/// in the background, 27 values each. Where only the light changed (shadow, clouds, exposure) f and
/// b are collinear, up to noise: the best common direction leaves as squared distance from it the
/// smallest eigenvalue of
///     [ f.f  f.b ]
///     [ f.b  b.b ].
/// Near black every vector is collinear with every other within the noise, so dark clothes and dark
/// grounds would be background. The extension appends a constant to both vectors ("darkness"): an
/// angle then opens between a dark and a bright window however their colours are mixed, at the
/// price that strong changes of light count as changes.
///
/// The strength of change is that eigenvalue in units of what noise alone gives on the average,
///     s = 2 * eigenvalue / (26 * sigma^2),
/// sigma^2 being the window's mean variance of one channel of (image - background), at least
/// least_noise_px^2. The background is far less noisy than an image, hence the 2; 26 is the
/// window's degrees of freedom. Windows at the border repeat the outermost pixels.
class Criterion {
 public:
  /// Throws std::invalid_argument when the background is empty.
  Criterion(const Background& background, const CriterionOptions& options);

  cv::Size size() const { return size_; }
  /// Strength of change of every pixel: 16-bit, 64 steps are 1, saturated. `image` is 8-bit BGR of
  /// the background's size.
  cv::Mat strength(const cv::Mat& image, const RowKernels& kernels = fastest_kernels()) const;

  /// For the OpenCL path: float, 1 channel; |b|^2 of the window with the darkness' share, and 64 *
  /// s for an eigenvalue of 1.
  const cv::Mat& energy() const { return energy_; }
  const cv::Mat& weight() const { return weight_; }

 private:
  cv::Size size_;
  cv::Mat planes_[3];  ///< blue, green, red of the background, 8-bit
  cv::Mat energy_;
  cv::Mat weight_;
};

}  // namespace plaza::color
