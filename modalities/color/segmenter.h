#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "modalities/color/criterion.h"
#include "modalities/color/label_field.h"

namespace plaza::color {

struct Segmentation {
  cv::Mat strength;  ///< of change: 16-bit, 64 steps are 1 (see Criterion)
  cv::Mat mask;      ///< 8-bit, 0 or 255
};

/// Foreground of one view's images against its background. Safe to share between threads.
class Segmenter {
 public:
  virtual ~Segmenter() = default;
  Segmenter(const Segmenter&) = delete;
  Segmenter& operator=(const Segmenter&) = delete;
  /// `image` is 8-bit BGR of the background's size; `previous` a mask of that size or empty.
  virtual Segmentation segment(const cv::Mat& image, const cv::Mat& previous) const = 0;

 protected:
  Segmenter() = default;
};

/// On one core, with the fastest instruction set of the CPU.
std::unique_ptr<Segmenter> make_cpu_segmenter(const Criterion& criterion,
                                              const LabelFieldOptions& options,
                                              const RowKernels& kernels = fastest_kernels());

}  // namespace plaza::color
