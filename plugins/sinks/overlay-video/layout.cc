#include "plugins/sinks/overlay-video/layout.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace plaza::overlay {
namespace {

constexpr double kTallest = 0.75;  // height over width

struct Grid {
  int columns = 1;
  int rows = 1;
  double cell_width = 0;
  double cell_height = 0;
  double plan_width = 0;
  double height = 0;
  double merit = -1;
};

struct Measures {
  int gap = 0;
  int header = 0;
};

/// One way to cut up the canvas, and how good it is.
Grid try_grid(int columns, double plan_share, std::size_t views, double view_aspect,
              double plan_aspect, double width, const Measures& m) {
  Grid g;
  g.columns = columns;
  g.rows = static_cast<int>((views + static_cast<std::size_t>(columns) - 1) /
                            static_cast<std::size_t>(columns));
  const double gaps = m.gap * (columns + 2.0);
  g.cell_width = (width * (1 - plan_share) - gaps) / columns;
  const double tallest = width * kTallest - m.header - m.gap;
  const double fits = (tallest - m.gap * (g.rows - 1.0)) / g.rows * view_aspect;
  g.cell_width = std::min(g.cell_width, fits);
  if (g.cell_width < 1) return g;
  g.cell_height = g.cell_width / view_aspect;
  g.plan_width = width - gaps - columns * g.cell_width;
  g.height = g.rows * g.cell_height + m.gap * (g.rows - 1.0);
  if (g.plan_width < 1) return g;
  const double plan_fit = std::min(g.plan_width, g.height * plan_aspect);
  const double plan_area = plan_fit * plan_fit / plan_aspect;
  const double view_area = static_cast<double>(views) * g.cell_width * g.cell_height;
  const double filled = (view_area + plan_area) / (width * g.height);
  // People in a plan are dots: up to the area of three views it counts more than views do, and
  // beyond that it gains nothing.
  const double useful = std::min(0.2 * width * width, 3 * g.cell_width * g.cell_height);
  g.merit = filled * filled * (view_area + 2 * std::min(plan_area, useful));
  return g;
}

int even(double value) { return 2 * static_cast<int>(std::ceil(value / 2)); }

}  // namespace

Layout make_layout(const std::vector<cv::Size>& view_sizes, double plan_aspect, int width_px) {
  if (view_sizes.empty()) throw std::invalid_argument("a layout needs at least one view");
  const int width = width_px - width_px % 2;
  double widths = 0, heights = 0;
  for (const cv::Size& size : view_sizes) {
    widths += size.width;
    heights += size.height;
  }
  const double view_aspect = widths / heights;
  const double bounded_plan = std::clamp(plan_aspect, 0.4, 2.5);
  const Measures m{std::max(4, width / 200), std::max(18, width / 48)};

  Grid best;
  for (int columns = 1; columns <= static_cast<int>(view_sizes.size()); ++columns) {
    for (int percent = 20; percent <= 60; ++percent) {
      const Grid g = try_grid(columns, percent / 100.0, view_sizes.size(), view_aspect,
                              bounded_plan, width, m);
      if (g.merit > best.merit) best = g;
    }
  }

  Layout layout;
  const int height = static_cast<int>(best.height);
  layout.canvas = {width, even(m.header + height + m.gap)};
  layout.header = {0, 0, width, m.header};
  for (std::size_t i = 0; i < view_sizes.size(); ++i) {
    const std::size_t row_index = i / static_cast<std::size_t>(best.columns);
    const auto column = static_cast<double>(i % static_cast<std::size_t>(best.columns));
    const auto row = static_cast<double>(row_index);
    const double left = m.gap + column * (best.cell_width + m.gap);
    const double top = m.header + row * (best.cell_height + m.gap);
    const cv::Size2d size(view_sizes[i]);
    const double scale = std::min(best.cell_width / size.width, best.cell_height / size.height);
    const int w = std::max(1, static_cast<int>(size.width * scale));
    const int h = std::max(1, static_cast<int>(size.height * scale));
    layout.views.emplace_back(static_cast<int>(left + (best.cell_width - w) / 2),
                              static_cast<int>(top + (best.cell_height - h) / 2), w, h);
  }
  const int plan_left = static_cast<int>(m.gap + best.columns * (best.cell_width + m.gap));
  layout.plan = {plan_left, m.header, width - m.gap - plan_left, height};
  return layout;
}

}  // namespace plaza::overlay
