#include "plugins/sinks/overlay-video/view_painter.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

#include "plugins/sinks/drawing/ground_view.h"

namespace plaza::overlay {
namespace {

using drawing::Anchor;
using drawing::Color;
using drawing::Path;
using drawing::Point;
using drawing::Stroke;

constexpr double kArrow_m = 0.9;
constexpr double kBridgedDash_px = 6;

const Color kTruth(255, 255, 255);

}  // namespace

ViewPainter::ViewPainter(const Scene& scene, std::size_t camera, cv::Size tile,
                         const ViewStyle& style)
    : index_(camera),
      camera_(scene.cameras.at(camera).scaled({tile.width, tile.height})),
      body_(scene.body),
      area_(scene.area),
      tile_(tile),
      scale_x_(static_cast<double>(tile.width) / scene.cameras[camera].width()),
      scale_y_(static_cast<double>(tile.height) / scene.cameras[camera].height()),
      text_px_(std::clamp(std::round(tile.height / 48.0), 7.0, 16.0)),
      line_px_(tile.height >= 500 ? 2 : 1),
      style_(style) {
  const drawing::Theme& theme = drawing::dark_theme();
  plain_ = cv::Mat(tile_, CV_8UC3, theme.floor);
  const double step_m = drawing::round_step((area_.max_m - area_.min_m).maxCoeff() / 24);
  drawing::draw_area_grid(plain_, camera_, area_, step_m, {theme.grid, 1},
                          {theme.border, line_px_});
}

void ViewPainter::paint(cv::Mat tile, const ViewContent& content) {
  paint_background(tile, content.image);
  if (content.truth) paint_truth(tile, *content.truth);
  if (content.trails) paint_trails(tile, *content.trails);

  // Whoever stands nearer hides who is behind, in the drawing as in the world.
  std::vector<const TrackPoint*> people;
  for (const TrackPoint& t : content.tracks) people.push_back(&t);
  const Eigen::Vector2d eye = camera_.centre().head<2>();
  std::stable_sort(people.begin(), people.end(), [&](const TrackPoint* a, const TrackPoint* b) {
    return (a->position_m - eye).squaredNorm() > (b->position_m - eye).squaredNorm();
  });
  for (const TrackPoint* person : people) paint_person(tile, *person);
  for (const TrackPoint* person : people) paint_label(tile, *person);

  const double gap = std::round(0.5 * text_px_);
  const std::string name = camera_.name() + (has_shown_image_ ? "" : " (no images)");
  drawing::draw_plate(tile, name, {gap, gap}, {text_px_, drawing::dark_theme().paper});
}

void ViewPainter::paint_background(cv::Mat& tile, const cv::Mat& image) {
  if (!image.empty()) {
    has_shown_image_ = true;
    const bool shrinks = tile_.width < image.cols;
    cv::resize(image, tile, tile_, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
    if (style_.area) {
      cv::Mat layer = tile.clone();
      drawing::draw_area_border(layer, camera_, area_, {Color(255, 255, 255), 1});
      drawing::blend(tile, layer, 0.6);
    }
    return;
  }
  if (!has_shown_image_) {
    plain_.copyTo(tile);
    return;
  }
  tile.setTo(drawing::dark_theme().paper * 0.7);
  // near the foot, where it is in nobody's way
  drawing::draw_text(tile, "no image", Point(tile_.width / 2.0, 0.9 * tile_.height),
                     {1.6 * text_px_, drawing::dark_theme().quiet_text, Anchor::kCentre});
}

void ViewPainter::paint_trails(cv::Mat& tile, const drawing::TrailMemory& trails) const {
  cv::Mat layer = tile.clone();
  for (const auto& [id, trail] : trails.trails()) {
    for (const auto piece : drawing::unbroken_pieces(trail, style_.trail_gap_frames)) {
      std::vector<Eigen::Vector2d> ground;
      for (const drawing::TrailPoint& p : piece) ground.push_back(p.position_m);
      for (const Path& path : drawing::seen_pieces(camera_, ground)) {
        drawing::draw_seamed_path(layer, path, false, {drawing::color_of(id), line_px_});
      }
    }
  }
  drawing::blend(tile, layer, 0.75);
}

void ViewPainter::paint_truth(cv::Mat& tile, const GroundTruth& truth) const {
  for (const TruePerson& person : truth.people) {
    for (const TrueView& view : person.views) {
      if (view.camera != index_) continue;
      const Box box = scaled(view.box);
      if (!in_picture(box)) continue;
      drawing::draw_box(tile, box, {kTruth, 1, 4});
    }
  }
}

void ViewPainter::paint_person(cv::Mat& tile, const TrackPoint& person) const {
  Stroke stroke{drawing::color_of(person.id), line_px_};
  if (!person.observed) stroke.dash_px = kBridgedDash_px;
  if (style_.draw != Draw::kBoxes) {
    if (const auto body = drawing::cylinder_outline(camera_, person.position_m, body_)) {
      drawing::draw_seamed_path(tile, body->contour, true, stroke);
      drawing::draw_path(tile, body->top, true, {stroke.color, 1});
      drawing::draw_path(tile, body->foot, true, {stroke.color, 1});
    }
  }
  if (style_.draw != Draw::kCylinders) {
    if (const auto box = box_of(person); box && in_picture(*box)) {
      drawing::draw_box(tile, *box, stroke);
    }
  }
  if (person.heading_rad) {
    drawing::draw_heading(tile, camera_, person.position_m, *person.heading_rad, kArrow_m,
                          {stroke.color, line_px_});
  }
}

void ViewPainter::paint_label(cv::Mat& tile, const TrackPoint& person) const {
  const auto box = box_of(person);
  if (!box || !in_picture(*box)) return;
  drawing::draw_plate(tile, std::to_string(person.id),
                      {box->left + box->width / 2, box->top - line_px_},
                      {text_px_, drawing::color_of(person.id), Anchor::kBottomCentre});
}

std::optional<Box> ViewPainter::box_of(const TrackPoint& person) const {
  // A cylinder's label belongs to the cylinder, wherever the measured box is.
  if (style_.draw != Draw::kCylinders) {
    for (const ViewBox& measured : person.boxes) {
      if (measured.camera == index_) return scaled(measured.box);
    }
  }
  return body_box(camera_, person.position_m, body_);
}

Box ViewPainter::scaled(const Box& box) const {
  // pixel centres are at integers, so that the image's corner is at (-0.5, -0.5)
  return {(box.left + 0.5) * scale_x_ - 0.5, (box.top + 0.5) * scale_y_ - 0.5, box.width * scale_x_,
          box.height * scale_y_};
}

bool ViewPainter::in_picture(const Box& box) const {
  return box.right() >= 0 && box.bottom() >= 0 && box.left <= tile_.width - 1 &&
         box.top <= tile_.height - 1;
}

}  // namespace plaza::overlay
