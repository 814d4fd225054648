#pragma once

#include <span>
#include <vector>

#include "plaza/component/sink.h"
#include "plaza/data/frames.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/track.h"

namespace plaza {

/// What a renderer gets per frame, after the stream has ended.
struct RenderFrame {
  std::int64_t frame = 0;
  std::int64_t time_ns = 0;
  const FrameSet* frames = nullptr;           ///< re-read from the source; never null
  std::span<const TrackPoint> tracks;         ///< final points of this frame, by rising id
  const GroundTruth* ground_truth = nullptr;  ///< null where the pipeline has none
};

/// Makes pictures and videos that need final tracks and images together. Runs in the render phase,
/// in frame order. As a node it declares inputs Frames and Tracks (and GroundTruth, optional), in
/// this order.
class PLAZA_API Renderer : public Node {
 public:
  ~Renderer() override;
  /// Range of frames to come: [begin, end).
  void begin(std::int64_t begin_frame, std::int64_t end_frame);
  void render(const RenderFrame& frame) { do_render(frame); }
  std::vector<Artifact> end(bool complete) { return do_end(complete); }

 protected:
  virtual void do_begin(std::int64_t begin_frame, std::int64_t end_frame) = 0;
  virtual void do_render(const RenderFrame& frame) = 0;
  virtual std::vector<Artifact> do_end(bool complete) = 0;

 private:
  void do_process(NodeIo& io) final;  // nothing to do while the stream runs
};

}  // namespace plaza
