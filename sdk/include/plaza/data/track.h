#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "plaza/data/observation.h"
#include "plaza/data/payload.h"

namespace plaza {

using TrackId = std::int64_t;  ///< > 0, shared over all cameras

/// Where one person is in one frame.
struct TrackPoint {
  TrackId id = 0;
  std::int64_t frame = 0;  ///< from 0
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  std::optional<double> heading_rad;
  double score = 0;      ///< [0, 1]
  bool observed = true;  ///< false: bridged, no observation supports this frame
  bool final = false;    ///< true: the associator will not touch this (id, frame) again
  std::vector<ViewBox>
      boxes;  ///< measured boxes, where there are any; views without one are drawn from the body
};

/// What an associator says in one step. A point that is open (not final) replaces an earlier open
/// point of the same (id, frame); a final one ends it. Points that never become final are not part
/// of the answer.
struct PLAZA_API Tracks final : PayloadOf<Tracks> {
  static constexpr std::string_view kPort = "Tracks";
  ~Tracks() override;

  std::vector<TrackPoint> points;
};

/// A short, safe piece of one person's path, complete; input of global associators.
struct Tracklet {
  TrackId id = 0;
  std::vector<TrackPoint> points;  ///< by rising frame, at least one
  FeatureSet features;
};

/// Tracklets that were completed in this step.
struct PLAZA_API Tracklets final : PayloadOf<Tracklets> {
  static constexpr std::string_view kPort = "Tracklets";
  ~Tracklets() override;

  std::vector<Tracklet> items;
};

}  // namespace plaza
