#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>

#include "plaza/geometry/scene.h"
#include "plugins/sinks/drawing/canvas.h"

namespace plaza::drawing {

/// Similarity from ground metres to pixels of a plan: x to the right, y up, so that headings turn
/// counter-clockwise in the picture, too.
class PlanMap {
 public:
  /// Shows `extent` centred inside `picture`, as large as it fits.
  PlanMap(const GroundArea& extent, const cv::Rect& picture);

  Point pixel(const Eigen::Vector2d& p_m) const;
  Eigen::Vector2d metres(const Point& pixel) const;
  double px_per_m() const { return px_per_m_; }

 private:
  double px_per_m_;
  Point origin_px_;  ///< of the world
};

/// What a plan of the scene shows: the area with a margin, and the cameras that are not too far
/// from it.
GroundArea plan_extent(const Scene& scene);

/// The part of a plan that stays the same.
struct Plan {
  cv::Mat picture;
  PlanMap map;
};

struct PlanStyle {
  double text_px = 10;  ///< height of capitals
  bool fields_of_view = true;
};

/// Height of the strip at a plan's foot; the scale bar is at its right end.
double legend_height(double text_px);

/// Area with a metres grid, scale bar, cameras by name, and the ground that each of them sees.
/// Cameras beyond the picture are marked at its border.
Plan draw_plan(const Scene& scene, cv::Size size, const Theme& theme, const PlanStyle& style);

/// A person in the plan: dot (hollow when not observed), heading, id.
struct PlanPerson {
  TrackId id = 0;
  Eigen::Vector2d position_m;
  std::optional<double> heading_rad;
  bool observed = true;
};
/// Dots first, then ids.
void draw_people(cv::Mat& picture, const PlanMap& map, std::span<const PlanPerson> people,
                 double text_px, const Theme& theme);

}  // namespace plaza::drawing
