#pragma once

#include <vector>

#include "plaza/component/node.h"
#include "plaza/data/frames.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"

namespace plaza {

struct AssociatorInput {
  std::int64_t frame = 0;  ///< from 0
  std::int64_t time_ns = 0;
  const Observations* observations = nullptr;  ///< null when not declared as input
  const Tracklets* tracklets = nullptr;
};

struct AssociatorOutput {
  std::vector<TrackPoint> points;
  std::vector<Tracklet> tracklets;
};

/// Says who is who over time. push() in frame order, then flush() once.
///
/// Written invariants: ids > 0; a point's frame has been pushed; each (id, frame) becomes final at
/// most once and is not spoken of afterwards; after flush() nothing is open that is part of the
/// answer. Node ports: inputs as declared (Observations or Tracklets); out 0 Tracks, out 1
/// Tracklets if declared.
class PLAZA_API Associator : public Node {
 public:
  ~Associator() override;
  /// Frames must rise; else std::invalid_argument.
  AssociatorOutput push(const AssociatorInput& input);
  AssociatorOutput flush_tracks();

 protected:
  virtual AssociatorOutput do_push(const AssociatorInput& input) = 0;
  virtual AssociatorOutput do_flush_tracks() = 0;

 private:
  void do_process(NodeIo& io) final;
  void do_flush(NodeIo& io) final;
  void check(const AssociatorOutput& output) const;
  std::int64_t last_frame_ = -1;
};

}  // namespace plaza
