#pragma once

#include <cstdint>
#include <vector>

namespace plaza::color {

/// Strengths of change, thresholds and weights are 16-bit fixed point: 64 steps are 1.
inline constexpr int kStepsPerUnit = 64;

/// The inner loops of the segmentation, over one image row of `n` pixels each. There is one set per
/// instruction set; all give the same bytes: sums are integers, and floating point is used only
/// where IEEE 754 fixes every bit (no fused operations, no reassociation).
///
/// Three rows are given as { above, here, below }, each readable one element before and one behind
/// the row.
struct RowKernels {
  using Rows8 = const std::uint8_t* const*;
  using Rows32 = const std::int32_t* const*;

  const char* name;  ///< "scalar", "sse4.1", "avx2"

  /// along[x] = background . (image - background), change[x] = |image - background|^2, over the
  /// three channels of the pixel. `bgr` is interleaved, the background three planes.
  void (*moments)(const std::uint8_t* bgr, const std::uint8_t* blue, const std::uint8_t* green,
                  const std::uint8_t* red, std::int32_t* along, std::int32_t* change, int n);
  /// out[x] = min(65535, round(weight[x] * smallest eigenvalue)), see Criterion. `sums` is room for
  /// 2 * (n + 2) values.
  void (*strength)(Rows32 along, Rows32 change, const float* energy, const float* weight,
                   std::int32_t* sums, std::uint16_t* out, int n);
  /// out[x] = max(0, start - step * number of ones in the 3 x 3 window of `previous`).
  void (*threshold)(Rows8 previous, std::uint16_t start, std::uint16_t step, std::uint16_t* out,
                    int n);
  /// after[x] = strength[x] > max(0, threshold[x] - step * number of ones around x in `labels`).
  void (*label)(const std::uint16_t* strength, const std::uint16_t* threshold, Rows8 labels,
                std::uint16_t step, std::uint8_t* after, int n);
};

/// Those that this CPU can run, the scalar one first, the fastest last.
const std::vector<const RowKernels*>& available_kernels();
/// The last of them.
const RowKernels& fastest_kernels();

// Each compiled for its instruction set; call through available_kernels().
extern const RowKernels kScalarKernels;
extern const RowKernels kSse41Kernels;
extern const RowKernels kAvx2Kernels;

}  // namespace plaza::color
