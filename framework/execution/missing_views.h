#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "plaza/data/frames.h"
#include "plaza/geometry/scene.h"

namespace plaza {

/// Keeps account of views without an image. A run goes on without them, and its user should know.
class MissingViews {
 public:
  explicit MissingViews(const Scene& scene);

  /// Frames of a stream, by rising number.
  void add(const FrameSet& frames);

  /// One line per camera that had no image in some frames, frames counted from 1: "camera 'view2':
  /// no image in frames 3, 7-9 (4 of 20)"; of one that was lost for good, also when. Nothing when
  /// no camera had any: then there are no images by design.
  std::vector<std::string> notes() const;

 private:
  struct View {
    std::string camera;
    std::vector<std::pair<std::int64_t, std::int64_t>> gaps;  // first and last frame, from 0
    std::int64_t missing = 0;
  };
  std::vector<View> views_;
  std::int64_t frames_ = 0;
  std::int64_t last_frame_ = -1;
};

}  // namespace plaza
