#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "plugins/sinks/drawing/canvas.h"

namespace plaza::reliability_diagram {

struct Range {
  double low = 0, high = 1;
};

struct ChartText {
  std::string title, along_x, along_y;
  std::vector<std::string> remarks;  ///< in the quiet colour, lines below the title
};

/// Axes with a grid in a part of a picture, and marks in their coordinates.
class Chart {
 public:
  /// Draws title, axes, grid and labels into `place` of `picture`, which the chart keeps.
  Chart(const cv::Mat& picture, const cv::Rect& place, const Range& x, const Range& y,
        const ChartText& text);

  drawing::Point pixel(double x, double y) const;
  /// Through points in the chart's coordinates.
  void line(std::span<const drawing::Point> points, const drawing::Stroke& stroke);
  void dot(double x, double y, double radius_px, const drawing::Color& color);
  /// From the x axis up to `y`, between both x.
  void bar(double from_x, double to_x, double y, const drawing::Color& color);
  /// What a colour means: a sample and a text below the axis, after those before it.
  void key(const std::string& text, const drawing::Color& color);

 private:
  void draw_axes(const ChartText& text);

  cv::Mat picture_;
  cv::Rect field_;
  drawing::Point next_key_;
  Range x_, y_;
};

}  // namespace plaza::reliability_diagram
