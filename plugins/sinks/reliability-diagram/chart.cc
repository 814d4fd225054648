#include "plugins/sinks/reliability-diagram/chart.h"

#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "plugins/sinks/drawing/ground_view.h"

namespace plaza::reliability_diagram {
namespace {

constexpr double kTitle_px = 14, kText_px = 10;
constexpr int kLeft = 58, kRight = 18, kTop = 78, kBottom = 100;

std::string number_text(double value, double step) {
  char text[32];
  const int digits = step >= 1 ? 0 : static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
  std::snprintf(text, sizeof text, "%.*f", digits, std::abs(value) < step / 2 ? 0.0 : value);
  return text;
}

/// Text that runs upwards, centred.
void draw_upright(cv::Mat& picture, const std::string& text, drawing::Point centre,
                  const drawing::Color& color, const drawing::Color& paper) {
  const cv::Size2d size = drawing::text_size(text, kText_px);
  const int width = cvCeil(size.width) + 4, height = cvCeil(size.height) + 10;
  cv::Mat flat(height, width, CV_8UC3, paper), turned;
  drawing::draw_text(flat, text, {2, 4}, {kText_px, color});
  cv::rotate(flat, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  const cv::Rect place(cvRound(centre.x) - turned.cols / 2, cvRound(centre.y) - turned.rows / 2,
                       turned.cols, turned.rows);
  const cv::Rect inside = place & cv::Rect(0, 0, picture.cols, picture.rows);
  turned(inside - place.tl()).copyTo(picture(inside));
}

}  // namespace

Chart::Chart(const cv::Mat& picture, const cv::Rect& place, const Range& x, const Range& y,
             const ChartText& text)
    : picture_(picture),
      field_(place.x + kLeft, place.y + kTop, place.width - kLeft - kRight,
             place.height - kTop - kBottom),
      next_key_(field_.x, field_.y + field_.height + 54.0),
      x_(x),
      y_(y) {
  draw_axes(text);
}

drawing::Point Chart::pixel(double x, double y) const {
  return {field_.x + field_.width * (x - x_.low) / (x_.high - x_.low),
          field_.y + field_.height * (1 - (y - y_.low) / (y_.high - y_.low))};
}

void Chart::draw_axes(const ChartText& text) {
  const drawing::Theme& theme = drawing::light_theme();
  picture_(field_).setTo(theme.floor);
  const drawing::Stroke grid{theme.grid, 1};
  const double x_step = drawing::round_step((x_.high - x_.low) / 6);
  for (const double x : drawing::multiples(x_.low, x_.high, x_step)) {
    const drawing::Path path = {pixel(x, y_.low), pixel(x, y_.high)};
    drawing::draw_path(picture_, path, false, grid);
    drawing::draw_text(picture_, number_text(x, x_step), path[0] + drawing::Point(0, 8),
                       {kText_px, theme.quiet_text, drawing::Anchor::kTopCentre});
  }
  const double y_step = drawing::round_step((y_.high - y_.low) / 6);
  for (const double y : drawing::multiples(y_.low, y_.high, y_step)) {
    const drawing::Path path = {pixel(x_.low, y), pixel(x_.high, y)};
    drawing::draw_path(picture_, path, false, grid);
    drawing::draw_text(picture_, number_text(y, y_step), path[0] + drawing::Point(-8, -5),
                       {kText_px, theme.quiet_text, drawing::Anchor::kTopRight});
  }
  const drawing::Path axes = {pixel(x_.low, y_.high), pixel(x_.low, y_.low),
                              pixel(x_.high, y_.low)};
  drawing::draw_path(picture_, axes, false, {theme.border, 1});
  const auto left = static_cast<double>(field_.x);
  double line = field_.y - 64.0;
  drawing::draw_text(picture_, text.title, {left, line}, {kTitle_px, theme.text});
  line += 24;
  for (const std::string& remark : text.remarks) {
    drawing::draw_text(picture_, remark, {left, line}, {kText_px, theme.quiet_text});
    line += 18;
  }
  drawing::draw_text(picture_, text.along_x,
                     {left + field_.width / 2.0, field_.y + field_.height + 30.0},
                     {kText_px, theme.text, drawing::Anchor::kTopCentre});
  draw_upright(picture_, text.along_y, {left - 46.0, field_.y + field_.height / 2.0}, theme.text,
               theme.paper);
}

void Chart::line(std::span<const drawing::Point> points, const drawing::Stroke& stroke) {
  drawing::Path path;
  for (const drawing::Point& p : points) path.push_back(pixel(p.x, p.y));
  drawing::draw_path(picture_, path, false, stroke);
}

void Chart::dot(double x, double y, double radius_px, const drawing::Color& color) {
  drawing::draw_disk(picture_, pixel(x, y), radius_px + 1, drawing::light_theme().paper);
  drawing::draw_disk(picture_, pixel(x, y), radius_px, color);
}

void Chart::bar(double from_x, double to_x, double y, const drawing::Color& color) {
  const drawing::Path corners = {pixel(from_x, y_.low), pixel(from_x, y), pixel(to_x, y),
                                 pixel(to_x, y_.low)};
  drawing::fill_convex(picture_, corners, color);
}

void Chart::key(const std::string& text, const drawing::Color& color) {
  constexpr double kSample_px = 16, kGap_px = 6, kRow_px = 20;
  const double width = kSample_px + kGap_px + drawing::text_size(text, kText_px).width;
  if (next_key_.x > field_.x && next_key_.x + width > field_.x + field_.width) {
    next_key_ = {static_cast<double>(field_.x), next_key_.y + kRow_px};
  }
  const drawing::Path sample = {next_key_ + drawing::Point(0, kText_px / 2),
                                next_key_ + drawing::Point(kSample_px, kText_px / 2)};
  drawing::draw_path(picture_, sample, false, {color, 3});
  drawing::draw_text(picture_, text, next_key_ + drawing::Point(kSample_px + kGap_px, 0),
                     {kText_px, drawing::light_theme().text});
  next_key_.x += width + 3 * kGap_px;
}

}  // namespace plaza::reliability_diagram
