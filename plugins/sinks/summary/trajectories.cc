#include "plugins/sinks/summary/trajectories.h"

#include <algorithm>
#include <cmath>

#include "plugins/sinks/drawing/ground_view.h"
#include "plugins/sinks/drawing/plan.h"

namespace plaza::summary {
namespace {

using drawing::Anchor;
using drawing::Path;
using drawing::Point;

struct Sheet {
  cv::Mat picture;
  drawing::PlanMap map;
  double text_px;
  double rate_hz;
};

void draw_stretches(Sheet& sheet, const Trajectory& t) {
  const auto longest_gap = std::max<std::int64_t>(1, std::llround(sheet.rate_hz));
  const drawing::Color color = drawing::color_of(t.front().id);
  // one path per stretch of equal kind; neighbours share the point between them
  Path path = {sheet.map.pixel(t.front().position_m)};
  bool bridged = false;
  const auto finish = [&] {
    drawing::draw_path(sheet.picture, path, false, {color, 2, bridged ? 5.0 : 0.0});
    path.clear();
  };
  for (std::size_t i = 1; i < t.size(); ++i) {
    const Point here = sheet.map.pixel(t[i].position_m);
    const bool gap = t[i].frame - t[i - 1].frame > longest_gap;
    const bool bridge = !t[i].observed || !t[i - 1].observed;
    if (gap || bridge != bridged) {
      const Point last = path.back();
      finish();
      if (!gap) path.push_back(last);
      bridged = !gap && bridge;
    }
    path.push_back(here);
  }
  finish();
}

/// Direction of the last metre or so, in radians; nothing for people who stood still.
std::optional<double> last_direction(const Trajectory& t) {
  const Eigen::Vector2d end_m = t.back().position_m;
  for (auto it = t.rbegin(); it != t.rend(); ++it) {
    const Eigen::Vector2d d = end_m - it->position_m;
    if (d.norm() >= 0.6) return std::atan2(d.y(), d.x());
  }
  return std::nullopt;
}

void draw_ends(Sheet& sheet, const Trajectory& t) {
  const drawing::Color color = drawing::color_of(t.front().id);
  const double radius = 0.4 * sheet.text_px;
  const Point start = sheet.map.pixel(t.front().position_m);
  drawing::draw_disk(sheet.picture, start, radius, {255, 255, 255});
  drawing::draw_ring(sheet.picture, start, radius, {color, 2});

  const Point end = sheet.map.pixel(t.back().position_m);
  if (const auto direction = last_direction(t)) {
    const double length_m = 2.6 * sheet.text_px / sheet.map.px_per_m();
    const Eigen::Vector2d back(std::cos(*direction), std::sin(*direction));
    const auto arrow =
        drawing::ground_arrow(t.back().position_m - 0.65 * length_m * back, *direction, length_m);
    Path head;
    for (const Eigen::Vector2d& corner : arrow.head_m) head.push_back(sheet.map.pixel(corner));
    drawing::fill_convex(sheet.picture, head, color);
  } else {
    drawing::draw_disk(sheet.picture, end, radius, color);
  }
}

void draw_legend(Sheet& sheet, const drawing::Theme& theme) {
  const double u = sheet.text_px;
  const double y = sheet.picture.rows - 1.5 * u;
  drawing::draw_ring(sheet.picture, {1.5 * u, y}, 0.4 * u, {theme.text, 2});
  drawing::draw_text(sheet.picture, "start", {2.4 * u, y - 0.5 * u}, {u, theme.text});
  const Path head = {{9 * u, y}, {8 * u, y - 0.5 * u}, {8 * u, y + 0.5 * u}};
  drawing::fill_convex(sheet.picture, head, theme.text);
  drawing::draw_text(sheet.picture, "end", {9.6 * u, y - 0.5 * u}, {u, theme.text});
  drawing::draw_path(sheet.picture, Path{{14 * u, y}, {17 * u, y}}, false, {theme.text, 2, 5});
  drawing::draw_text(sheet.picture, "not observed", {17.6 * u, y - 0.5 * u}, {u, theme.text});
}

}  // namespace

cv::Mat draw_trajectories(const Scene& scene, const Trajectories& people, int width_px) {
  const drawing::Theme& theme = drawing::light_theme();
  const double text_px = std::clamp(std::round(width_px / 110.0), 7.0, 18.0);
  const GroundArea extent = drawing::plan_extent(scene);
  const Eigen::Vector2d size_m = extent.max_m - extent.min_m;
  const double height =
      std::clamp(width_px * size_m.y() / size_m.x(), 0.3 * width_px, 2.0 * width_px);
  const int legend_px = static_cast<int>(drawing::legend_height(text_px));
  const cv::Size size(width_px, static_cast<int>(height) + legend_px);
  drawing::Plan plan = drawing::draw_plan(scene, size, theme, {text_px, true});
  Sheet sheet{plan.picture, plan.map, text_px, scene.frame_rate_hz};

  for (const auto& [id, t] : people) draw_stretches(sheet, t);
  for (const auto& [id, t] : people) draw_ends(sheet, t);
  for (const auto& [id, t] : people) {
    const Point end = sheet.map.pixel(t.back().position_m);
    drawing::draw_plate(sheet.picture, std::to_string(id), end + Point(0, -0.8 * text_px),
                        {0.9 * text_px, drawing::color_of(id), Anchor::kBottomCentre});
  }
  draw_legend(sheet, theme);
  return sheet.picture;
}

}  // namespace plaza::summary
