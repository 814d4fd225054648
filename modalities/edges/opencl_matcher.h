#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "modalities/common/opencl.h"
#include "modalities/edges/contour_sums.h"
#include "modalities/edges/fast_transform.h"
#include "modalities/edges/templates.h"

namespace plaza::edges {

/// The sums of contours by OpenCL, one work item per template and direction. They are integers, and
/// what follows from them is computed by the caller: likelihoods are the CPU's bit by bit.
class OpenclMatcher {
 public:
  /// Throws UserError when there is no device or when it refuses the program.
  OpenclMatcher();

  static cv::UMat upload(const ByteBlock& planes);
  /// [i * directions + direction], of template which[i]; `planes` are of upload(). Templates go to
  /// the device once. Thread-safe.
  std::vector<ContourSum> sums(const cv::UMat& planes, const EdgeTemplates& templates,
                               std::span<const std::uint32_t> which) const;

 private:
  opencl::Program program_;
};

}  // namespace plaza::edges
