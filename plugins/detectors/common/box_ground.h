#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plaza/component/parameter.h"
#include "plaza/data/detections.h"
#include "plaza/data/observation.h"
#include "plaza/geometry/scene.h"
#include "plugins/detectors/common/probability_curve.h"

namespace plaza {

/// How image boxes become ground observations. Lengths in the image are shares of the box's height,
/// since the errors of box detectors grow with the size of what they see.
struct BoxGroundOptions {
  double min_score = 0.0;
  double nms_overlap = 0.6;
  double vote_overlap = 1.0;
  std::vector<std::vector<double>> probability = {{0.0, 0.05}, {0.5, 0.5}, {1.0, 0.95}};
  double foot_offset = 0.0;
  double foot_offset_px = 0.0;
  double head_offset = 0.0;
  double foot_sigma = 0.03;
  double head_sigma = 0.03;
  double centre_sigma = 0.03;
  double pixel_sigma_px = 1.0;
  double ground_sigma_m = 0.05;
  double body_height_sigma_m = 0.08;
  bool use_head = true;
  double height_gate = 3.0;
  double min_height_ratio = 0.3;
  double max_height_ratio = 1.6;
  double border_px = 2.0;
  double margin_m = 0.0;
};

/// Where the person of a box stands.
struct Standing {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();
  bool feet = true;  ///< false: the box shows no feet, the position comes from the head alone
};

/// Ground observations from the boxes of one view.
class BoxGround {
 public:
  BoxGround(const BoxGroundOptions& options, std::shared_ptr<const Scene> scene);

  /// One observation per box that stands inside the scene's area and looks like a person there, by
  /// falling score. Among boxes that overlap by more than `nms_overlap`, only the best is kept.
  std::vector<Observation> observe(std::size_t camera,
                                   std::span<const ImageDetection> detections) const;

  /// Position of the person in `box`, which is as measured, cut at the image border or not.
  /// Nothing when neither feet nor head meet their plane.
  std::optional<Standing> locate(std::size_t camera, const Box& box) const;

 private:
  std::optional<Standing> from_plane(const Camera& camera, const Eigen::Vector2d& pixel,
                                     double sigma_x_px, double sigma_y_px, double z_m,
                                     double sigma_z_m) const;
  /// Mean of the boxes that overlap `box` enough, itself among them, weighted by their
  /// probabilities.
  Box voted(const Box& box, std::span<const ImageDetection> candidates) const;
  bool plausible(const Camera& camera, const Box& box, const Standing& standing) const;

  BoxGroundOptions options_;
  std::shared_ptr<const Scene> scene_;
  ProbabilityCurve curve_;
};

/// Greedy non-maximum suppression: indices of the boxes that stay, by falling score (ties: in their
/// order).
std::vector<std::size_t> suppress_overlapping(std::span<const ImageDetection> detections,
                                              double max_overlap);

/// The parameters of BoxGroundOptions for a component whose Options derive from it.
template <class Options>
void add_box_ground_parameters(Parameters<Options>& p) {
  using Real = double Options::*;
  const auto real = [&p](const char* name, double BoxGroundOptions::*member) {
    return p.value(name, static_cast<Real>(member));
  };
  real("min_score", &BoxGroundOptions::min_score)
      .meaning("boxes with a lower score are not looked at, on the detector's own scale");
  real("nms_overlap", &BoxGroundOptions::nms_overlap)
      .at_least(0)
      .at_most(1)
      .meaning("of two boxes of a view whose intersection over union is larger, the better stays");
  real("vote_overlap", &BoxGroundOptions::vote_overlap)
      .above(0)
      .at_most(1)
      .meaning(
          "a box that stays becomes the mean of those that overlap it at least so much; 1: it "
          "stays as it is")
      .source("S. Gidaris and N. Komodakis, Object detection via a multi-region CNN, ICCV 2015");
  p.value("probability",
          static_cast<std::vector<std::vector<double>> Options::*>(&BoxGroundOptions::probability))
      .meaning("calibration of scores: [score, probability] points, linear between, flat beyond");
  real("foot_offset", &BoxGroundOptions::foot_offset)
      .at_least(-0.5)
      .at_most(0.5)
      .meaning("how far the feet are above the box's lower edge, as a share of its height");
  real("foot_offset_px", &BoxGroundOptions::foot_offset_px)
      .unit("px")
      .meaning("a further offset of the feet, the same for boxes of all sizes");
  real("head_offset", &BoxGroundOptions::head_offset)
      .at_least(-0.5)
      .at_most(0.5)
      .meaning("how far the head's top is below the box's upper edge, as a share of its height");
  real("foot_sigma", &BoxGroundOptions::foot_sigma)
      .at_least(0)
      .meaning("standard deviation of the lower edge, as a share of the box's height");
  real("head_sigma", &BoxGroundOptions::head_sigma)
      .at_least(0)
      .meaning("standard deviation of the upper edge, as a share of the box's height");
  real("centre_sigma", &BoxGroundOptions::centre_sigma)
      .at_least(0)
      .meaning("standard deviation of the middle between left and right, as a share of the height");
  real("pixel_sigma_px", &BoxGroundOptions::pixel_sigma_px)
      .unit("px")
      .above(0)
      .meaning("standard deviation of every edge, added to the shares");
  real("ground_sigma_m", &BoxGroundOptions::ground_sigma_m)
      .unit("m")
      .at_least(0)
      .meaning("standard deviation of what the calibration is wrong by on the ground");
  real("body_height_sigma_m", &BoxGroundOptions::body_height_sigma_m)
      .unit("m")
      .above(0)
      .meaning("standard deviation of people's height about the scene's body");
  p.value("use_head", static_cast<bool Options::*>(&BoxGroundOptions::use_head))
      .meaning("whether a whole box's upper edge corrects the position found from its feet");
  real("height_gate", &BoxGroundOptions::height_gate)
      .above(0)
      .meaning("a box shorter by more standard deviations has hidden feet: its head locates it");
  real("min_height_ratio", &BoxGroundOptions::min_height_ratio)
      .at_least(0)
      .meaning("lowest box height over the projected body's, both as far as the image goes");
  real("max_height_ratio", &BoxGroundOptions::max_height_ratio)
      .above(0)
      .meaning("largest box height over the projected body's");
  real("border_px", &BoxGroundOptions::border_px)
      .unit("px")
      .at_least(0)
      .meaning("a box that comes nearer to the image border is cut by it: that edge is unknown");
  real("margin_m", &BoxGroundOptions::margin_m)
      .unit("m")
      .meaning("how far outside the scene's area observations are kept");
}

/// The area grown by `margin_m` on every side.
inline GroundArea grown(const GroundArea& area, double margin_m) {
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  return {.min_m = area.min_m - margin, .max_m = area.max_m + margin};
}

}  // namespace plaza
