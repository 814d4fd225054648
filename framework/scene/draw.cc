#include "framework/scene/draw.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "framework/scene/draw_canvas.h"
#include "framework/scene/fields.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kWidth_px = 1200;  // at least; smaller images are enlarged by a whole number

class ViewPicture {
 public:
  ViewPicture(const Scene& scene, const Camera& camera, const cv::Mat& background)
      : scene_(scene), camera_(camera) {
    const int factor = std::max(1, static_cast<int>(std::round(kWidth_px / camera.width())));
    camera_ = camera.scaled({camera.width() * factor, camera.height() * factor});
    factor_ = factor;
    const cv::Size size(camera_.width(), camera_.height());
    if (background.empty()) {
      image_ = cv::Mat(size, CV_8UC3, canvas::kPaper);
    } else {
      cv::resize(background, image_, size, 0, 0, cv::INTER_CUBIC);
    }
  }

  cv::Mat draw(const Camera& original) {
    draw_grid();
    draw_border();
    draw_numbers();  // over the lines, so that no line crosses them
    draw_occluders(original.name());
    draw_bodies();
    draw_axes();
    const Eigen::Vector3d c = camera_.centre();
    canvas::text(image_,
                 original.name() + "   " + std::to_string(original.width()) + " x " +
                     std::to_string(original.height()) + " px   at (" + metres(c.x()) + ", " +
                     metres(c.y()) + ", " + metres(c.z()) + ") m   grid " +
                     short_number(grid_step_m(scene_.area.max_m - scene_.area.min_m)) + " m",
                 {14, 28}, canvas::kInk, 0.65);
    return image_;
  }

 private:
  static std::string metres(double value) { return short_number(std::round(value * 100) / 100); }

  bool near_image(const Eigen::Vector2d& p) const {
    return p.x() > -camera_.width() && p.x() < 2.0 * camera_.width() && p.y() > -camera_.height() &&
           p.y() < 2.0 * camera_.height();
  }

  /// A straight line in the world, a curve in the image, cut where it leaves the view.
  void world_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const cv::Scalar& colour,
                  int thickness) {
    const int steps = std::max(8, static_cast<int>((b - a).norm() / 0.2));
    Points run;
    for (int i = 0; i <= steps; ++i) {
      const auto pixel = camera_.project(a + (b - a) * (double(i) / steps));
      if (pixel && near_image(*pixel)) {
        run.push_back(*pixel);
        if (i < steps) continue;
      }
      if (run.size() > 1) canvas::polyline(image_, run, false, colour, thickness);
      run.clear();
    }
  }

  void label(const std::string& words, const Eigen::Vector3d& at, const cv::Scalar& colour,
             double size) {
    const auto pixel = camera_.project(at);
    if (pixel && camera_.contains(*pixel))
      canvas::centred_text(image_, words, *pixel, colour, size);
  }

  void draw_grid() {
    const Eigen::Vector2d low = scene_.area.min_m, high = scene_.area.max_m;
    const double step = grid_step_m(high - low);
    for (int axis = 0; axis < 2; ++axis) {
      const int other = 1 - axis;
      for (double v = std::ceil(low[axis] / step) * step; v <= high[axis]; v += step) {
        Eigen::Vector3d a = Eigen::Vector3d::Zero(), b = a;
        a[axis] = b[axis] = v;
        a[other] = low[other];
        b[other] = high[other];
        const bool fifth = std::abs(std::remainder(v / step, 5)) < 1e-6;
        world_line(a, b, fifth ? canvas::kGridStrong : canvas::kGrid, fifth ? 2 : 1);
      }
    }
  }

  void draw_border() {
    const Eigen::Vector2d &l = scene_.area.min_m, &h = scene_.area.max_m;
    const Eigen::Vector3d corners[] = {
        {l.x(), l.y(), 0}, {h.x(), l.y(), 0}, {h.x(), h.y(), 0}, {l.x(), h.y(), 0}};
    for (int i = 0; i < 4; ++i) world_line(corners[i], corners[(i + 1) % 4], canvas::kArea, 3);
  }

  void draw_numbers() {
    const Eigen::Vector2d low = scene_.area.min_m, high = scene_.area.max_m;
    const double step = grid_step_m(high - low);
    for (int axis = 0; axis < 2; ++axis) {
      for (double v = std::ceil(low[axis] / (5 * step)) * 5 * step; v <= high[axis];
           v += 5 * step) {
        for (const double end : {low[1 - axis], high[1 - axis]}) {
          Eigen::Vector3d at = Eigen::Vector3d::Zero();
          at[axis] = v;
          at[1 - axis] = end;
          label((axis == 0 ? "x " : "y ") + short_number(v + 0.0), at, canvas::kInk, 0.5);
        }
      }
    }
  }

  void draw_occluders(const std::string& name) {
    for (const StaticOccluder& occluder : scene_.occluders) {
      if (occluder.camera != name) continue;
      Points polygon;
      Eigen::Vector2d low(1e9, 1e9), high = -low;
      for (const Eigen::Vector2d& p : occluder.polygon_px) {
        polygon.push_back((p + Eigen::Vector2d(0.5, 0.5)) * factor_ - Eigen::Vector2d(0.5, 0.5));
        low = low.cwiseMin(polygon.back());
        high = high.cwiseMax(polygon.back());
      }
      canvas::fill(image_, polygon, canvas::kOccluder, 0.35);
      canvas::polyline(image_, polygon, true, canvas::kOccluder, 2);
      canvas::text(image_, occluder.name, {high.x() + 8, 0.5 * (low.y() + high.y()) + 5},
                   canvas::kOccluder, 0.5);
    }
  }

  void draw_bodies() {
    const Eigen::Vector2d size = scene_.area.max_m - scene_.area.min_m;
    for (const double fx : {0.15, 0.5, 0.85}) {
      for (const double fy : {0.15, 0.5, 0.85}) {
        draw_body(scene_.area.min_m + Eigen::Vector2d(fx * size.x(), fy * size.y()));
      }
    }
  }

  void draw_body(const Eigen::Vector2d& position) {
    const Body& body = scene_.body;
    const auto box = body_box(camera_, position, body);
    if (!box || !near_image({box->left, box->top})) return;
    for (const double z : {0.0, body.height_m}) {
      Points rim;
      for (int i = 0; i < 48; ++i) {
        const double angle = i * std::numbers::pi / 24;
        const auto pixel = camera_.project({position.x() + body.radius_m * std::cos(angle),
                                            position.y() + body.radius_m * std::sin(angle), z});
        if (pixel) rim.push_back(*pixel);
      }
      if (z == 0) canvas::fill(image_, rim, canvas::kBody, 0.3);
      canvas::polyline(image_, rim, true, canvas::kBody, 1);
    }
    world_line({position.x(), position.y(), 0}, {position.x(), position.y(), body.height_m},
               canvas::kBody, 1);
    canvas::polyline(image_,
                     {{box->left, box->top},
                      {box->right(), box->top},
                      {box->right(), box->bottom()},
                      {box->left, box->bottom()}},
                     true, canvas::kBody, 2);
  }

  void draw_axes() {
    const cv::Scalar colours[] = {{40, 40, 220}, {40, 150, 40}, {210, 90, 30}};
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d end = (axis < 2 ? 2.0 : 1.0) * Eigen::Vector3d::Unit(axis);
      world_line(Eigen::Vector3d::Zero(), end, colours[axis], 3);
      label(std::string(1, "xyz"[axis]), 1.15 * end, colours[axis], 0.7);
    }
  }

  const Scene& scene_;
  Camera camera_;
  int factor_ = 1;
  cv::Mat image_;
};

void write(const std::filesystem::path& file, const cv::Mat& image,
           std::vector<std::filesystem::path>& files) {
  if (!cv::imwrite(file.string(), image)) {
    throw UserError("\"" + file.string() + "\" cannot be written; is the folder writable?");
  }
  files.push_back(file);
}

}  // namespace

cv::Mat draw_scene_view(const Scene& scene, std::size_t camera, const Backgrounds& backgrounds) {
  const Camera& view = scene.cameras.at(camera);
  cv::Mat background;
  if (const auto found = backgrounds.find(view.name()); found != backgrounds.end()) {
    background = found->second;
    if (background.cols != view.width() || background.rows != view.height()) {
      throw UserError("camera \"" + view.name() + "\": the background has " +
                      std::to_string(background.cols) + "x" + std::to_string(background.rows) +
                      " pixels, the camera " + std::to_string(view.width()) + "x" +
                      std::to_string(view.height()));
    }
  }
  return ViewPicture(scene, view, background).draw(view);
}

std::vector<std::filesystem::path> draw_scene_grid(const Scene& scene,
                                                   const std::filesystem::path& folder,
                                                   const Backgrounds& backgrounds) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw UserError("the folder \"" + folder.string() + "\" cannot be made: " + error.message());
  }
  std::vector<std::filesystem::path> files;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    write(folder / (scene.cameras[i].name() + ".png"), draw_scene_view(scene, i, backgrounds),
          files);
  }
  write(folder / "plan.png", draw_scene_plan(scene), files);
  return files;
}

}  // namespace plaza
