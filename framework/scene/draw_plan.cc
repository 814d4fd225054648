#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "framework/scene/draw.h"
#include "framework/scene/draw_canvas.h"
#include "framework/scene/fields.h"

namespace plaza {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kLongSide_px = 1000;
constexpr double kMargin_px = 110;
constexpr double kNameSize = 0.55;

class Plan {
 public:
  explicit Plan(const Scene& scene) : scene_(scene) {
    low_ = scene.area.min_m;
    high_ = scene.area.max_m;
    for (const Camera& camera : scene.cameras) {
      low_ = low_.cwiseMin(camera.centre().head<2>());
      high_ = high_.cwiseMax(camera.centre().head<2>());
    }
    scale_ = kLongSide_px / (high_ - low_).maxCoeff();
    const Eigen::Vector2d size = (high_ - low_) * scale_;
    image_ = cv::Mat(static_cast<int>(size.y() + 2 * kMargin_px),
                     static_cast<int>(size.x() + 2 * kMargin_px), CV_8UC3, canvas::kPaper);
  }

  cv::Mat draw() {
    for (std::size_t i = 0; i < scene_.cameras.size(); ++i) draw_sight(i);
    draw_grid();
    const Eigen::Vector2d &l = scene_.area.min_m, &h = scene_.area.max_m;
    canvas::polyline(image_, {at(l), at({h.x(), l.y()}), at(h), at({l.x(), h.y()})}, true,
                     canvas::kArea, 3);
    draw_axes();
    for (std::size_t i = 0; i < scene_.cameras.size(); ++i) draw_camera(i);
    canvas::text(image_,
                 scene_.name + "   x right, y up   grid " +
                     short_number(grid_step_m(scene_.area.max_m - scene_.area.min_m)) + " m",
                 {14, 28}, canvas::kInk, 0.65);
    return image_;
  }

 private:
  Eigen::Vector2d at(const Eigen::Vector2d& m) const {
    return {kMargin_px + (m.x() - low_.x()) * scale_, kMargin_px + (high_.y() - m.y()) * scale_};
  }

  /// The ground a camera sees, up to the area's far end: along the image's border, where each ray
  /// meets the ground, or its direction at the horizon.
  void draw_sight(std::size_t index) {
    const Camera& camera = scene_.cameras[index];
    const Eigen::Vector2d centre = camera.centre().head<2>();
    const Eigen::Vector2d far =
        (scene_.area.min_m - centre).cwiseAbs().cwiseMax((scene_.area.max_m - centre).cwiseAbs());
    const double reach = 1.05 * far.norm();
    constexpr int kSteps = 40;
    const double w = camera.width() - 1, h = camera.height() - 1;
    const Points corners{{0, 0}, {w, 0}, {w, h}, {0, h}};
    Points ground;
    for (std::size_t side = 0; side < 4; ++side) {
      for (int i = 0; i < kSteps; ++i) {
        const Eigen::Vector2d pixel =
            corners[side] + (corners[(side + 1) % 4] - corners[side]) * (double(i) / kSteps);
        const auto ray = camera.ray(pixel);
        if (!ray) continue;
        const auto there = camera.to_plane(pixel);
        const Eigen::Vector2d direction = ray->direction.head<2>().normalized();
        const bool near = there && (*there - centre).norm() < reach;
        ground.push_back(at(near ? *there : centre + reach * direction));
      }
    }
    if (ground.size() < 3) return;
    canvas::fill(image_, ground, canvas::camera_colour(index), 0.10);
    canvas::polyline(image_, ground, true, canvas::camera_colour(index), 1);
  }

  void draw_grid() {
    const Eigen::Vector2d low = scene_.area.min_m, high = scene_.area.max_m;
    const double step = grid_step_m(high - low);
    for (int axis = 0; axis < 2; ++axis) {
      for (double v = std::ceil(low[axis] / step) * step; v <= high[axis]; v += step) {
        Eigen::Vector2d a = low, b = high;
        a[axis] = b[axis] = v;
        const bool fifth = std::abs(std::remainder(v / step, 5)) < 1e-6;
        canvas::line(image_, at(a), at(b), fifth ? canvas::kGridStrong : canvas::kGrid, 1);
        if (!fifth) continue;
        const Eigen::Vector2d outside =
            axis == 0 ? Eigen::Vector2d(0, 14) : Eigen::Vector2d(-20, 0);
        canvas::centred_text(image_, short_number(v + 0.0), at(a) + outside, canvas::kInk, 0.45);
      }
    }
  }

  void draw_axes() {
    const cv::Scalar colours[] = {{40, 40, 220}, {40, 150, 40}};
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d end = 2 * Eigen::Vector2d::Unit(axis);
      canvas::line(image_, at({0, 0}), at(end), colours[axis], 3);
      canvas::centred_text(image_, axis == 0 ? "x" : "y", at(1.2 * end), colours[axis], 0.6);
    }
  }

  void draw_camera(std::size_t index) {
    const Camera& camera = scene_.cameras[index];
    const cv::Scalar colour = canvas::camera_colour(index);
    const Eigen::Vector2d p = at(camera.centre().head<2>());
    const Eigen::Vector3d axis = camera.pose().rotation.row(2);
    Eigen::Vector2d ahead(axis.x(), -axis.y());
    if (ahead.norm() > 1e-6) {
      ahead.normalize();
      const Eigen::Vector2d aside(-ahead.y(), ahead.x());
      canvas::fill(image_, {p, p + 22 * ahead + 11 * aside, p + 22 * ahead - 11 * aside}, colour,
                   1);
    }
    cv::circle(image_, cv::Point(static_cast<int>(p.x()), static_cast<int>(p.y())), 6, colour,
               cv::FILLED, cv::LINE_AA);
    const std::string words =
        camera.name() + ", " + short_number(std::round(camera.centre().z() * 100) / 100) + " m";
    // behind the camera, where its own view does not reach, but inside the picture
    int baseline = 0;
    const int width =
        cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, kNameSize, 1, &baseline).width;
    Eigen::Vector2d corner = p - 18 * ahead + Eigen::Vector2d(ahead.x() > 0 ? -width : 0, 6);
    corner.x() = std::clamp(corner.x(), 6.0, std::max(6.0, image_.cols - 6.0 - width));
    corner.y() = std::clamp(corner.y(), 50.0, image_.rows - 8.0);
    canvas::text(image_, words, corner, colour, kNameSize);
  }

  const Scene& scene_;
  Eigen::Vector2d low_, high_;
  double scale_ = 1;
  cv::Mat image_;
};

}  // namespace

cv::Mat draw_scene_plan(const Scene& scene) { return Plan(scene).draw(); }

}  // namespace plaza
