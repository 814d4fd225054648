#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "plaza/core/export.h"
#include "plaza/data/frames.h"

namespace plaza {

/// Which frames a node wants to see before the stream starts. All learners share one pass over the
/// source.
struct LearningPlan {
  /// Only frames that the source marks as people-free, after its backgrounds (Source::background),
  /// which nobody else sees.
  bool people_free_only = false;
  std::optional<std::int64_t> first;  ///< only frames [0, first); backgrounds are not among them
  std::int64_t every = 1;             ///< every n-th of them; >= 1
};

/// What a node knows after a pass over frames (a background, a template hierarchy). The kernel
/// caches it under a key of the node's resolved parameters, its plugin, the scene, the source with
/// its files, and extra_key(); a damaged or stale entry is learned again.
class PLAZA_API Learner {
 public:
  virtual ~Learner();

  /// Nothing: there is something to compute but no frames are needed (finish() does it).
  std::optional<LearningPlan> plan() const;  ///< checks every >= 1, first >= 1
  void learn(const FrameSet& frames) { do_learn(frames); }
  /// Ends learning after `seen` frames. Throws UserError when they were too few, saying how many it
  /// needs.
  void finish(std::int64_t seen) { do_finish(seen); }
  void save(std::ostream& out) const { do_save(out); }
  /// Restores what save() wrote; throws Error when the content does not fit, after which the kernel
  /// learns anew on a fresh object.
  void load(std::istream& in) { do_load(in); }
  std::string extra_key() const { return do_extra_key(); }

 protected:
  virtual std::optional<LearningPlan> do_plan() const = 0;
  virtual void do_learn(const FrameSet& frames) = 0;
  virtual void do_finish(std::int64_t seen) = 0;
  virtual void do_save(std::ostream& out) const = 0;
  virtual void do_load(std::istream& in) = 0;
  virtual std::string do_extra_key() const;
};

}  // namespace plaza
