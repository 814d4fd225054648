#pragma once

#include <cstdint>

#include "plaza/core/export.h"
#include "plaza/scoring/paired_sequence.h"

namespace plaza {

/// Identity scores (E. Ristani et al., "Performance measures and a data set for multi-target,
/// multi-camera tracking", 2016): one assignment of whole trajectories. 0 where there is nothing to
/// divide by.
struct PLAZA_API IdentityScores {
  std::int64_t idtp = 0, idfn = 0, idfp = 0;

  double idf1() const;
  double idp() const;
  double idr() const;
};

/// Pairs of similarity >= `threshold` count.
PLAZA_API IdentityScores score_identity(const PairedSequence& similarity, double threshold);

/// Pairs of finite distance count.
PLAZA_API IdentityScores score_identity_of_distance(const PairedSequence& distance);

}  // namespace plaza
