#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "plaza/data/payload.h"

namespace plaza {

/// The synchronous images of all cameras at one time. A view without an image in this frame is an
/// empty cv::Mat; images are 8-bit, 3 channels, BGR, of the camera's size, and never written to.
struct PLAZA_API FrameSet final : PayloadOf<FrameSet> {
  static constexpr std::string_view kPort = "Frames";
  ~FrameSet() override;

  std::int64_t frame = 0;      ///< from 0
  std::int64_t time_ns = 0;    ///< from the first frame
  std::vector<cv::Mat> views;  ///< one per camera of the scene, in its order
};

}  // namespace plaza
