#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modalities/color/background.h"
#include "modalities/color/color_evidence.h"
#include "modalities/color/living_background.h"
#include "modalities/color/opencl_counter.h"
#include "modalities/color/part_occupancy.h"
#include "modalities/color/segmenter.h"
#include "modalities/color/shape_analysis.h"
#include "modalities/common/body_parts.h"
#include "modalities/common/shrink.h"
#include "plaza/component/declaration.h"
#include "plaza/component/learner.h"

namespace plaza {

/// Foreground by colour, and how well silhouettes are filled with it.
///
/// *prepare* segments an image by the extended collinearity criterion and a Markov random field
/// (thesis 5.4.1; Griesser et al. 2005), against a background that was learned before the stream
/// and, where that is asked for, lives on during it (LivingBackground). *sample* turns silhouettes
/// into spans with a ring around them.
///
/// *match* compares occupancy, the share of foreground inside the silhouette less its share in a
/// ring around it, with a gap for arms and for what a round model leaves out. Its model: where a
/// person stands, the occupancy is 1 less a half-Gaussian deviation,
///     log L = -(1 - occupancy)^2 / (2 occupancy_sigma^2),
/// 0 for a filled silhouette in an empty surrounding, -1 / (2 sigma^2) for background (occupancy 0)
/// as well as for a place amid a larger foreground, and less where the ring is fuller than the
/// inside. Like (4.3) it doesn't depend on the silhouette's size. It is NaN when the view can't
/// tell: background never learned or no longer valid, too small a part of the silhouette in the
/// image, unhidden by static occluders and unexplained.
///
/// With `parts`, any of which may be hidden on its own (thesis 7.2), the likelihood is that of
/// PartMixture over the parts' occupancies.
///
/// *explain* takes the foreground inside a silhouette and its gap away and makes those pixels count
/// nowhere: arms left behind would fill the slim rest of a silhouette beside the person.
class ColorModality final : public Modality, private Learner {
 public:
  enum class Learning { kPeopleFree, kMedian };
  enum class Device { kCpu, kOpencl };
  struct Options {
    int shrink = 1;
    double darkness = 100;
    double least_noise = 2.5;
    double threshold = 4;
    double neighbourhood = 0.5;
    double previous = 0.4;
    int iterations = 4;
    double most_foreground = 0.7;
    double gap = 0.06;
    double ring = 0.06;
    double occupancy_sigma = 0.25;
    double least_visible = 0.3;
    std::vector<std::vector<double>> parts;
    double least_height_m = 0;
    double least_column_m = 0;
    double most_hole = 0;
    double most_shadow_m = 0;
    Learning background = Learning::kPeopleFree;
    std::int64_t background_every = 5;
    std::optional<std::int64_t> background_first;
    int background_samples = 128;
    bool follow_light = false;
    double light_rate = 0.5;
    std::optional<double> settle_s;
    Device device = Device::kCpu;
  };
  static Declaration<Options> declare();
  ColorModality(const Options& options, const BuildContext& context);

  Learner* learner() override { return this; }

 private:
  struct View {
    std::shared_ptr<const BodyScale> scale;                    ///< null: shapes aren't judged
    std::shared_ptr<const color::Ground> ground;               ///< as learned; null: unknown
    std::shared_ptr<const color::ColorEvidence::Blind> blind;  ///< behind static occluders
  };

  Diagnostics do_check() const override;

  Prepared do_prepare(const cv::Mat& image, std::size_t camera, const Past& past) const override;
  std::unique_ptr<TemplateBatch> do_sample(const ShapeModel& model, std::span<const Pose> poses,
                                           std::size_t camera) const override;
  void do_match(const Evidence& evidence, const TemplateBatch& templates,
                std::span<const std::uint32_t> which,
                std::span<double> log_likelihood) const override;
  EvidencePtr do_explain(const EvidencePtr& evidence, const TemplateBatch& templates,
                         std::span<const std::uint32_t> which) const override;

  std::optional<LearningPlan> do_plan() const override;
  void do_learn(const FrameSet& frames) override;
  void do_finish(std::int64_t seen) override;
  void do_save(std::ostream& out) const override;
  void do_load(std::istream& in) override;

  void match_parts(const color::ColorEvidence& seen, const color::SpanTemplates& batch,
                   std::span<const std::uint32_t> which, std::span<double> log_likelihood) const;
  void use(std::vector<color::Background> backgrounds);
  color::LivingOptions living() const;
  color::ShapeOptions shapes() const;
  std::shared_ptr<const color::Ground> make_ground(color::Background background) const;

  Options options_;
  Shrink shrink_;
  std::shared_ptr<const Scene> small_;              ///< in images as they are looked at
  std::vector<BodyPart> parts_;                     ///< none: bodies in one piece
  std::optional<color::PartJudgement> in_parts_;    ///< where there are
  std::vector<color::BackgroundLearner> learners_;  ///< [camera]
  std::vector<View> views_;                         ///< [camera]; empty until learned or loaded
  std::unique_ptr<const color::OpenclCounter> counter_;  ///< null: the CPU counts
};

}  // namespace plaza
