#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "framework/study/report/svg.h"
#include "framework/study/study_results.h"

/// What all plots of a study look like.
namespace plaza::plot {

inline constexpr int kWidth = 460, kHeight = 300;
inline constexpr double kLeft = 62, kRight = 16, kTop = 14, kBottom = 48;
inline constexpr const char* kGrid = "class=\"grid\"";
inline constexpr const char* kAxis = "class=\"axis\"";

/// "ground.mean_error_m [m] ↓": what an axis shows, and which way is better.
std::string axis_title(const MetricColumn& column);

/// Draws ticks, grid and name of the vertical axis over these values; its scale.
Scale vertical_axis(Svg& svg, const std::vector<double>& values, const std::string& name);

/// Draws the line and the name of the horizontal one.
void horizontal_line(Svg& svg, const std::string& name);

/// Shortens what would not fit into `width` pixels.
std::string fitted(const std::string& label, double width);

}  // namespace plaza::plot
