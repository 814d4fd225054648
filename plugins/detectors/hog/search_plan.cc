#include "plugins/detectors/hog/search_plan.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "plugins/detectors/common/box_ground.h"

namespace plaza {
namespace {

constexpr double kGridStep_m = 0.25;

/// Extent in pixels; starts empty.
struct Extent {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;

  void add(const Box& box, double room_px) {
    left = std::min(left, box.left - room_px);
    top = std::min(top, box.top - room_px);
    right = std::max(right, box.right() + room_px);
    bottom = std::max(bottom, box.bottom() + room_px);
  }
  cv::Rect inside(const Camera& camera) const {
    const int l = static_cast<int>(std::floor(std::max(left, 0.0)));
    const int t = static_cast<int>(std::floor(std::max(top, 0.0)));
    const int r = static_cast<int>(std::ceil(std::min<double>(right, camera.width())));
    const int b = static_cast<int>(std::ceil(std::min<double>(bottom, camera.height())));
    return {l, t, std::max(r - l, 0), std::max(b - t, 0)};
  }
};

bool in_view(const Box& box, const Camera& camera) {
  return box.right() > 0 && box.bottom() > 0 && box.left < camera.width() &&
         box.top < camera.height();
}

}  // namespace

std::vector<SearchLevel> plan_search(const Camera& camera, const Scene& scene,
                                     const SearchPlanOptions& options) {
  const GroundArea area = grown(scene.area, options.margin_m);
  const double log_step = std::log(options.scale_step);
  std::map<int, Extent> extents;
  const Eigen::Vector2d size = area.max_m - area.min_m;
  const int columns = static_cast<int>(std::ceil(size.x() / kGridStep_m));
  const int rows = static_cast<int>(std::ceil(size.y() / kGridStep_m));
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const Eigen::Vector2d position =
          area.min_m + Eigen::Vector2d(size.x() * column / std::max(columns, 1),
                                       size.y() * row / std::max(rows, 1));
      for (const double sign : {-1.0, 0.0, 1.0}) {
        Body body = scene.body;
        body.height_m *= 1 + sign * options.height_spread;
        const auto box = body_box(camera, position, body);
        if (!box || !in_view(*box, camera) || box->height < options.min_height_px) continue;
        const double level = std::log(box->height / options.min_height_px) / log_step;
        extents[static_cast<int>(std::lround(level))].add(*box, options.room * box->height);
      }
    }
  }
  std::vector<SearchLevel> levels;
  for (const auto& [level, extent] : extents) {
    const cv::Rect region = extent.inside(camera);
    if (region.empty()) continue;
    levels.push_back(
        {.body_height_px = options.min_height_px * std::exp(level * log_step), .region = region});
  }
  return levels;
}

}  // namespace plaza
