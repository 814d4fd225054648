#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "plaza/data/payload.h"

namespace plaza {

/// What a modality measured in one image (edges and their distance transform, a mask, a Lab image).
/// Its content is the modality's own business; only that modality reads it.
class PLAZA_API Evidence {
 public:
  virtual ~Evidence();
};

using EvidencePtr = std::shared_ptr<const Evidence>;

/// One modality's evidence of all views in one frame; null where the view has no image.
struct PLAZA_API EvidenceSet final : PayloadOf<EvidenceSet> {
  static constexpr std::string_view kPort = "Evidence";
  ~EvidenceSet() override;

  std::vector<EvidencePtr> views;
};

/// Foreground of all views: 8-bit, 1 channel, 0 or 255; empty where the view has no image.
struct PLAZA_API ForegroundMask final : PayloadOf<ForegroundMask> {
  static constexpr std::string_view kPort = "ForegroundMask";
  ~ForegroundMask() override;

  std::vector<cv::Mat> views;
};

}  // namespace plaza
