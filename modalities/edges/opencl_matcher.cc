#include "modalities/edges/opencl_matcher.h"

namespace plaza::edges {
namespace {

/// See sum_plain() in contour_sums.cc for the same on the CPU.
constexpr const char* kProgram = R"CL(
__kernel void contour_sums(__global const uchar* block, __global const uint* begins,
                           __global const uchar* lengths, __global const uint* firsts,
                           __global const uchar* peaks, __global const uint* which,
                           __global ulong* sums, int directions, int count) {
  const int direction = get_global_id(0);
  const int index = get_global_id(1);
  if (direction >= directions || index >= count) return;
  const uint place = which[index] * (uint)directions + (uint)direction;
  const int peak = peaks[direction];
  ulong squares = 0;
  ulong outliers = 0;
  for (uint run = firsts[place]; run < firsts[place + 1]; ++run) {
    __global const uchar* bytes = block + begins[run];
    uint sum = 0; /* of at most 16 squares of 254 */
    for (int i = 0; i < lengths[run]; ++i) {
      const int nearness = bytes[i];
      const int steps = max(peak - nearness, 0);
      sum += nearness == 0 ? 0 : (uint)(steps * steps);
      outliers += nearness == 0 ? 1 : 0;
    }
    squares += sum;
  }
  const size_t at = 2 * ((size_t)index * (size_t)directions + (size_t)direction);
  sums[at] = squares;
  sums[at + 1] = outliers;
}
)CL";

static_assert(sizeof(ContourSum) == 2 * sizeof(std::uint64_t), "is read as two ulongs");

DeviceContours upload_contours(const EdgeTemplates& templates) {
  const std::span<const std::uint32_t> counts = templates.all_counts();
  std::vector<std::uint32_t> firsts(counts.size() + 1, 0);
  for (std::size_t i = 0; i < counts.size(); ++i) firsts[i + 1] = firsts[i] + counts[i];
  const ContourRuns all = templates.all_runs();
  const std::size_t runs = firsts.back();
  return {.begins = opencl::upload(std::span(all.begins, runs)),
          .lengths = opencl::upload(std::span(all.lengths, runs)),
          .firsts = opencl::upload(std::span<const std::uint32_t>(firsts)),
          .peaks = opencl::upload(std::span(all.peaks, all.directions))};
}

}  // namespace

OpenclMatcher::OpenclMatcher() : program_(kProgram) {}

cv::UMat OpenclMatcher::upload(const ByteBlock& planes) {
  return opencl::upload_bytes(planes.data(), planes.size());
}

std::vector<ContourSum> OpenclMatcher::sums(const cv::UMat& planes, const EdgeTemplates& templates,
                                            std::span<const std::uint32_t> which) const {
  const DeviceContours& contours =
      templates.on_device().get([&] { return upload_contours(templates); });
  const std::size_t directions = templates.all_runs().directions;
  std::vector<ContourSum> sums(directions * which.size());
  const std::size_t bytes = sums.size() * sizeof(ContourSum);
  const cv::UMat asked = opencl::upload(which);
  const cv::UMat found = opencl::room_for(bytes);
  program_.run("contour_sums", {directions, which.size()}, opencl::in(planes),
               opencl::in(contours.begins), opencl::in(contours.lengths),
               opencl::in(contours.firsts), opencl::in(contours.peaks), opencl::in(asked),
               opencl::out(found), static_cast<int>(directions), static_cast<int>(which.size()));
  opencl::download_bytes(found, sums.data(), bytes);
  return sums;
}

}  // namespace plaza::edges
