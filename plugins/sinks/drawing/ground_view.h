#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "plaza/geometry/scene.h"
#include "plugins/sinks/drawing/canvas.h"
#include "plugins/sinks/drawing/trails.h"

/// The ground and what stands on it as a camera sees it. World in metres; the camera's image is the
/// picture that is drawn into (Camera::scaled).
namespace plaza::drawing {

/// A distance of 1, 2 or 5 times a power of ten between lines, the smallest that is at least
/// `least_m`.
double round_step(double least_m);

/// Multiples of `step` in [low, high].
std::vector<double> multiples(double low, double high, double step);

/// The pieces of a path on the ground that the camera can see, finely enough sampled to follow its
/// distortion.
std::vector<Path> seen_pieces(const Camera& camera, std::span<const Eigen::Vector2d> path);

/// Rims and contour of an upright cylinder; nothing when a part of it is behind the camera.
struct CylinderOutline {
  Path contour;  ///< convex, closed
  Path foot;     ///< closed
  Path top;      ///< closed
};
std::optional<CylinderOutline> cylinder_outline(const Camera& camera,
                                                const Eigen::Vector2d& position_m,
                                                const Body& body);

/// Corners of an arrow lying on the ground that starts at `from_m`: its shaft's end first, then its
/// head.
struct GroundArrow {
  Eigen::Vector2d tail_m, neck_m;
  std::array<Eigen::Vector2d, 3> head_m;
};
GroundArrow ground_arrow(const Eigen::Vector2d& from_m, double heading_rad, double length_m);

/// Lines of the area's grid and its border.
void draw_area_grid(cv::Mat& image, const Camera& camera, const GroundArea& area, double step_m,
                    const Stroke& lines, const Stroke& border);
void draw_area_border(cv::Mat& image, const Camera& camera, const GroundArea& area,
                      const Stroke& stroke);
void draw_heading(cv::Mat& image, const Camera& camera, const Eigen::Vector2d& position_m,
                  double heading_rad, double length_m, const Stroke& stroke);

}  // namespace plaza::drawing
