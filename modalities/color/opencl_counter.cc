#include "modalities/color/opencl_counter.h"

namespace plaza::color {
namespace {

/// See count_in() in occupancy.cc for the same on the CPU. `runs` are x, plus_row, minus_row.
constexpr const char* kProgram = R"CL(
uint count_in(__global const ushort* runs, uint begin, uint end, __global const uint* counts,
              uint stride) {
  uint sum = 0;
  for (uint run = begin; run < end; ++run) {
    const uint x = runs[3 * run];
    sum += counts[runs[3 * run + 1] * stride + x] - counts[runs[3 * run + 2] * stride + x];
  }
  return sum;
}

__kernel void count(__global const uint* foreground, __global const uint* blind,
                    __global const ushort* runs, __global const uint* bounds,
                    __global const uint* which, __global uint* counts, int stride, int has_blind,
                    int templates) {
  const int region = get_global_id(0);
  const int index = get_global_id(1);
  if (region >= 3 || index >= templates) return;
  const uint begin = bounds[4 * which[index] + (uint)region];
  const uint end = bounds[4 * which[index] + (uint)region + 1];
  const int at = 2 * (3 * index + region);
  counts[at] = count_in(runs, begin, end, foreground, (uint)stride);
  counts[at + 1] = has_blind ? count_in(runs, begin, end, blind, (uint)stride) : 0;
}
)CL";

static_assert(sizeof(BoundaryRun) == 3 * sizeof(std::uint16_t), "is read as three ushorts");
static_assert(sizeof(TemplateCounts) == 6 * sizeof(std::uint32_t), "is read as six uints");

DeviceRegions upload_regions(const SpanTemplates& templates) {
  std::vector<std::uint32_t> bounds;
  std::uint32_t end = 0;
  for (std::size_t i = 0; i < templates.pieces(); ++i) {
    const SpanTemplate& t = templates.at(i);
    bounds.insert(bounds.end(), {t.inner, t.near, t.outer, t.end});
    end = t.end;
  }
  return {.runs = opencl::upload(templates.runs(0, end)),
          .bounds = opencl::upload(std::span<const std::uint32_t>(bounds))};
}

}  // namespace

OpenclCounter::OpenclCounter() : program_(kProgram) {}

cv::UMat OpenclCounter::upload(const AreaCounts& counts) {
  return opencl::upload(std::span(counts.data(), counts.size()));
}

std::vector<TemplateCounts> OpenclCounter::count(const cv::UMat& foreground, const cv::UMat& blind,
                                                 std::size_t stride, const SpanTemplates& templates,
                                                 std::span<const std::uint32_t> which) const {
  const DeviceRegions& regions =
      templates.on_device().get([&] { return upload_regions(templates); });
  std::vector<TemplateCounts> counts(which.size());
  const std::size_t bytes = counts.size() * sizeof(TemplateCounts);
  const cv::UMat asked = opencl::upload(which);
  const cv::UMat found = opencl::room_for(bytes);
  program_.run("count", {3, which.size()}, opencl::in(foreground),
               opencl::in(blind.empty() ? foreground : blind), opencl::in(regions.runs),
               opencl::in(regions.bounds), opencl::in(asked), opencl::out(found),
               static_cast<int>(stride), blind.empty() ? 0 : 1, static_cast<int>(which.size()));
  opencl::download_bytes(found, counts.data(), bytes);
  return counts;
}

}  // namespace plaza::color
