#pragma once

#include <array>
#include <cstdint>

#include "plaza/core/export.h"
#include "plaza/scoring/paired_sequence.h"

namespace plaza {

/// Higher order tracking accuracy (J. Luiten et al., "HOTA: A higher order metric for evaluating
/// multi-object tracking", 2021) at its 19 localisation thresholds 0.05, 0.10, ... 0.95.
struct HotaScores {
  static constexpr std::size_t kThresholds = 19;
  using Array = std::array<double, kThresholds>;
  using Counts = std::array<std::int64_t, kThresholds>;

  Array alpha{};
  Counts tp{}, fn{}, fp{};
  Array hota{}, det_a{}, ass_a{};
  Array det_re{}, det_pr{}, ass_re{}, ass_pr{};
  Array loc_a{};  ///< 1 at a threshold without a match
  Array owta{};   ///< open-world: recall in place of detection accuracy

  /// The figure that is reported: the mean over the thresholds.
  PLAZA_API static double mean(const Array& values);
};

/// `similarity` in [0, 1]. One matching per frame serves all thresholds: it maximises similarity
/// weighted with how well the two trajectories agree over the whole sequence.
PLAZA_API HotaScores score_hota(const PairedSequence& similarity);

}  // namespace plaza
