#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "plaza/data/payload.h"

namespace plaza {

/// Something of a view that a person would look at.
struct Picture {
  std::string name;  ///< unique in its evidence; lower case, digits and hyphens, as in file names
  std::string caption;  ///< a few words: "edges of the background"
  cv::Mat image;        ///< 8-bit BGR, of the view's size
};

/// What a modality measured in one image (edges and their distance transform, a mask, a Lab image).
/// Its content is the modality's own business; only that modality reads it.
class PLAZA_API Evidence {
 public:
  virtual ~Evidence();
  /// What was measured, step by step, in the order in which it was (the original image left out).
  /// Painted on request; the default has nothing to show.
  virtual std::vector<Picture> pictures() const;
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
