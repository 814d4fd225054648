#include "plugins/sinks/drawing/canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace plaza::drawing {
namespace {

constexpr int kShift = 4;  // sixteenths of a pixel
constexpr double kMargin_px = 64;

cv::Point fixed(Point p) { return {cvRound(p.x * (1 << kShift)), cvRound(p.y * (1 << kShift))}; }

struct Segment {
  Point a, b;
};

/// The part of a segment near the image (Liang-Barsky).
std::optional<Segment> clipped(Point a, Point b, cv::Size size) {
  if (!(std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(b.x) && std::isfinite(b.y))) {
    return std::nullopt;
  }
  const Point d = b - a;
  double enter = 0, leave = 1;
  const auto cut = [&](double direction, double room) {
    if (direction == 0) return room >= 0;
    const double t = room / direction;
    if (direction < 0) enter = std::max(enter, t);
    if (direction > 0) leave = std::min(leave, t);
    return enter <= leave;
  };
  if (!cut(-d.x, a.x + kMargin_px) || !cut(d.x, size.width + kMargin_px - a.x) ||
      !cut(-d.y, a.y + kMargin_px) || !cut(d.y, size.height + kMargin_px - a.y)) {
    return std::nullopt;
  }
  return Segment{a + d * enter, a + d * leave};
}

void draw_segment(cv::Mat& image, Point a, Point b, const Stroke& stroke) {
  if (const auto s = clipped(a, b, image.size())) {
    cv::line(image, fixed(s->a), fixed(s->b), stroke.color, stroke.width_px, cv::LINE_AA, kShift);
  }
}

/// Draws the dashes of a segment; `phase_px` runs on from one segment of a path to the next.
void draw_dashes(cv::Mat& image, Point a, Point b, const Stroke& stroke, double& phase_px) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const auto s = clipped(a, b, image.size());
  if (s && length > 0) {
    const Point along = (b - a) / length;
    const double period = 2 * stroke.dash_px;
    const double from = std::hypot(s->a.x - a.x, s->a.y - a.y);
    const double to = std::hypot(s->b.x - a.x, s->b.y - a.y);
    for (double k = std::floor((phase_px + from) / period);; ++k) {
      const double begin = std::max(from, k * period - phase_px);
      const double end = std::min(to, k * period + stroke.dash_px - phase_px);
      if (begin >= to) break;
      if (end > begin) draw_segment(image, a + along * begin, a + along * end, stroke);
    }
  }
  phase_px += length;
}

}  // namespace

void draw_path(cv::Mat& image, std::span<const Point> path, bool closed, const Stroke& stroke) {
  if (path.size() < 2) return;
  double phase_px = 0;
  const std::size_t segments = closed ? path.size() : path.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Point a = path[i];
    const Point b = path[(i + 1) % path.size()];
    if (stroke.dash_px > 0) {
      draw_dashes(image, a, b, stroke, phase_px);
    } else {
      draw_segment(image, a, b, stroke);
    }
  }
}

void draw_seamed_path(cv::Mat& image, std::span<const Point> path, bool closed,
                      const Stroke& stroke) {
  Stroke seam = stroke;
  seam.color = mix(stroke.color, Color(0, 0, 0), 0.2);
  seam.width_px += 2;
  draw_path(image, path, closed, seam);
  draw_path(image, path, closed, stroke);
}

void draw_box(cv::Mat& image, const Box& box, const Stroke& stroke) {
  const double left = std::round(box.left), right = std::round(box.right());
  const double top = std::round(box.top), bottom = std::round(box.bottom());
  const Path corners = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
  draw_seamed_path(image, corners, true, stroke);
}

void fill_convex(cv::Mat& image, std::span<const Point> polygon, const Color& color) {
  if (polygon.size() < 3) return;
  std::vector<cv::Point> corners;
  for (const Point& p : polygon) {
    if (!(std::abs(p.x) < 1e5 && std::abs(p.y) < 1e5))
      return;  // far outside: degenerate projections
    corners.push_back(fixed(p));
  }
  cv::fillConvexPoly(image, corners, color, cv::LINE_AA, kShift);
}

void draw_disk(cv::Mat& image, Point centre, double radius_px, const Color& color) {
  if (!clipped(centre, centre, image.size())) return;
  cv::circle(image, fixed(centre), cvRound(radius_px * (1 << kShift)), color, cv::FILLED,
             cv::LINE_AA, kShift);
}

void draw_ring(cv::Mat& image, Point centre, double radius_px, const Stroke& stroke) {
  if (!clipped(centre, centre, image.size())) return;
  cv::circle(image, fixed(centre), cvRound(radius_px * (1 << kShift)), stroke.color,
             stroke.width_px, cv::LINE_AA, kShift);
}

void blend(cv::Mat& image, const cv::Mat& layer, double share) {
  cv::addWeighted(layer, share, image, 1 - share, 0, image);
}

namespace {

constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kCapitals_px = 21;  // height of capitals at scale 1

int pen_px(double height_px) { return height_px >= 18 ? 2 : 1; }

Point top_left_of(cv::Size2d size, Point at, Anchor anchor) {
  switch (anchor) {
    case Anchor::kTopLeft:
      return at;
    case Anchor::kTopRight:
      return {at.x - size.width, at.y};
    case Anchor::kTopCentre:
      return {at.x - size.width / 2, at.y};
    case Anchor::kCentre:
      return {at.x - size.width / 2, at.y - size.height / 2};
    case Anchor::kBottomLeft:
      return {at.x, at.y - size.height};
    case Anchor::kBottomCentre:
      return {at.x - size.width / 2, at.y - size.height};
  }
  return at;
}

void put_text(cv::Mat& image, const std::string& text, Point top_left, double height_px,
              const Color& color) {
  const cv::Point base(cvRound(top_left.x), cvRound(top_left.y + height_px));
  cv::putText(image, text, base, kFont, height_px / kCapitals_px, color, pen_px(height_px),
              cv::LINE_AA);
}

}  // namespace

cv::Size2d text_size(const std::string& text, double height_px) {
  const cv::Size size =
      cv::getTextSize(text, kFont, height_px / kCapitals_px, pen_px(height_px), nullptr);
  return {static_cast<double>(size.width), height_px};
}

void draw_text(cv::Mat& image, const std::string& text, Point at, const TextStyle& style) {
  const cv::Size2d size = text_size(text, style.height_px);
  put_text(image, text, top_left_of(size, at, style.anchor), style.height_px, style.color);
}

void draw_plate(cv::Mat& image, const std::string& text, Point at, const TextStyle& style) {
  const double pad = std::round(style.height_px * 0.4);
  const cv::Size2d ink = text_size(text, style.height_px);
  const cv::Size2d plate(ink.width + 2 * pad, ink.height + 2 * pad);
  Point corner = top_left_of(plate, at, style.anchor);
  corner.x = std::round(std::max(0.0, std::min(corner.x, image.cols - plate.width)));
  corner.y = std::round(std::max(0.0, std::min(corner.y, image.rows - plate.height)));
  cv::rectangle(image, cv::Rect(cv::Point(corner), cv::Size(plate)), style.color, cv::FILLED);
  put_text(image, text, corner + Point(pad, pad), style.height_px, ink_on(style.color));
}

}  // namespace plaza::drawing
