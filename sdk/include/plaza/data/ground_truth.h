#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "plaza/data/payload.h"
#include "plaza/geometry/box.h"

namespace plaza {

/// How a true person appears in one view.
struct TrueView {
  std::size_t camera = 0;  ///< index into the scene's cameras
  Box box;                 ///< of the whole body, hidden parts included
  double visibility = 1;   ///< visible share of the body, [0, 1]
};

/// A view counts in the evaluation when at least this share of the body is visible in it.
inline constexpr double kCountingVisibility = 0.2;

struct TruePerson {
  std::int64_t id = 0;
  std::optional<Eigen::Vector2d> position_m;  ///< the pelvis projected down
  std::optional<double> heading_rad;          ///< torso yaw
  std::vector<TrueView> views;                ///< by rising camera index
};

/// The truth of one frame. Never an input of anything but evaluators, sinks and renderers: the
/// check refuses a pipeline in which a detector, describer or associator reads it.
struct PLAZA_API GroundTruth final : PayloadOf<GroundTruth> {
  static constexpr std::string_view kPort = "GroundTruth";
  ~GroundTruth() override;

  bool annotated = true;  ///< false: nobody looked at this frame, it counts for nothing
  std::vector<TruePerson> people;
};

}  // namespace plaza
