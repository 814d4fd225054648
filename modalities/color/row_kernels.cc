#include "modalities/color/row_kernels.h"

namespace plaza::color {

const std::vector<const RowKernels*>& available_kernels() {
  static const std::vector<const RowKernels*> kAvailable = [] {
    std::vector<const RowKernels*> found = {&kScalarKernels};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("sse4.1") != 0) found.push_back(&kSse41Kernels);
    if (__builtin_cpu_supports("avx2") != 0) found.push_back(&kAvx2Kernels);
#endif
    return found;
  }();
  return kAvailable;
}

const RowKernels& fastest_kernels() { return *available_kernels().back(); }

}  // namespace plaza::color
