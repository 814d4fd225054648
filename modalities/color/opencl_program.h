#pragma once

namespace plaza::color {

/// The segmentation in OpenCL C; one work item per pixel. See row_kernels.inl for the same on the
/// CPU, and Criterion and solve_labels() for what it means. Steps and offsets are in bytes.
inline constexpr const char* kOpenclProgram = R"CL(
#pragma OPENCL FP_CONTRACT OFF
#define AT(type, base, step, offset, y, x) \
  (*(__global type*)(base + offset + (y) * (step) + (x) * (int)sizeof(type)))

__kernel void strength(__global const uchar* image, int image_step, int image_offset,
                       __global const uchar* background, int background_step,
                       int background_offset,
                       __global const uchar* energy, int energy_step, int energy_offset,
                       __global const uchar* weight, int weight_step, int weight_offset,
                       __global uchar* out, int out_step, int out_offset, int rows, int cols) {
  const int x = get_global_id(0);
  const int y = get_global_id(1);
  if (x >= cols || y >= rows) return;
  int along = 0;
  int change = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    const int v = clamp(y + dy, 0, rows - 1);
    for (int dx = -1; dx <= 1; ++dx) {
      const int u = clamp(x + dx, 0, cols - 1);
      __global const uchar* f = image + image_offset + v * image_step + 3 * u;
      __global const uchar* b = background + background_offset + v * background_step + 3 * u;
      for (int c = 0; c < 3; ++c) {
        const int d = (int)f[c] - (int)b[c];
        along += (int)b[c] * d;
        change += d * d;
      }
    }
  }
  const float p = (float)along;
  const float q = (float)change;
  const float bb = AT(const float, energy, energy_step, energy_offset, y, x);
  const float difference = 2.0f * p + q;
  const float product = bb + p;
  const float largest =
      0.5f * (2.0f * bb + difference + sqrt(difference * difference + 4.0f * product * product));
  float value = (bb * q - p * p) / (largest + 1e-6f);
  value = value * AT(const float, weight, weight_step, weight_offset, y, x) + 0.5f;
  value = fmin(fmax(value, 0.0f), 65535.0f);
  AT(ushort, out, out_step, out_offset, y, x) = (ushort)(int)value;
}

__kernel void threshold(__global const uchar* previous, int previous_step, int previous_offset,
                        __global uchar* out, int out_step, int out_offset, int rows, int cols,
                        int start, int step) {
  const int x = get_global_id(0);
  const int y = get_global_id(1);
  if (x >= cols || y >= rows) return;
  int ones = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      ones += AT(const uchar, previous, previous_step, previous_offset,
                 clamp(y + dy, 0, rows - 1), clamp(x + dx, 0, cols - 1)) >> 7;
    }
  }
  AT(ushort, out, out_step, out_offset, y, x) = (ushort)max(start - step * ones, 0);
}

/* first != 0: labels as if half of every pixel's neighbours were foreground, whatever is in before */
__kernel void label(__global const uchar* strengths, int strengths_step, int strengths_offset,
                    __global const uchar* thresholds, int thresholds_step, int thresholds_offset,
                    __global const uchar* before, int before_step, int before_offset,
                    __global uchar* after, int after_step, int after_offset, int rows, int cols,
                    int step, int first) {
  const int x = get_global_id(0);
  const int y = get_global_id(1);
  if (x >= cols || y >= rows) return;
  int ones = 4;
  if (!first) {
    ones = 0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        ones += AT(const uchar, before, before_step, before_offset, clamp(y + dy, 0, rows - 1),
                   clamp(x + dx, 0, cols - 1)) >> 7;
      }
    }
  }
  const int rest =
      (int)AT(const ushort, thresholds, thresholds_step, thresholds_offset, y, x) - step * ones;
  const int s = AT(const ushort, strengths, strengths_step, strengths_offset, y, x);
  AT(uchar, after, after_step, after_offset, y, x) = s > max(rest, 0) ? 255 : 0;
}
)CL";

}  // namespace plaza::color
