#pragma once

#include <vector>

#include "plaza/data/payload.h"
#include "plaza/geometry/box.h"

namespace plaza {

/// A person's box in one image, as an image detector or a file gives it.
struct ImageDetection {
  Box box;
  double score = 0;  ///< the detector's own scale, not a probability
};

/// Image detections of all views in one frame.
struct PLAZA_API Detections final : PayloadOf<Detections> {
  static constexpr std::string_view kPort = "Detections";
  ~Detections() override;

  std::vector<std::vector<ImageDetection>> views;  ///< [camera of the scene][detection]
};

}  // namespace plaza
