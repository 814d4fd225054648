#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "modalities/common/opencl.h"
#include "modalities/common/shrink.h"
#include "modalities/edges/background.h"
#include "modalities/edges/evidence.h"
#include "modalities/edges/opencl_matcher.h"
#include "modalities/edges/templates.h"
#include "plaza/component/declaration.h"

namespace plaza::edges {

/// What explain() takes away.
enum class Explains {
  kContour,     ///< edges within the gate of a contour point, along its normal
  kSilhouette,  ///< and all edges inside the silhouette
  kRegion,      ///< no edge, but what others' contours have inside the silhouette counts nowhere
};

/// What sums up contours.
enum class Device { kCpu, kOpencl };

/// Silhouettes compared with foreground edges through an oriented distance transform (thesis
/// 4.3.2-4.3.5).
class Edges final : public Modality {
 public:
  struct Options {
    int shrink = 1;
    EdgeMethod method = EdgeMethod::kCanny;
    double low_threshold = 60;
    double high_threshold = 120;
    double blur_px = 0;
    BackgroundMethod background = BackgroundMethod::kPeopleFree;
    std::optional<std::int64_t> background_first;
    std::int64_t background_every = 1;
    double background_tolerance_px = 2;
    double background_sensitivity = 0.5;
    double orientation_threshold = 0.9;
    int min_contour_px = 1;
    double least_piece_m = 0;
    double longest_line_m = 0;
    int link_px = 5;
    int link_end_points = 1;
    int directions = 12;
    double sigma_px = 3;
    double min_visible = 0.3;
    int min_points = 20;
    Explains explains = Explains::kContour;
    Device device = Device::kCpu;
  };
  static Declaration<Options> declare();
  Edges(const Options& options, const BuildContext& context);
  ~Edges() override;

  Learner* learner() override;

 private:
  /// What belongs to one camera.
  struct View {
    std::shared_ptr<const PlaneLayout> layout;
    std::shared_ptr<const ContourMatcher> matcher;
    std::shared_ptr<Pool<EvidenceBlock>> blocks;
    std::shared_ptr<const BodyScale> scale;  ///< null: shapes aren't judged
  };
  struct Workshop;

  Diagnostics do_check() const override;

  Prepared do_prepare(const cv::Mat& image, std::size_t camera, const Past& past) const override;
  std::unique_ptr<TemplateBatch> do_sample(const ShapeModel& model, std::span<const Pose> poses,
                                           std::size_t camera) const override;
  void do_match(const Evidence& evidence, const TemplateBatch& templates,
                std::span<const std::uint32_t> which,
                std::span<double> log_likelihood) const override;
  EvidencePtr do_explain(const EvidencePtr& evidence, const TemplateBatch& templates,
                         std::span<const std::uint32_t> which) const override;

  /// The foreground edges of an image that a template accounts for, each once.
  static EdgeEvidence::PointsPtr accounted_for(const EdgeEvidence& evidence,
                                               const EdgeTemplates& contours, std::size_t index,
                                               Workshop& workshop);
  /// Takes `gone` out of `points`; the rectangle around those that were there.
  static cv::Rect take_away(std::span<const EdgePoint> gone, Workshop& workshop,
                            std::vector<EdgePoint>& points);
  Pool<EvidenceBlock>::Handle take_block(const View& view) const;
  const View& view_of(const EdgeEvidence& evidence) const;

  Options options_;
  Shrink shrink_;
  EdgeOptions edge_options_;
  SegmentationOptions segmentation_;
  TemplateOptions template_options_;
  std::unique_ptr<BackgroundLearner> learner_;  ///< null: nothing is subtracted
  std::vector<View> views_;
  std::vector<std::shared_ptr<Pool<Workshop>>> workshops_;         ///< by view
  opencl::OnDevice<std::unique_ptr<const OpenclMatcher>> device_;  ///< where it was asked for
};

}  // namespace plaza::edges
