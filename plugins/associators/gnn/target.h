#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "plaza/component/models.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"

namespace plaza {

/// One frame of a target's life.
struct TargetSample {
  TrackId id = 0;  ///< 0: not confirmed yet
  std::int64_t frame = 0;
  double time_s = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();    ///< the filter's
  Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();  ///< the filter's
  std::optional<double> heading_rad;                       ///< as observed
  double weight = 0;                                       ///< of the observation, 1 / m^2
  double score = 0;
  bool observed = false;
  Eigen::Vector2d measured_m = Eigen::Vector2d::Zero();  ///< the observation's position
  std::vector<ViewBox> boxes;
};

/// A person that the associator follows.
struct Target {
  TrackId id = 0;  ///< 0: not confirmed yet
  int counter = 1;
  MotionState state;
  std::vector<TargetSample> samples;  ///< one per frame since the first observation
  std::size_t final_count = 0;        ///< samples that will not be spoken of again
  std::size_t last_observed = 0;      ///< index into samples
  double last_inside_s = 0;           ///< when it was last inside the area

  bool confirmed() const { return id != 0; }
};

/// The best estimate of where and how fast somebody was.
struct SmoothedPoint {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();
};

/// The sample's place in view of what was observed up to `window_s` before and after it: an
/// observed sample by local linear regression over the measured positions, weighted by their
/// certainty and a Gaussian in time (W. Cleveland, "Robust locally weighted regression", 1979, of
/// degree 1); an unobserved one on the line between its observed neighbours, or as predicted when
/// none follows. Window 0: the filter's estimate.
SmoothedPoint smoothed(const std::vector<TargetSample>& samples, std::size_t index,
                       double window_s);

}  // namespace plaza
