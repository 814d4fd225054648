#pragma once

#include <span>

#include "plaza/component/component.h"
#include "plaza/data/track.h"

namespace plaza {

/// One end of a possible link between two moments.
struct AffinityEnd {
  const Observation* observation = nullptr;  ///< never null
  double time_s = 0;
};

/// How well two observations at different times fit one person, by one cue (6.9-6.12). Stateless.
class PLAZA_API AffinityTerm : public Component {
 public:
  ~AffinityTerm() override;
  /// log A of links from `from` to each of `to`, A in (0, 1]; 0 where the cue is missing on either
  /// side. `log_affinity.size()` equals `to.size()`; times in `to` are later than `from`'s.
  void evaluate(const AffinityEnd& from, std::span<const AffinityEnd> to,
                std::span<double> log_affinity) const;

 protected:
  virtual void do_evaluate(const AffinityEnd& from, std::span<const AffinityEnd> to,
                           std::span<double> log_affinity) const = 0;
};

}  // namespace plaza
