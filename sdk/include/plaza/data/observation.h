#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "plaza/data/feature.h"
#include "plaza/data/payload.h"
#include "plaza/geometry/box.h"

namespace plaza {

/// An observation as one view saw it.
struct ViewBox {
  std::size_t camera = 0;  ///< index into the scene's cameras
  Box box;                 ///< pixels, not cut at the border
  double score = 0;        ///< the detector's own scale
};

/// A person hypothesis on the ground, from one frame.
struct Observation {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();  ///< symmetric, positive definite
  double probability = 0;                                       ///< P(a person stands here), [0, 1]
  /// On the detector's own scale, finite; `probability` is what the detector made of it, and never
  /// falls where it rises. What a calibration is fitted to: a curve that is flat hides the score.
  double score = 0;
  std::optional<double> heading_rad;  ///< 0 along +x, counter-clockwise
  std::vector<ViewBox> boxes;  ///< at most one per camera, by rising camera index; may be empty
  FeatureSet features;
};

/// Regular ground grid that observations were found on (6.4.1 builds its network on it).
struct GroundGrid {
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  ///< centre of cell (0, 0)
  Eigen::Vector2d step_m = Eigen::Vector2d::Ones();
  int columns = 0;  ///< along x
  int rows = 0;     ///< along y
};

/// All person hypotheses of one frame.
struct PLAZA_API Observations final : PayloadOf<Observations> {
  static constexpr std::string_view kPort = "Observations";
  ~Observations() override;

  std::vector<Observation> items;
  std::optional<GroundGrid> grid;
};

}  // namespace plaza
