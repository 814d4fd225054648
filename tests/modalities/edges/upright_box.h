#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/core/types.hpp>

#include "plaza/component/models.h"
#include "plaza/geometry/scene.h"
#include "tests/sdk/geometry/test_cameras.h"

namespace plaza::test {

/// The box around a body in the image, as a silhouette: contour points one pixel apart.
class UprightBox final : public ShapeModel {
 protected:
  Silhouette do_silhouette(const Pose& pose, const Camera& camera) const override {
    Silhouette s;
    const auto box = body_box(camera, pose.position_m, {});
    if (!box) return s;
    s.box = *box;
    const double left = std::round(box->left), right = std::round(box->right());
    const double top = std::round(box->top), bottom = std::round(box->bottom());
    const auto add = [&](double x, double y, float nx, float ny) {
      s.contour.push_back({{static_cast<float>(x), static_cast<float>(y)}, {nx, ny}});
    };
    for (double y = top; y < bottom; ++y) {
      add(left, y, -1, 0);
      add(right - 1, y, 1, 0);
    }
    for (double x = left; x < right; ++x) {
      add(x, top, 0, -1);
      add(x, bottom - 1, 0, 1);
    }
    const auto cut = [](double v, int size) {
      return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size)));
    };
    const int begin = cut(left, camera.width()), end = cut(right, camera.width());
    int rows = 0;
    for (int y = cut(top, camera.height()); begin < end && y < cut(bottom, camera.height()); ++y) {
      s.spans.push_back({y, begin, end});
      ++rows;
    }
    s.inside_share = (end - begin) * rows / std::max(1.0, (right - left) * (bottom - top));
    return s;
  }
  Body do_body() const override { return {}; }
};

/// One camera 8 m south of the origin, 4 m high, looking at it.
inline std::shared_ptr<const Scene> scene_of(cv::Size image) {
  const Eigen::Vector2i size(image.width, image.height);
  auto scene = std::make_shared<Scene>();
  scene->name = "Yard";
  scene->area = {{-4, -4}, {4, 4}};
  scene->frame_rate_hz = 7;
  const double focal_px = 1.1 * size.x();
  scene->cameras.push_back(Camera::pinhole(
      "south", size, {focal_px, focal_px, 0.5 * (size.x() - 1), 0.5 * (size.y() - 1), {}},
      look_at({0, -8, 4}, {0, 0, 0.8})));
  return scene;
}

}  // namespace plaza::test
