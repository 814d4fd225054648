#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "framework/config/pipeline.h"
#include "framework/execution/frame_loop.h"
#include "framework/execution/plan.h"
#include "plugins/detectors/hierarchical-grid/hierarchical_grid.h"

namespace plaza::bench {

inline constexpr int kThreads = 2;

/// Which frames of a recording are kept in memory: of every `every`, the first `run`.
struct Chosen {
  std::int64_t every = 1;
  std::int64_t run = 1;
};

/// Modalities ("color", "edges") and "detector" of a pipeline, taught, with decoded or rendered
/// frames: what they cost is measured without the cost of reading.
class TaughtClip {
 public:
  /// `pipeline` is a file below pipelines/. Throws UserError where something is missing, such as a
  /// video or a library that renders.
  TaughtClip(const std::string& pipeline, const std::vector<std::string>& sets,
             const Chosen& chosen);

  std::size_t size() const { return frames_.size(); }
  const Scene& scene() const { return *resolved_.scene; }
  const cv::Mat& image(std::size_t i, std::size_t camera) const {
    return static_cast<const FrameSet&>(*frames_.at(i).images).views.at(camera);
  }
  const Modality& modality(const std::string& name) const;

  /// All frames through the nodes, by the executor's loop, kThreads frames at a time.
  void run(const std::function<void(const FrameState&)>& done) const;
  /// The search alone in a frame that run() has been through.
  SearchResult search(const FrameState& state) const;

 private:
  struct Frame {
    std::int64_t index = 0;
    PayloadPtr images;
  };

  PipelineInScene resolved_;
  Assembly assembly_;
  ExecutionPlan plan_;
  std::vector<std::size_t> nodes_;  ///< modalities, detector
  const HierarchicalGrid* detector_ = nullptr;
  std::vector<Frame> frames_;
};

}  // namespace plaza::bench
