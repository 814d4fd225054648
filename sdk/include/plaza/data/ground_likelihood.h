#pragma once

#include <vector>

#include "plaza/data/observation.h"
#include "plaza/data/payload.h"

namespace plaza {

/// How well each ground cell explains one frame as a place where a person stands: the surface that
/// a detector found its observations on, for pictures and for trackers that work on cells.
///
/// Values are natural logarithms, up to a constant of the frame; NaN where no view can tell or
/// where nothing was evaluated. Cell (column, row) is at index row * grid.columns + column.
struct PLAZA_API GroundLikelihood final : PayloadOf<GroundLikelihood> {
  static constexpr std::string_view kPort = "GroundLikelihood";
  ~GroundLikelihood() override;

  GroundGrid grid;                         ///< metres on the ground, z = 0
  std::vector<double> joint;               ///< [cell], of all views and modalities together
  std::vector<std::vector<double>> views;  ///< [camera of the scene][cell], all modalities together
};

}  // namespace plaza
