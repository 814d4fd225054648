#pragma once

// The definitions once more, slowly and in another way: raw identities in maps, every assignment
// tried, trajectories compared pair by pair. For small inputs without ties.

#include <cstdint>
#include <map>
#include <vector>

#include "sequences.h"

namespace plaza::testing_support {

struct SlowClear {
  std::int64_t tp = 0, fn = 0, fp = 0, switches = 0, fragments = 0;
  std::int64_t mostly_tracked = 0, partly_tracked = 0, mostly_lost = 0;
  double similarity_sum = 0;
};
SlowClear slow_clear(const std::vector<FrameOf>& frames, double threshold);

/// Frames shared by the best one-to-one partnership of whole trajectories.
std::int64_t slow_idtp(const std::vector<FrameOf>& frames, double threshold);

struct SlowHota {
  double det_a = 0, ass_a = 0, loc_a = 0;
};
SlowHota slow_hota(const std::vector<FrameOf>& frames, double alpha);

}  // namespace plaza::testing_support
