#pragma once

#include <memory>
#include <span>
#include <vector>

#include "modalities/common/memo.h"
#include "modalities/common/opencl.h"
#include "modalities/common/shrink.h"
#include "modalities/edges/background.h"
#include "modalities/edges/fast_transform.h"
#include "modalities/edges/hidden_region.h"
#include "modalities/edges/plane_patch.h"
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
  /// or its background is unknown; nothing can be told from it.
  EdgeEvidence(std::shared_ptr<const PlaneLayout> layout,
               std::shared_ptr<const ViewBackground> background, Pool<EvidenceBlock>::Handle block,
               bool blank, Shrink shrink = Shrink(1))
      : shrink_(shrink),
        layout_(std::move(layout)),
        background_(std::move(background)),
        block_(std::move(block)),
        blank_(blank) {}

  /// What is left of the edges when somebody accounts for the others.
  struct Left {
    std::vector<EdgePoint> points;
    PlanePatches patches;  ///< where their transform isn't that of all
  };
  EdgeEvidence(const EdgeEvidence& other, Left left) : EdgeEvidence(other) {
    left_ = std::make_shared<const Left>(std::move(left));
  }
  /// The same edges, a part of which counts nowhere.
  EdgeEvidence(const EdgeEvidence& other, std::shared_ptr<const HiddenRegion> hidden)
      : EdgeEvidence(other) {
    hidden_ = std::move(hidden);
  }

  /// "background-edges", "all-edges", "segmented-edges", "linked-edges", "directions", "transform".
  std::vector<Picture> pictures() const override;

  const std::shared_ptr<const PlaneLayout>& layout() const { return layout_; }
  const std::shared_ptr<const ViewBackground>& background() const { return background_; }
  /// As the image was prepared.
  const EvidenceBlock& block() const { return *block_; }
  std::span<const EdgePoint> points() const { return left_ ? left_->points : block_->points; }
  std::span<const std::shared_ptr<const PlanePatch>> patches() const {
    return left_ ? std::span(left_->patches) : std::span<const std::shared_ptr<const PlanePatch>>();
  }
  /// The transform's value at a pixel: gate + 1 on an edge, 0 beyond the gate.
  int nearness(std::size_t direction, int x, int y) const;
  /// Log-likelihoods that were found before anything was taken away.
  Memo<double>& matched(const EdgeTemplates& templates) const {
    return memos_->of(templates.serial(), templates.size());
  }
  /// Edges of the image that templates account for, whatever others do.
  using PointsPtr = std::shared_ptr<const std::vector<EdgePoint>>;
  Memo<PointsPtr>& accounted(const EdgeTemplates& templates) const {
    return accounted_->of(templates.serial(), templates.size());
  }
  /// The planes on the OpenCL device, made when first asked for.
  const opencl::OnDevice<cv::UMat>& on_device() const { return *on_device_; }
  const HiddenRegion* hidden() const { return hidden_.get(); }  ///< null: all counts
  bool blank() const { return blank_; }
  /// Whether somebody accounts for a part of it.
  bool explained() const { return left_ != nullptr || hidden_ != nullptr; }

 private:
  EdgeEvidence(const EdgeEvidence&) = default;

  Shrink shrink_;
  std::shared_ptr<const PlaneLayout> layout_;
  std::shared_ptr<const ViewBackground> background_;
  std::shared_ptr<const EvidenceBlock> block_;
  std::shared_ptr<const Left> left_;  ///< null: all
  std::shared_ptr<const HiddenRegion> hidden_;
  bool blank_;
  std::shared_ptr<Memos<double>> memos_ = std::make_shared<Memos<double>>();
  std::shared_ptr<Memos<PointsPtr>> accounted_ = std::make_shared<Memos<PointsPtr>>();
  std::shared_ptr<const opencl::OnDevice<cv::UMat>> on_device_ =
      std::make_shared<const opencl::OnDevice<cv::UMat>>();
};

}  // namespace plaza::edges
