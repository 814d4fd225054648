#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "plaza/core/export.h"
#include "plaza/scoring/paired_sequence.h"

namespace plaza {

/// Scores of people found frame by frame, without regard to who is who. Nothing where there is
/// nothing to divide by.
struct PLAZA_API DetectionScores {
  std::int64_t tp = 0, fn = 0, fp = 0;
  double goodness_sum = 0;             ///< over the matches, each in [0, 1]
  std::vector<double> frame_goodness;  ///< mean over the matches of each frame that has any

  std::optional<double> moda() const;        ///< 1 - (misses + false alarms) / people, thesis (3.1)
  std::optional<double> modp() const;        ///< mean goodness of all matches
  std::optional<double> frame_modp() const;  ///< thesis (3.3): mean of the frames' means
  std::optional<double> precision() const;   ///< thesis (3.4)
  std::optional<double> recall() const;      ///< thesis (3.5)
  std::optional<double> f1() const;
};

/// By overlap: per frame the sum of similarities is largest, those below `threshold` count nothing;
/// equality matches. The goodness of a match is its similarity. `threshold` is in (0, 1].
PLAZA_API DetectionScores score_overlap_detection(const PairedSequence& similarity,
                                                  double threshold);

/// By distance, as the WILDTRACK benchmark's evaluator (T. Chavdarova et al., 2018; the one that
/// comes with MVDet) does: per frame as many pairs within `threshold` as possible, of least sum; a
/// match is strictly nearer than `threshold`. The goodness of a match is 1 - distance / threshold.
PLAZA_API DetectionScores score_distance_detection(const PairedSequence& distance,
                                                   double threshold);

}  // namespace plaza
