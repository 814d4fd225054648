#pragma once

#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "modalities/color/background.h"
#include "modalities/color/explained_patch.h"
#include "modalities/color/occupancy.h"
#include "modalities/color/opencl_counter.h"
#include "modalities/color/segmenter.h"
#include "modalities/common/memo.h"
#include "modalities/common/opencl.h"
#include "modalities/common/shrink.h"
#include "plaza/data/evidence.h"

namespace plaza::color {

/// Foreground of one image, ready to be counted in silhouettes. Immutable, but for the Lab image,
/// which is made when it is first asked for.
class ColorEvidence final : public Evidence {
 public:
  /// Pixels that count nowhere: behind static occluders.
  struct Blind {
    cv::Mat mask;  ///< 8-bit, 0 or 255; empty: no pixel
    AreaCounts counts;
    opencl::OnDevice<cv::UMat> on_device;
  };
  enum class State {
    kUsable,
    kNoBackground,     ///< this view was never learned
    kOtherBackground,  ///< nearly all is foreground: lights, exposure or the camera have changed
  };

  /// Neither matrix is copied or written to. `background` may be null where there is none.
  ColorEvidence(State state, cv::Mat image, Segmentation segmentation,
                std::shared_ptr<const Background> background, std::shared_ptr<const Blind> blind,
                Shrink shrink = Shrink(1));

  State state() const { return state_; }
  const cv::Mat& mask() const {
    return segmentation_.mask;
  }  ///< the segmentation's, 8-bit, 0 or 255
  const cv::Mat& strength() const { return segmentation_.strength; }  ///< 16-bit, 64 steps are 1
  /// 8-bit CIE-Lab (OpenCV's scaling: L * 255 / 100, a + 128, b + 128), of the size
  /// that the image is looked at in.
  const cv::Mat& lab() const;
  std::vector<Picture> pictures() const override;

  /// Whether counts of templates can come from a device: nothing is explained yet. (Afterwards a
  /// few templates are judged again, which is not worth what an upload per person costs.)
  bool countable_on_device() const { return state_ == State::kUsable && explained_.empty(); }
  /// count() for pieces which[i], by OpenCL; the foreground goes to the device once.
  std::vector<TemplateCounts> count(const OpenclCounter& device, const SpanTemplates& templates,
                                    std::span<const std::uint32_t> which) const;
  using CountMemo = Memo<TemplateCounts>;
  /// What was counted in these templates' pieces before anything was explained.
  CountMemo& counted(const SpanTemplates& templates) const {
    return memos_->of(templates.serial(), templates.pieces());
  }
  /// Counts in a piece, of what isn't explained. The evidence must be usable.
  TemplateCounts left(const SpanTemplates& templates, std::size_t piece, CountMemo& memo) const;
  /// See plaza::color::occupancy(), of a piece; nothing when the evidence isn't usable either.
  /// `memo` is counted() of the templates.
  std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                  double least_visible, CountMemo& memo) const;
  std::optional<double> occupancy(const SpanTemplates& templates, std::size_t index,
                                  double least_visible) const {
    return occupancy(templates, index, least_visible, counted(templates));
  }
  /// The evidence without the foreground inside bodies and their gaps, whose pixels count nowhere
  /// from then on. Copies no image.
  std::shared_ptr<const ColorEvidence> without(const SpanTemplates& templates,
                                               std::span<const std::uint32_t> which) const;

 private:
  using Patches = std::vector<std::shared_ptr<const ExplainedPatch>>;
  using PatchPtr = std::shared_ptr<const ExplainedPatch>;
  ColorEvidence(const ColorEvidence& other, Patches explained);
  PatchPtr patch_of(const SpanTemplates& templates, std::size_t body, const Patches& before) const;
  /// Counts in a piece, whatever is explained.
  TemplateCounts seen(const SpanTemplates& templates, std::size_t piece, CountMemo& memo) const;

  State state_;
  Shrink shrink_;
  cv::Mat image_;
  Segmentation segmentation_;
  std::shared_ptr<const Background> background_;
  std::shared_ptr<const Blind> blind_;
  std::shared_ptr<const AreaCounts> counts_;  ///< of foreground, without what is blind
  std::shared_ptr<Memos<TemplateCounts>> memos_ = std::make_shared<Memos<TemplateCounts>>();
  /// Of people whom nobody before them touches: a search takes the same away again and again.
  std::shared_ptr<Memos<PatchPtr>> alone_ = std::make_shared<Memos<PatchPtr>>();
  opencl::OnDevice<cv::UMat> on_device_;  ///< counts_
  Patches explained_;                     ///< in the order in which they were accepted
  mutable std::once_flag lab_once_;
  mutable cv::Mat lab_;
};

}  // namespace plaza::color
