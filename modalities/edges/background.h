#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "modalities/common/shrink.h"
#include "modalities/edges/edge_image.h"
#include "plaza/component/learner.h"
#include "plaza/geometry/scene.h"

namespace plaza::edges {

/// Where a view's background has edges, and which way its brightness rises (thesis 4.3.2).
struct ViewBackground {
  bool known = false;  ///< false: this view had no image while the background was learned
  cv::Mat1b edges;     ///< 255 at edges of the background
  cv::Mat1b zone;      ///< 255 within the tolerance of such an edge (Theta_DT)
  cv::Mat2f gradient;  ///< (G_bx, G_by), of unit length, or (0, 0)
};

enum class BackgroundMethod {
  kPeopleFree,  ///< the thesis's: union of the edges of people-free frames
  kMedian,      ///< edges of the median of frames with people in them
  kNone,        ///< nothing is subtracted
};

struct BackgroundOptions {
  BackgroundMethod method = BackgroundMethod::kPeopleFree;
  std::optional<std::int64_t> first;
  std::int64_t every = 1;
  double tolerance_px = 2;
  double sensitivity = 0.5;
  EdgeOptions edges;
};

/// Learns the backgrounds of all views.
///
/// People-free: the union of the frames' edges and the mean of their gradients (4.3.2). Median: per
/// pixel the median brightness of up to kMedianFrames frames, evenly spread; its gradients; and its
/// edges, found with thresholds lowered by `sensitivity`, since an edge near the threshold comes
/// and goes from frame to frame. Whoever stands still for half of the frames is background.
class BackgroundLearner final : public Learner {
 public:
  static constexpr std::size_t kMedianFrames = 64;

  /// Of the scene's images, looked at in that size.
  BackgroundLearner(const BackgroundOptions& options, std::shared_ptr<const Scene> scene,
                    Shrink shrink = Shrink(1));

  /// Of view `camera`; null before finish() or load().
  std::shared_ptr<const ViewBackground> view(std::size_t camera) const { return views_.at(camera); }

 private:
  /// What is gathered of one view.
  struct Pupil {
    std::int64_t frames = 0;
    cv::Mat1b edges;              // people-free: union
    cv::Mat1f dx, dy;             // people-free: sums
    std::vector<cv::Mat1b> grey;  // median
    std::int64_t stride = 1;      // median: every how many frames one is kept
    EdgeImage image;
  };

  std::optional<LearningPlan> do_plan() const override;
  void do_learn(const FrameSet& frames) override;
  void do_finish(std::int64_t seen) override;
  void do_save(std::ostream& out) const override;
  void do_load(std::istream& in) override;

  void learn_view(const cv::Mat& image, Pupil& pupil) const;
  ViewBackground finish_view(Pupil& pupil) const;

  BackgroundOptions options_;
  std::shared_ptr<const Scene> scene_;
  Shrink shrink_;
  std::vector<Pupil> pupils_;
  std::vector<std::shared_ptr<const ViewBackground>> views_;
};

/// A known background of edges and gradients of unit length, with the zone within `tolerance_px`.
ViewBackground make_background(const cv::Mat1b& edges, const cv::Mat2f& gradient,
                               double tolerance_px);

}  // namespace plaza::edges
