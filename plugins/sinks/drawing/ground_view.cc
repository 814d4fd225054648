#include "plugins/sinks/drawing/ground_view.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace plaza::drawing {
namespace {

Point as_point(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }

std::optional<Path> rim(const Camera& camera, const Eigen::Vector2d& centre_m, double radius_m,
                        double z_m) {
  constexpr int kCorners = 36;
  Path path;
  for (int i = 0; i < kCorners; ++i) {
    const double a = 2 * std::numbers::pi * i / kCorners;
    const auto pixel = camera.project(
        {centre_m.x() + radius_m * std::cos(a), centre_m.y() + radius_m * std::sin(a), z_m});
    if (!pixel) return std::nullopt;
    path.push_back(as_point(*pixel));
  }
  return path;
}

Path convex_hull(const Path& a, const Path& b) {
  // OpenCV's hull takes floats, which are exact enough for drawing
  std::vector<cv::Point2f> points;
  for (const Path* path : {&a, &b}) {
    for (const Point& p : *path)
      points.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
  }
  std::vector<cv::Point2f> hull;
  cv::convexHull(points, hull);
  return {hull.begin(), hull.end()};
}

}  // namespace

double round_step(double least_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(least_m)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least_m * (1 - 1e-9)) return factor * decade;
  }
  return 10 * decade;
}

std::vector<double> multiples(double low, double high, double step) {
  std::vector<double> out;
  const double last = std::floor(high / step + 1e-9);
  for (double k = std::ceil(low / step - 1e-9); k <= last; ++k) out.push_back(k * step);
  return out;
}

std::vector<Path> seen_pieces(const Camera& camera, std::span<const Eigen::Vector2d> path) {
  constexpr double kSampling_m = 0.25;
  std::vector<Path> pieces(1);
  const auto add = [&](const Eigen::Vector2d& p) {
    if (const auto pixel = camera.project({p.x(), p.y(), 0})) {
      pieces.back().push_back(as_point(*pixel));
    } else if (!pieces.back().empty()) {
      pieces.emplace_back();
    }
  };
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) {
      const Eigen::Vector2d step = path[i] - path[i - 1];
      const int parts = static_cast<int>(std::min(1000.0, std::ceil(step.norm() / kSampling_m)));
      for (int k = 1; k < parts; ++k) add(path[i - 1] + step * k / parts);
    }
    add(path[i]);
  }
  std::erase_if(pieces, [](const Path& p) { return p.size() < 2; });
  return pieces;
}

std::optional<CylinderOutline> cylinder_outline(const Camera& camera,
                                                const Eigen::Vector2d& position_m,
                                                const Body& body) {
  auto foot = rim(camera, position_m, body.radius_m, 0);
  auto top = rim(camera, position_m, body.radius_m, body.height_m);
  if (!foot || !top) return std::nullopt;
  Path contour = convex_hull(*foot, *top);
  return CylinderOutline{std::move(contour), std::move(*foot), std::move(*top)};
}

GroundArrow ground_arrow(const Eigen::Vector2d& from_m, double heading_rad, double length_m) {
  const Eigen::Vector2d ahead(std::cos(heading_rad), std::sin(heading_rad));
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const Eigen::Vector2d neck = from_m + ahead * (0.65 * length_m);
  const double half_width_m = 0.2 * length_m;
  return {from_m,
          neck,
          {from_m + ahead * length_m, neck + left * half_width_m, neck - left * half_width_m}};
}

void draw_area_border(cv::Mat& image, const Camera& camera, const GroundArea& area,
                      const Stroke& stroke) {
  const Eigen::Vector2d a = area.min_m, b = area.max_m;
  const std::vector<Eigen::Vector2d> corners = {a, {b.x(), a.y()}, b, {a.x(), b.y()}, a};
  for (const Path& piece : seen_pieces(camera, corners)) draw_path(image, piece, false, stroke);
}

void draw_area_grid(cv::Mat& image, const Camera& camera, const GroundArea& area, double step_m,
                    const Stroke& lines, const Stroke& border) {
  const auto line = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const std::vector<Eigen::Vector2d> ends = {from, to};
    for (const Path& piece : seen_pieces(camera, ends)) draw_path(image, piece, false, lines);
  };
  for (const double x : multiples(area.min_m.x(), area.max_m.x(), step_m)) {
    line({x, area.min_m.y()}, {x, area.max_m.y()});
  }
  for (const double y : multiples(area.min_m.y(), area.max_m.y(), step_m)) {
    line({area.min_m.x(), y}, {area.max_m.x(), y});
  }
  draw_area_border(image, camera, area, border);
}

void draw_heading(cv::Mat& image, const Camera& camera, const Eigen::Vector2d& position_m,
                  double heading_rad, double length_m, const Stroke& stroke) {
  const GroundArrow arrow = ground_arrow(position_m, heading_rad, length_m);
  const std::vector<Eigen::Vector2d> shaft = {arrow.tail_m, arrow.neck_m};
  for (const Path& piece : seen_pieces(camera, shaft)) {
    draw_seamed_path(image, piece, false, stroke);
  }
  Path head;
  for (const Eigen::Vector2d& corner : arrow.head_m) {
    const auto pixel = camera.project({corner.x(), corner.y(), 0});
    if (!pixel) return;
    head.push_back(as_point(*pixel));
  }
  draw_seamed_path(image, head, true, {stroke.color, 1});
  fill_convex(image, head, stroke.color);
}

}  // namespace plaza::drawing
