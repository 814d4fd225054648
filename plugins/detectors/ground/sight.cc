#include "plugins/detectors/ground/sight.h"

#include <algorithm>
#include <vector>

namespace plaza {
namespace {

/// Even-odd rule; borders belong to whichever side rounding gives them.
bool inside(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& p) {
  bool in = false;
  for (std::size_t i = 0, k = polygon.size() - 1; i < polygon.size(); k = i++) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[k];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) {
      in = !in;
    }
  }
  return in;
}

bool inside(const Box& box, const Eigen::Vector2d& p) {
  return p.x() >= box.left && p.x() <= box.right() && p.y() >= box.top && p.y() <= box.bottom();
}

}  // namespace

double ground_distance(const Camera& camera, const Eigen::Vector2d& position_m) {
  return (position_m - camera.centre().head<2>()).norm();
}

double visible_share(const Scene& scene, std::size_t camera, const Eigen::Vector2d& position_m,
                     std::span<const Screen> people) {
  // Closer than a body's radius in depth, nobody hides anybody.
  const double nearer_m = ground_distance(scene.cameras[camera], position_m) - scene.body.radius_m;
  constexpr int kSamples = 10;
  int seen = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double z_m = scene.body.height_m * (i + 0.5) / kSamples;
    const auto pixel = scene.cameras[camera].project({position_m.x(), position_m.y(), z_m});
    if (!pixel || !scene.cameras[camera].contains(*pixel)) continue;
    const bool behind_building =
        std::any_of(scene.occluders.begin(), scene.occluders.end(), [&](const StaticOccluder& o) {
          return o.camera == scene.cameras[camera].name() && !o.polygon_px.empty() &&
                 inside(o.polygon_px, *pixel);
        });
    const bool behind_people = std::any_of(people.begin(), people.end(), [&](const Screen& s) {
      return s.distance_m < nearer_m && inside(s.box, *pixel);
    });
    if (!behind_building && !behind_people) ++seen;
  }
  return static_cast<double>(seen) / kSamples;
}

}  // namespace plaza
