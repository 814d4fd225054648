#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

/// The inner loop of matching, for each instruction set.
namespace plaza::edges {

/// Most bytes in a run of contour points.
inline constexpr int kLongestRun = 16;

/// A contour as runs of neighbouring bytes in a block of planes: most of a silhouette's contour
/// runs along the rows of its direction's plane, so a run is read at once.
struct ContourRuns {
  const std::uint32_t* begins =
      nullptr;  ///< index of each run's first byte, direction by direction
  const std::uint8_t* lengths = nullptr;  ///< 1 to kLongestRun
  const std::uint32_t* counts = nullptr;  ///< [direction] runs
  const std::uint8_t* peaks = nullptr;    ///< [direction] nearness at an edge: gate + 1
  std::size_t directions = 0;
};

/// Over the points of one direction.
struct ContourSum {
  std::uint64_t squares = 0;   ///< of steps to the nearest edge, of points with one within the gate
  std::uint64_t outliers = 0;  ///< points without
  bool operator==(const ContourSum&) const = default;
};

/// Reads `block` up to kLongestRun - 1 bytes behind the last point; sums[direction] is written.
using SumContour = void (*)(const std::uint8_t* block, const ContourRuns& runs, ContourSum* sums);

/// The same of runs that lie anywhere: bytes[run] is the first of a run; `begins` isn't read.
using SumPieces = void (*)(const std::uint8_t* const* bytes, const ContourRuns& runs,
                           ContourSum* sums);

struct SumContourVersion {
  const char* name;  ///< "plain", "sse2", "avx2"
  SumContour run;
  SumPieces run_pieces;
};

/// What this processor can run, slowest first; never empty. All give the same sums.
std::span<const SumContourVersion> sum_contour_versions();

}  // namespace plaza::edges
