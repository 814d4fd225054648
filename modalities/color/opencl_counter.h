#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "modalities/color/occupancy.h"
#include "modalities/common/opencl.h"

namespace plaza::color {

/// Counts in silhouettes by OpenCL, one work item per template and region. They are integers, and
/// what follows from them is computed by the caller: likelihoods are the CPU's bit by bit.
class OpenclCounter {
 public:
  /// Throws UserError when there is no device or when it refuses the program.
  OpenclCounter();

  static cv::UMat upload(const AreaCounts& counts);
  /// Of piece which[i], where nothing was explained; `foreground` and `blind`, which may be
  /// empty, are of upload(), `stride` is theirs. Templates go to the device once. Thread-safe.
  std::vector<TemplateCounts> count(const cv::UMat& foreground, const cv::UMat& blind,
                                    std::size_t stride, const SpanTemplates& templates,
                                    std::span<const std::uint32_t> which) const;

 private:
  opencl::Program program_;
};

}  // namespace plaza::color
