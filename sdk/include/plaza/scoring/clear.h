#pragma once

#include <cstdint>
#include <vector>

#include "plaza/core/export.h"
#include "plaza/scoring/paired_sequence.h"

namespace plaza {

/// CLEAR MOT (K. Bernardin and R. Stiefelhagen, "Evaluating multiple object tracking performance",
/// 2008) as TrackEval counts it. Ratios are fractions; where there is nothing to divide by, they
/// are 0, as there.
struct PLAZA_API ClearScores {
  std::int64_t tp = 0, fn = 0, fp = 0;
  std::int64_t id_switches = 0;
  std::int64_t fragments = 0;
  std::int64_t mostly_tracked = 0;       ///< matched in more than 80 % of its frames
  std::int64_t partly_tracked = 0;       ///< at least 20 %
  std::int64_t mostly_lost = 0;          ///< the rest
  double similarity_sum = 0;             ///< over the matches
  std::vector<std::int64_t> present;     ///< frames per true identity
  std::vector<std::int64_t> matched;     ///< of these, matched ones
  std::vector<double> frame_similarity;  ///< mean over the matches of each frame that has any

  double mota() const;
  double motp() const;  ///< mean similarity of the matches
  double moda() const;
  double recall() const;
  double precision() const;
  double f1() const;
  double smota() const;  ///< matches weigh as much as they are similar
  double motal() const;  ///< the logarithm of the switches counts
};

/// Matches each frame by itself: the sum of 1000 * [matched to the same identity in the previous
/// processed frame] + similarity is largest, and pairs below `threshold` give nothing. A switch is
/// a match to another identity than the last one ever; frames without truth or without results
/// leave the memory of the previous frame alone. `threshold` is in (0, 1]; equality matches.
PLAZA_API ClearScores score_clear(const PairedSequence& similarity, double threshold);

}  // namespace plaza
