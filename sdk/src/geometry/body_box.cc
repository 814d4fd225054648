#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "camera_model.h"

namespace plaza {
namespace {

constexpr int kAngles = 16;
// Through a distorting lens the cylinder's straight sides are curves that may bulge beyond both
// rims.
constexpr int kHeightsDistorted = 5;

struct Cylinder {
  Eigen::Vector2d position;
  Body body;

  Eigen::Vector3d at(double angle, double z) const {
    return {position.x() + body.radius_m * std::cos(angle),
            position.y() + body.radius_m * std::sin(angle), z};
  }
  Eigen::Vector3d by_angle(double angle) const {
    return {-body.radius_m * std::sin(angle), body.radius_m * std::cos(angle), 0};
  }
};

/// Where in [low, high] a function with rising slope-to-fall passes its maximum: the zero of
/// `slope`, positive at `low` and negative at `high` (else the better end), by the Illinois rule.
template <class Slope>
double maximum_between(double low, double high, const Slope& slope) {
  double at_low = slope(low), at_high = slope(high);
  if (!(at_low > 0)) return low;
  if (!(at_high < 0)) return high;
  int side = 0;
  double x = low;
  for (int i = 0; i < 40; ++i) {
    const double next = (low * at_high - high * at_low) / (at_high - at_low);
    const double moved = std::abs(next - x);
    x = next;
    const double s = slope(x);
    // the error of a maximum is of second order in x
    if (s == 0 || (i > 0 && moved < 1e-7)) break;
    if (s > 0) {
      low = x;
      at_low = s;
      if (side == 1) at_high /= 2;
      side = 1;
    } else {
      high = x;
      at_high = s;
      if (side == -1) at_low /= 2;
      side = -1;
    }
  }
  return x;
}

}  // namespace

std::optional<Box> body_box(const Camera& camera, const Eigen::Vector2d& position_m,
                            const Body& body) {
  const Camera::Model& model = *camera.model_;
  const Cylinder cylinder{position_m, body};
  // Depth is linear in space: its least value on a rim has a closed form.
  const double reach = body.radius_m * model.pose.rotation.row(2).head<2>().norm();
  for (const double z : {0.0, body.height_m}) {
    const double depth =
        model.pose.rotation.row(2).dot(Eigen::Vector3d(position_m.x(), position_m.y(), z)) +
        model.pose.translation.z();
    if (!(depth - reach > kMinDepth_m)) return std::nullopt;
  }

  const int heights = model.lens.is_ideal() ? 2 : kHeightsDistorted;
  const double angle_step = 2 * std::numbers::pi / kAngles;
  const double z_step = body.height_m / (heights - 1);
  struct Extreme {
    double value = -std::numeric_limits<double>::infinity();
    double angle = 0, z = 0;
  };
  std::array<Extreme, 4> extremes;  // of -u, -v, u, v: left, top, right, bottom
  for (int level = 0; level < heights; ++level) {
    const double z = level * z_step;
    for (int i = 0; i < kAngles; ++i) {
      const double angle = i * angle_step;
      const auto pixel = camera.project(cylinder.at(angle, z));
      if (!pixel) return std::nullopt;
      const std::array<double, 4> values{-pixel->x(), -pixel->y(), pixel->x(), pixel->y()};
      for (std::size_t e = 0; e < 4; ++e) {
        if (values[e] > extremes[e].value) extremes[e] = {values[e], angle, z};
      }
    }
  }

  for (std::size_t e = 0; e < 4; ++e) {
    const double sign = e < 2 ? -1 : 1;
    const Eigen::Index axis = e % 2 == 0 ? 0 : 1;
    Extreme& best = extremes[e];
    const auto slope = [&](double angle, double z, const Eigen::Vector3d& direction) {
      const auto p = model.project_with_jacobian(cylinder.at(angle, z));
      return p ? sign * p->by_world.row(axis).dot(direction) : 0;
    };
    // On a rim the pixel has one maximum over the angle; through a lens, alternate with the height.
    for (int round = 0; round < (heights == 2 ? 1 : 4); ++round) {
      best.angle = maximum_between(
          best.angle - angle_step, best.angle + angle_step,
          [&](double angle) { return slope(angle, best.z, cylinder.by_angle(angle)); });
      if (heights == 2) continue;
      const double z = best.z;
      best.z = maximum_between(
          std::max(0.0, best.z - z_step), std::min(body.height_m, best.z + z_step),
          [&](double height) { return slope(best.angle, height, Eigen::Vector3d::UnitZ()); });
      if (std::abs(best.z - z) < 1e-9) break;
    }
    const auto pixel = camera.project(cylinder.at(best.angle, best.z));
    if (!pixel) return std::nullopt;
    best.value = std::max(best.value, sign * (*pixel)[axis]);
  }
  const double left = -extremes[0].value, top = -extremes[1].value;
  return Box{left, top, extremes[2].value - left, extremes[3].value - top};
}

}  // namespace plaza
