#include "plugins/sinks/drawing/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "plugins/sinks/drawing/ground_view.h"

namespace plaza::drawing {
namespace {

constexpr double kMargin = 0.06;  // around the area, as a share of its longer side

GroundArea grown(const GroundArea& area, double by_m) {
  const Eigen::Vector2d by(by_m, by_m);
  return {area.min_m - by, area.max_m + by};
}

double longer_side(const GroundArea& area) { return (area.max_m - area.min_m).maxCoeff(); }

std::string number(double value) {
  // steps are 1, 2 or 5 times a power of ten, so that six digits are always enough
  std::string text = std::to_string(std::abs(value) < 1e-9 ? 0 : value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// Contours of the ground that a camera sees, in pixels of the plan. They reach a little beyond its
/// picture, so that a contour drawn there never runs along the picture's border.
std::vector<std::vector<cv::Point>> seen_ground(const Camera& camera, const PlanMap& map,
                                                cv::Size size) {
  constexpr int kCell_px = 3;
  constexpr int kBeyond = 3;  // cells
  cv::Mat1b seen(size.height / kCell_px + 1 + 2 * kBeyond, size.width / kCell_px + 1 + 2 * kBeyond,
                 uchar{0});
  for (int y = 0; y < seen.rows; ++y) {
    for (int x = 0; x < seen.cols; ++x) {
      const Eigen::Vector2d ground =
          map.metres(Point((x - kBeyond) * kCell_px, (y - kBeyond) * kCell_px));
      const auto pixel = camera.project({ground.x(), ground.y(), 0});
      if (pixel && camera.contains(*pixel)) seen(y, x) = 255;
    }
  }
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(seen, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  for (auto& contour : contours) {
    for (cv::Point& p : contour) p = (p - cv::Point(kBeyond, kBeyond)) * kCell_px;
    std::vector<cv::Point> smooth;
    cv::approxPolyDP(contour, smooth, kCell_px, true);
    contour = std::move(smooth);
  }
  return contours;
}

void draw_fields_of_view(Plan& plan, const Scene& scene, const Theme& theme) {
  // where many cameras look, the ground must not become brighter than people
  const double tint = std::min(0.06, 0.3 / static_cast<double>(scene.cameras.size()));
  for (const Camera& camera : scene.cameras) {
    const auto contours = seen_ground(camera, plan.map, plan.picture.size());
    cv::Mat layer = plan.picture.clone();
    cv::drawContours(layer, contours, -1, theme.camera, cv::FILLED, cv::LINE_AA);
    blend(plan.picture, layer, tint);
    layer = plan.picture.clone();
    cv::drawContours(layer, contours, -1, theme.camera, 1, cv::LINE_AA);
    blend(plan.picture, layer, 0.3);
  }
}

void draw_grid(Plan& plan, const Scene& scene, const Theme& theme, double text_px) {
  const GroundArea& area = scene.area;
  const double step_m = round_step(std::max(longer_side(area) / 24, 1e-3));
  const double label_step_m = round_step(std::max(step_m, 5 * text_px / plan.map.px_per_m()));
  const Stroke line{theme.grid, 1};
  const TextStyle label{text_px, theme.quiet_text, Anchor::kTopCentre};
  const Point gap(0, 0.5 * text_px);
  for (const double x : multiples(area.min_m.x(), area.max_m.x(), step_m)) {
    const Point foot = plan.map.pixel({x, area.min_m.y()});
    draw_path(plan.picture, Path{foot, plan.map.pixel({x, area.max_m.y()})}, false, line);
  }
  for (const double y : multiples(area.min_m.y(), area.max_m.y(), step_m)) {
    const Point left = plan.map.pixel({area.min_m.x(), y});
    draw_path(plan.picture, Path{left, plan.map.pixel({area.max_m.x(), y})}, false, line);
  }
  for (const double x : multiples(area.min_m.x(), area.max_m.x(), label_step_m)) {
    draw_text(plan.picture, number(x), plan.map.pixel({x, area.min_m.y()}) + gap, label);
  }
  TextStyle left_label = label;
  left_label.anchor = Anchor::kTopRight;
  for (const double y : multiples(area.min_m.y(), area.max_m.y(), label_step_m)) {
    const Point at = plan.map.pixel({area.min_m.x(), y}) - Point(0.5 * text_px, 0.5 * text_px);
    draw_text(plan.picture, number(y), at, left_label);
  }
  const Point a = plan.map.pixel(area.min_m), b = plan.map.pixel(area.max_m);
  draw_path(plan.picture, Path{a, {b.x, a.y}, b, {a.x, b.y}}, true, {theme.border, 1});
}

void draw_scale_bar(Plan& plan, const Theme& theme, double text_px) {
  const double length_m = round_step(0.1 * plan.picture.cols / plan.map.px_per_m());
  const double length_px = length_m * plan.map.px_per_m();
  const Point right(plan.picture.cols - 1.5 * text_px, plan.picture.rows - 1.5 * text_px);
  const Point left = right - Point(length_px, 0);
  const Point tick(0, 0.4 * text_px);
  const Stroke stroke{theme.text, 1};
  draw_path(plan.picture, Path{left, right}, false, {theme.text, 2});
  draw_path(plan.picture, Path{left - tick, left + tick}, false, stroke);
  draw_path(plan.picture, Path{right - tick, right + tick}, false, stroke);
  draw_text(plan.picture, number(length_m) + " m", (left + right) / 2 - Point(0, 0.7 * text_px),
            {text_px, theme.text, Anchor::kBottomCentre});
}

/// Direction in which a camera looks, seen from above, in the plan's pixels; zero when straight
/// down.
Point looking(const Camera& camera) {
  const auto ray = camera.ray({0.5 * (camera.width() - 1), 0.5 * (camera.height() - 1)});
  if (!ray) return {};
  const Eigen::Vector2d d = ray->direction.head<2>();
  const double length = d.norm();
  return length < 1e-6 ? Point() : Point(d.x() / length, -d.y() / length);
}

/// A body with a lens that opens towards what the camera sees.
void draw_camera_symbol(cv::Mat& picture, Point at, Point ahead, double size, const Color& color) {
  if (ahead == Point()) {
    draw_ring(picture, at, 1.2 * size, {color, 1});
    draw_disk(picture, at, 0.6 * size, color);
    return;
  }
  const Point side(-ahead.y, ahead.x);
  const auto corner = [&](double along, double across) {
    return at + ahead * (along * size) + side * (across * size);
  };
  fill_convex(picture,
              Path{corner(-1.5, -0.75), corner(0.3, -0.75), corner(0.3, 0.75), corner(-1.5, 0.75)},
              color);
  fill_convex(picture, Path{corner(0.5, 0), corner(1.5, -0.9), corner(1.5, 0.9)}, color);
}

void draw_camera(Plan& plan, const Camera& camera, const Theme& theme, double text_px) {
  const double inset = 1.2 * text_px;
  const Point exact = plan.map.pixel(camera.centre().head<2>());
  const Point at(std::clamp(exact.x, inset, std::max(inset, plan.picture.cols - 1 - inset)),
                 std::clamp(exact.y, inset, std::max(inset, plan.picture.rows - 1 - inset)));
  const Point ahead = looking(camera);
  draw_camera_symbol(plan.picture, at, ahead, 0.55 * text_px, theme.camera);

  // Behind the camera, where it sees nothing, there is room for its name; else wherever it fits.
  const cv::Size2d name = text_size(camera.name(), text_px);
  const double beside = 1.3 * text_px + name.width / 2, over = 1.9 * text_px;
  const std::array<Point, 5> offsets = {Point(-ahead.x * beside, -ahead.y * over), Point(beside, 0),
                                        Point(-beside, 0), Point(0, -over), Point(0, over)};
  for (const Point& offset : offsets) {
    const cv::Rect2d box(at + offset - Point(name.width / 2, name.height / 2), name);
    const cv::Rect2d room(2, 2, plan.picture.cols - 4, plan.picture.rows - 4);
    if ((box & room) != box) continue;
    draw_text(plan.picture, camera.name(), box.tl(), {text_px, theme.camera, Anchor::kTopLeft});
    return;
  }
}

}  // namespace

PlanMap::PlanMap(const GroundArea& extent, const cv::Rect& picture) {
  const Eigen::Vector2d size_m = extent.max_m - extent.min_m;
  px_per_m_ = std::min(picture.width / size_m.x(), picture.height / size_m.y());
  const Eigen::Vector2d middle_m = 0.5 * (extent.min_m + extent.max_m);
  const Point middle_px(picture.x + 0.5 * (picture.width - 1),
                        picture.y + 0.5 * (picture.height - 1));
  origin_px_ = middle_px + Point(-middle_m.x(), middle_m.y()) * px_per_m_;
}

Point PlanMap::pixel(const Eigen::Vector2d& p_m) const {
  return origin_px_ + Point(p_m.x(), -p_m.y()) * px_per_m_;
}

Eigen::Vector2d PlanMap::metres(const Point& pixel) const {
  return {(pixel.x - origin_px_.x) / px_per_m_, (origin_px_.y - pixel.y) / px_per_m_};
}

GroundArea plan_extent(const Scene& scene) {
  // An area of no size is refused when the scene is read; a person's width keeps the arithmetic
  // safe.
  const double side_m = std::max(longer_side(scene.area), 1.0);
  const GroundArea nearby = grown(scene.area, 0.35 * side_m);
  GroundArea extent = grown(scene.area, kMargin * side_m);
  for (const Camera& camera : scene.cameras) {
    const Eigen::Vector2d at = camera.centre().head<2>();
    if (!nearby.contains(at)) continue;
    const Eigen::Vector2d room = Eigen::Vector2d::Constant(0.5 * kMargin * side_m);
    extent.min_m = extent.min_m.cwiseMin(at - room);
    extent.max_m = extent.max_m.cwiseMax(at + room);
  }
  return extent;
}

double legend_height(double text_px) { return std::round(3 * text_px); }

Plan draw_plan(const Scene& scene, cv::Size size, const Theme& theme, const PlanStyle& style) {
  // Axis labels need room at the left and below the area, and the strip at the foot is for the
  // legend.
  const double u = style.text_px;
  const int strip_px = std::min(size.height - 1, cvRound(legend_height(u)));
  const cv::Size ground(size.width, size.height - strip_px);
  const cv::Rect inside(cvRound(2.5 * u), 0, std::max(1, ground.width - cvRound(2.5 * u)),
                        std::max(1, ground.height - cvRound(2 * u)));
  const cv::Mat picture(size, CV_8UC3, theme.paper);
  Plan plan{picture(cv::Rect({0, 0}, ground)), PlanMap(plan_extent(scene), inside)};
  const Point a = plan.map.pixel(scene.area.min_m), b = plan.map.pixel(scene.area.max_m);
  fill_convex(plan.picture, Path{a, {b.x, a.y}, b, {a.x, b.y}}, theme.floor);
  if (style.fields_of_view) draw_fields_of_view(plan, scene, theme);
  draw_grid(plan, scene, theme, u);
  for (const Camera& camera : scene.cameras) draw_camera(plan, camera, theme, u);
  plan.picture = picture;
  draw_scale_bar(plan, theme, u);
  return plan;
}

namespace {

double dot_radius(const PlanMap& map, double text_px) {
  return std::max(0.5 * text_px, 0.25 * map.px_per_m());
}

void draw_dot(cv::Mat& picture, const PlanMap& map, const PlanPerson& person, double text_px,
              const Theme& theme) {
  const Color color = color_of(person.id);
  const Point at = map.pixel(person.position_m);
  const double radius = dot_radius(map, text_px);
  if (person.heading_rad) {
    const double length_m = 3 * radius / map.px_per_m();
    const GroundArrow arrow = ground_arrow(person.position_m, *person.heading_rad, length_m);
    Path head;
    for (const Eigen::Vector2d& corner : arrow.head_m) head.push_back(map.pixel(corner));
    draw_path(picture, Path{at, map.pixel(arrow.neck_m)}, false, {color, 2});
    fill_convex(picture, head, color);
  }
  draw_disk(picture, at, radius + 1, theme.paper);
  draw_disk(picture, at, radius, color);
  if (!person.observed) draw_disk(picture, at, 0.55 * radius, theme.paper);
}

}  // namespace

void draw_people(cv::Mat& picture, const PlanMap& map, std::span<const PlanPerson> people,
                 double text_px, const Theme& theme) {
  for (const PlanPerson& person : people) draw_dot(picture, map, person, text_px, theme);
  for (const PlanPerson& person : people) {  // last, so that no dot hides a neighbour's id
    // on the side where the arrow isn't
    const bool left = person.heading_rad && std::cos(*person.heading_rad) > 0.3;
    const double beside = dot_radius(map, text_px) + 0.4 * text_px;
    const Point at = map.pixel(person.position_m) + Point(left ? -beside : beside, -0.5 * text_px);
    draw_text(picture, std::to_string(person.id), at,
              {text_px, theme.text, left ? Anchor::kTopRight : Anchor::kTopLeft});
  }
}

}  // namespace plaza::drawing
