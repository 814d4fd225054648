// The row kernels, written once as loops that compilers vectorise, and compiled once per
// instruction set. Nothing of the standard library is used here: an inline function compiled with
// AVX2 could be the copy that the linker keeps for everybody.
//
// The including file defines PLAZA_ROW_KERNELS (the variable) and PLAZA_ROW_KERNELS_NAME.

#include "modalities/color/row_kernels.h"

namespace plaza::color {
namespace {

void moments(const std::uint8_t* __restrict bgr, const std::uint8_t* __restrict blue,
             const std::uint8_t* __restrict green, const std::uint8_t* __restrict red,
             std::int32_t* __restrict along, std::int32_t* __restrict change, int n) {
  for (int x = 0; x < n; ++x) {
    // 16 bits hold the factors: pairs of products are one instruction on every x86
    const auto b = static_cast<std::int16_t>(blue[x]);
    const auto g = static_cast<std::int16_t>(green[x]);
    const auto r = static_cast<std::int16_t>(red[x]);
    const auto db = static_cast<std::int16_t>(bgr[3 * x] - b);
    const auto dg = static_cast<std::int16_t>(bgr[3 * x + 1] - g);
    const auto dr = static_cast<std::int16_t>(bgr[3 * x + 2] - r);
    along[x] = b * db + g * dg + r * dr;
    change[x] = db * db + dg * dg + dr * dr;
  }
}

void strength(RowKernels::Rows32 along_rows, RowKernels::Rows32 change_rows,
              const float* __restrict energy, const float* __restrict weight,
              std::int32_t* __restrict sums, std::uint16_t* __restrict out, int n) {
  std::int32_t* __restrict along = sums + 1;
  std::int32_t* __restrict change = sums + n + 3;
  const std::int32_t* __restrict a0 = along_rows[0];
  const std::int32_t* __restrict a1 = along_rows[1];
  const std::int32_t* __restrict a2 = along_rows[2];
  for (int x = -1; x <= n; ++x) along[x] = a0[x] + a1[x] + a2[x];
  const std::int32_t* __restrict c0 = change_rows[0];
  const std::int32_t* __restrict c1 = change_rows[1];
  const std::int32_t* __restrict c2 = change_rows[2];
  for (int x = -1; x <= n; ++x) change[x] = c0[x] + c1[x] + c2[x];
  for (int x = 0; x < n; ++x) {
    const auto p = static_cast<float>(along[x - 1] + along[x] + along[x + 1]);
    const auto q = static_cast<float>(change[x - 1] + change[x] + change[x + 1]);
    const float bb = energy[x];
    // with |f|^2 = |b|^2 + 2p + q and f.b = |b|^2 + p, written so that equal images give exact zero
    const float difference = 2.0F * p + q;
    const float product = bb + p;
    const float largest =
        0.5F * (2.0F * bb + difference +
                __builtin_sqrtf(difference * difference + 4.0F * product * product));
    float value = (bb * q - p * p) / (largest + 1e-6F);  // black on black is 0 / 0 otherwise
    value = value * weight[x] + 0.5F;
    value = value > 0.0F ? value : 0.0F;
    value = value < 65535.0F ? value : 65535.0F;
    out[x] = static_cast<std::uint16_t>(static_cast<std::int32_t>(value));
  }
}

void threshold(RowKernels::Rows8 previous, std::uint16_t start, std::uint16_t step,
               std::uint16_t* __restrict out, int n) {
  const std::uint8_t* __restrict r0 = previous[0];
  const std::uint8_t* __restrict r1 = previous[1];
  const std::uint8_t* __restrict r2 = previous[2];
  for (int x = 0; x < n; ++x) {
    const int ones = r0[x - 1] + r0[x] + r0[x + 1] + r1[x - 1] + r1[x] + r1[x + 1] + r2[x - 1] +
                     r2[x] + r2[x + 1];
    const int rest = start - step * ones;
    out[x] = static_cast<std::uint16_t>(rest > 0 ? rest : 0);
  }
}

void label(const std::uint16_t* __restrict strengths, const std::uint16_t* __restrict thresholds,
           RowKernels::Rows8 labels, std::uint16_t step, std::uint8_t* __restrict after, int n) {
  const std::uint8_t* __restrict r0 = labels[0];
  const std::uint8_t* __restrict r1 = labels[1];
  const std::uint8_t* __restrict r2 = labels[2];
  for (int x = 0; x < n; ++x) {
    const int ones = r0[x - 1] + r0[x] + r0[x + 1] + r1[x - 1] + r1[x + 1] + r2[x - 1] + r2[x] +
                     r2[x + 1];
    const int rest = thresholds[x] - step * ones;
    after[x] = strengths[x] > (rest > 0 ? rest : 0) ? 1 : 0;
  }
}

}  // namespace

const RowKernels PLAZA_ROW_KERNELS = {PLAZA_ROW_KERNELS_NAME, moments, strength, threshold, label};

}  // namespace plaza::color
