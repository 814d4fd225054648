#include "modalities/color/light_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace plaza::color {
namespace {

constexpr int kClipped = 250;        // grey levels; noise and interpolation lower what was 255
constexpr int kDark = 12;            // of all channels, mean: below, ratios are noise
constexpr int kFringePx = 4;         // around foreground, to each side
constexpr int kLeastPixels = 32;     // of 128 that are looked at in a cell
constexpr double kLeastCells = 0.1;  // share that must be known to tell the light of all
constexpr float kMostHere = 0.9F;    // a factor of 2.5 either way

/// Values that can be compared in one cell.
struct CellSums {
  std::array<std::int64_t, 3> image = {}, background = {};
  int count = 0;
};

bool comparable(const uchar* image, const uchar* background) {
  for (int c = 0; c < 3; ++c) {
    if (image[c] >= kClipped || background[c] >= kClipped) return false;
  }
  return background[0] + background[1] + background[2] > 3 * kDark &&
         image[0] + image[1] + image[2] > kDark;
}

cv::Size cells_of(const cv::Mat& image) {
  return {(image.cols + kCellPx - 1) / kCellPx, (image.rows + kCellPx - 1) / kCellPx};
}

/// By cell, row after row, from every second row of pixels.
std::vector<CellSums> sums_by_cell(const cv::Mat& image, const cv::Mat& background,
                                   const cv::Mat& foreground) {
  cv::Mat excluded;
  if (!foreground.empty()) {
    const cv::Mat box =
        cv::getStructuringElement(cv::MORPH_RECT, {2 * kFringePx + 1, 2 * kFringePx + 1});
    cv::dilate(foreground, excluded, box);
  }
  const cv::Size cells = cells_of(image);
  std::vector<CellSums> sums(static_cast<std::size_t>(cells.area()));
  for (int y = 0; y < image.rows; y += 2) {
    const uchar* f = image.ptr(y);
    const uchar* b = background.ptr(y);
    const uchar* out = excluded.empty() ? nullptr : excluded.ptr(y);
    CellSums* const row = &sums[static_cast<std::size_t>((y / kCellPx) * cells.width)];
    for (int x = 0; x < image.cols; ++x, f += 3, b += 3) {
      if ((out != nullptr && out[x] != 0) || !comparable(f, b)) continue;
      CellSums& cell = row[x / kCellPx];
      ++cell.count;
      for (std::size_t c = 0; c < 3; ++c) {
        cell.image[c] += f[c];
        cell.background[c] += b[c];
      }
    }
  }
  return sums;
}

float log_ratio(const CellSums& cell, std::size_t channel) {
  return std::log((static_cast<float>(cell.image[channel]) + 0.5F) /
                  (static_cast<float>(cell.background[channel]) + 0.5F));
}

float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Mean of the cells around one, itself left out.
cv::Vec3f around(const cv::Mat3f& field, int y, int x) {
  cv::Vec3f sum(0, 0, 0);
  float count = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, field.rows - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, field.cols - 1); ++u) {
      if (v == y && u == x) continue;
      sum += field(v, u);
      count += 1;
    }
  }
  return count > 0 ? cv::Vec3f(sum * (1 / count)) : field(y, x);
}

}  // namespace

std::array<float, 3> light_of_all(const cv::Mat& image, const cv::Mat& background,
                                  const cv::Mat& foreground, const std::array<float, 3>& before) {
  const std::vector<CellSums> sums = sums_by_cell(image, background, foreground);
  std::array<std::vector<float>, 3> seen;
  for (const CellSums& cell : sums) {
    if (cell.count < kLeastPixels) continue;
    for (std::size_t c = 0; c < 3; ++c) seen[c].push_back(log_ratio(cell, c));
  }
  if (static_cast<double>(seen[0].size()) <
      std::max(1.0, kLeastCells * static_cast<double>(sums.size()))) {
    return before;
  }
  return {median(seen[0]), median(seen[1]), median(seen[2])};
}

cv::Mat3f light_of_cells(const cv::Mat& image, const cv::Mat& background, const cv::Mat& foreground,
                         const LightField& light, double seconds, const LightOptions& options) {
  if (options.rate_per_s <= 0) return {};
  const cv::Size cells = cells_of(image);
  const std::vector<CellSums> sums = sums_by_cell(image, background, foreground);
  const cv::Mat3f before = light.here.empty() ? cv::Mat3f(cells, cv::Vec3f(0, 0, 0)) : light.here;
  const auto step = static_cast<float>(options.rate_per_s * seconds);
  cv::Mat3f here(cells);
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      const CellSums& cell = sums[static_cast<std::size_t>(y * cells.width + x)];
      const bool known = cell.count >= kLeastPixels;
      const cv::Vec3f nearby = known ? cv::Vec3f() : around(before, y, x);
      for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        const float wish =
            std::clamp(known ? log_ratio(cell, channel) - light.all[channel] : nearby[c],
                       -kMostHere, kMostHere);
        here(y, x)[c] = before(y, x)[c] + std::clamp(wish - before(y, x)[c], -step, step);
      }
    }
  }
  return here;
}

cv::Mat relight(const cv::Mat& image, const cv::Mat& background, const LightField& light) {
  constexpr int kBits = 12;
  // reciprocal factors at the cells' centres, with a border that repeats the outermost ones
  const int across = light.here.empty() ? 1 : light.here.cols;
  const int down = light.here.empty() ? 1 : light.here.rows;
  cv::Mat3f factor(down + 2, across + 2);
  for (int y = 0; y < factor.rows; ++y) {
    for (int x = 0; x < factor.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        float log = light.all[static_cast<std::size_t>(c)];
        if (!light.here.empty()) {
          log += light.here(std::clamp(y - 1, 0, down - 1), std::clamp(x - 1, 0, across - 1))[c];
        }
        factor(y, x)[c] = std::exp(-log) * (1 << kBits);
      }
    }
  }
  cv::Mat out(image.size(), CV_8UC3);
  std::vector<cv::Vec3f> row(static_cast<std::size_t>(factor.cols));
  for (int y = 0; y < image.rows; ++y) {
    const float v = (static_cast<float>(y) + 0.5F) / kCellPx + 0.5F;
    const int above = light.here.empty() ? 0 : static_cast<int>(v);
    const float t = light.here.empty() ? 0 : v - static_cast<float>(above);
    for (int x = 0; x < factor.cols; ++x) {
      row[static_cast<std::size_t>(x)] = factor(above, x) * (1 - t) + factor(above + 1, x) * t;
    }
    const uchar* const f = image.ptr(y);
    const uchar* const b = background.ptr(y);
    uchar* const o = out.ptr(y);
    // from one cell's centre to the next the factor is a straight line
    for (int cell = 0, x = 0; x < image.cols; ++cell) {
      const int end =
          light.here.empty() ? image.cols : std::min(image.cols, cell * kCellPx + kCellPx / 2);
      const cv::Vec3f& left = row[static_cast<std::size_t>(light.here.empty() ? 0 : cell)];
      const cv::Vec3f& right = row[static_cast<std::size_t>(light.here.empty() ? 0 : cell + 1)];
      const int begin = cell * kCellPx - kCellPx / 2;
      for (int c = 0; c < 3; ++c) {
        const auto slope = static_cast<std::int32_t>(std::lround((right[c] - left[c]) / kCellPx));
        const auto start = static_cast<std::int32_t>(std::lround(left[c])) + slope / 2;
        for (int i = x; i < end; ++i) {
          const std::int32_t q = start + slope * (i - begin);
          const std::int32_t value = (f[3 * i + c] * q + (1 << (kBits - 1))) >> kBits;
          const std::int32_t kept = std::min(value, 255);
          const bool clipped = f[3 * i + c] >= kClipped && kept < b[3 * i + c];
          o[3 * i + c] = clipped ? b[3 * i + c] : static_cast<uchar>(kept);
        }
      }
      x = end;
    }
  }
  return out;
}

}  // namespace plaza::color
