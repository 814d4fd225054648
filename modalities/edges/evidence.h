#pragma once

#include <memory>
#include <vector>

#include "modalities/common/opencl.h"
#include "modalities/edges/background.h"
#include "modalities/edges/fast_transform.h"
#include "modalities/edges/hidden_region.h"
#include "modalities/edges/pool.h"
#include "modalities/edges/segmentation.h"
#include "plaza/data/evidence.h"

namespace plaza::edges {

/// The large parts of one image's evidence, used again when the evidence has died.
struct EvidenceBlock {
  explicit EvidenceBlock(const PlaneLayout& layout)
      : planes(layout.bytes()), labels(layout.size()) {}
  ByteBlock planes;               ///< the oriented distance transform
  LabelImage labels;              ///< what became of each edge pixel
  std::vector<EdgePoint> points;  ///< foreground edges
};

/// Foreground edges of one image and their oriented distance transform.
class EdgeEvidence final : public Evidence {
 public:
  /// `background` null: none is subtracted. `blank`: the image shows nothing at all (one colour),
  /// or its background is unknown; nothing can be told from it. `explained`: edges were taken away.
  EdgeEvidence(std::shared_ptr<const PlaneLayout> layout,
               std::shared_ptr<const ViewBackground> background, Pool<EvidenceBlock>::Handle block,
               bool blank, bool explained)
      : layout_(std::move(layout)),
        background_(std::move(background)),
        block_(std::move(block)),
        blank_(blank),
        explained_(explained) {}

  /// The same edges, a part of which counts nowhere.
  EdgeEvidence(const EdgeEvidence& other, std::shared_ptr<const HiddenRegion> hidden)
      : EdgeEvidence(other) {
    hidden_ = std::move(hidden);
  }

  /// "background-edges", "all-edges", "segmented-edges", "linked-edges", "directions", "transform".
  std::vector<Picture> pictures() const override;

  const std::shared_ptr<const PlaneLayout>& layout() const { return layout_; }
  const std::shared_ptr<const ViewBackground>& background() const { return background_; }
  const EvidenceBlock& block() const { return *block_; }
  /// The planes on the OpenCL device, made when first asked for.
  const opencl::OnDevice<cv::UMat>& on_device() const { return *on_device_; }
  const HiddenRegion* hidden() const { return hidden_.get(); }  ///< null: all counts
  bool blank() const { return blank_; }
  /// Whether somebody accounts for a part of it.
  bool explained() const { return explained_ || hidden_ != nullptr; }

 private:
  EdgeEvidence(const EdgeEvidence&) = default;

  std::shared_ptr<const PlaneLayout> layout_;
  std::shared_ptr<const ViewBackground> background_;
  std::shared_ptr<const EvidenceBlock> block_;
  std::shared_ptr<const HiddenRegion> hidden_;
  bool blank_, explained_;
  std::shared_ptr<const opencl::OnDevice<cv::UMat>> on_device_ =
      std::make_shared<const opencl::OnDevice<cv::UMat>>();
};

}  // namespace plaza::edges
