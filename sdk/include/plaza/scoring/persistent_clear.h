#pragma once

#include <cstdint>
#include <optional>

#include "plaza/core/export.h"
#include "plaza/scoring/paired_sequence.h"

namespace plaza {

/// CLEAR MOT as py-motmetrics 1.2.0 counts it, the field's choice on the ground plane. Nothing
/// where there is nothing to divide by.
struct PLAZA_API PersistentClearScores {
  std::int64_t frames = 0;
  std::int64_t objects = 0;      ///< true people, summed over the frames
  std::int64_t predictions = 0;  ///< the same of the result
  std::int64_t matches = 0;      ///< without the switches
  std::int64_t switches = 0;
  std::int64_t transfers = 0;  ///< a result identity goes over to another true one
  std::int64_t ascends = 0;    ///< switches to an identity that was never matched before
  std::int64_t migrates = 0;   ///< transfers to a true identity that was never matched before
  std::int64_t misses = 0;
  std::int64_t false_positives = 0;
  std::int64_t fragments = 0;  ///< runs of misses between two matches
  std::int64_t unique_objects = 0;
  std::int64_t mostly_tracked = 0;  ///< matched in at least 80 % of its frames
  std::int64_t partly_tracked = 0;  ///< at least 20 %
  std::int64_t mostly_lost = 0;
  double distance_sum = 0;  ///< over matches and switches

  std::int64_t detections() const { return matches + switches; }
  std::optional<double> mota() const;
  std::optional<double> moda() const;
  std::optional<double> mean_distance() const;
  std::optional<double> recall() const;
  std::optional<double> precision() const;
};

/// `distance` has +infinity where a pair can't be. An object keeps the identity it was matched to
/// last, however long ago, as soon as that is possible again, in the order of the rows; the rest is
/// matched by least distance, as many pairs as possible first.
PLAZA_API PersistentClearScores score_persistent_clear(const PairedSequence& distance);

}  // namespace plaza
