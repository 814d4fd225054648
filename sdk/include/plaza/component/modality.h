#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <utility>
#include <vector>

#include "plaza/component/build_context.h"
#include "plaza/component/models.h"
#include "plaza/component/node.h"
#include "plaza/data/evidence.h"
#include "plaza/data/frames.h"

namespace plaza {

/// Model templates in one view, in the form that one modality compares. Made by that modality's
/// sample().
class PLAZA_API TemplateBatch {
 public:
  virtual ~TemplateBatch();
  virtual std::size_t size() const = 0;
};

/// A visual modality is four operations over one view: prepare, sample, match, explain. All are
/// const and thread-safe. Virtual calls are per image and per batch, never per point.
///
/// A modality whose evidence depends on the frames before declares memory(): on what was foreground
/// in the last one, and on whatever else it hands on (the light, things that have come to stay).
/// Its node then keeps both for every view from one frame to the next and passes them to prepare().
/// The operations themselves stay without state: prepare() is a pure function of the image and its
/// Past.
///
/// Node ports: in 0 Frames; out 0 Evidence, out 1 ForegroundMask where declared.
class PLAZA_API Modality : public Node {
 public:
  ~Modality() override;

  /// What a modality hands on from frame to frame of one view besides its mask. Derived by the
  /// modality, never written to after it was handed on.
  class PLAZA_API Memory {
   public:
    virtual ~Memory();
  };
  using MemoryPtr = std::shared_ptr<const Memory>;

  /// What is left of the frames before, of one view.
  struct Past {
    Past() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): a mask is all the past that most modalities have
    Past(cv::Mat foreground_before, MemoryPtr memory_before = nullptr)
        : foreground(std::move(foreground_before)), memory(std::move(memory_before)) {}

    /// The mask of the frame right before: 8-bit of the image's size, 0 or 255; empty where there
    /// is none (the first frame, a missing image before, a modality without memory).
    cv::Mat foreground;
    /// What the last image of this view left; null at the beginning, after a jump in time, and in a
    /// modality without memory. Frames whose image is missing leave it as it is.
    MemoryPtr memory;
  };

  struct Prepared {
    EvidencePtr evidence;  ///< never null
    cv::Mat foreground;  ///< 8-bit mask of the image's size, or empty where the modality gives none
    MemoryPtr memory = nullptr;  ///< for this view's next image; null where nothing is to be kept
  };
  /// Image -> evidence. `image` is 8-bit BGR of the camera's size.
  Prepared prepare(const cv::Mat& image, std::size_t camera, const Past& past = {}) const;
  /// Model at poses -> templates in view `camera`, one per pose, in the same order.
  std::unique_ptr<TemplateBatch> sample(const ShapeModel& model, std::span<const Pose> poses,
                                        std::size_t camera) const;
  /// Log-likelihood of every template; `log_likelihood.size()` is the batch's. NaN: this view can't
  /// tell.
  void match(const Evidence& evidence, const TemplateBatch& templates,
             std::span<double> log_likelihood) const;
  /// The same for some templates only, which is what a coarse-to-fine search needs:
  /// log_likelihood[i] belongs to template which[i]. Any order, repetitions allowed; a template's
  /// value doesn't depend on what else is asked for. Throws std::out_of_range for an index beyond
  /// the batch.
  void match(const Evidence& evidence, const TemplateBatch& templates,
             std::span<const std::uint32_t> which, std::span<double> log_likelihood) const;
  /// The evidence without what these templates account for together; the input stays as it is. What
  /// was accounted for before stays so. Throws std::out_of_range for an index beyond the batch.
  EvidencePtr explain(const EvidencePtr& evidence, const TemplateBatch& templates,
                      std::span<const std::uint32_t> which) const;
  EvidencePtr explain(const EvidencePtr& evidence, const TemplateBatch& templates,
                      std::uint32_t index) const {
    return explain(evidence, templates, std::span(&index, 1));
  }

 protected:
  explicit Modality(const BuildContext& context)
      : scene_(context.scene), in_order_(context.in_order) {}
  const Scene& scene() const { return *scene_; }

  virtual Prepared do_prepare(const cv::Mat& image, std::size_t camera, const Past& past) const = 0;
  virtual std::unique_ptr<TemplateBatch> do_sample(const ShapeModel& model,
                                                   std::span<const Pose> poses,
                                                   std::size_t camera) const = 0;
  virtual void do_match(const Evidence& evidence, const TemplateBatch& templates,
                        std::span<const std::uint32_t> which,
                        std::span<double> log_likelihood) const = 0;
  virtual EvidencePtr do_explain(const EvidencePtr& evidence, const TemplateBatch& templates,
                                 std::span<const std::uint32_t> which) const = 0;

 private:
  void do_process(NodeIo& io) final;
  std::shared_ptr<const Scene> scene_;
  bool in_order_;
  std::vector<Past> past_;  ///< the node's, by view, as frame last_frame_ left it
  std::int64_t last_frame_ = -1;
};

}  // namespace plaza
