#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

/// The inner loop of the fast transform, for each instruction set.
namespace plaza::edges {

/// Bytes that a sweep handles at once: rows of planes are padded to a multiple of it.
inline constexpr int kSweepBytes = 32;

/// One plane to fill. Rows run across the direction's lines, so that a line takes one pixel of
/// every row: image rows for steep directions, image columns for flat ones.
struct SweepTask {
  const std::uint8_t* edges = nullptr;  ///< as `plane`: 255 at edges, else 0, padding 0
  std::uint8_t* plane = nullptr;        ///< written
  int rows = 0;
  int columns = 0;                     ///< without padding
  std::ptrdiff_t stride = 0;           ///< multiple of kSweepBytes, > columns
  const std::int8_t* drift = nullptr;  ///< [rows] how far lines move from the row before: -1, 0, 1
  std::uint8_t peak = 0;               ///< value at edges: steps within the gate, plus one
};

/// Fills the plane with nearness: `peak` at edges, one less per step along the line to the nearest
/// edge, 0 beyond the gate and in the padding. Two passes, down and up, each a saturating
/// subtraction from the row before and a maximum.
///
/// Needs one readable byte before the first row (0) and kSweepBytes behind the last.
using Sweep = void (*)(const SweepTask& task);

struct SweepVersion {
  const char* name;  ///< "plain", "sse2", "avx2"
  Sweep run;
};

/// What this processor can run, slowest first; never empty.
std::span<const SweepVersion> sweep_versions();

}  // namespace plaza::edges
