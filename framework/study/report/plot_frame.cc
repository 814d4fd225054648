#include "framework/study/report/plot_frame.h"

#include <algorithm>

namespace plaza::plot {

std::string axis_title(const MetricColumn& column) {
  std::string title = column.title();
  if (!column.metric.unit.empty()) title += " [" + column.metric.unit + "]";
  if (column.metric.better == Better::kHigher) title += " ↑";
  if (column.metric.better == Better::kLower) title += " ↓";
  return title;
}

Scale vertical_axis(Svg& svg, const std::vector<double>& values, const std::string& name) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const std::vector<double> ticks = nice_ticks(*least, *most, 5);
  const Scale scale{ticks.front(), ticks.back(), kHeight - kBottom, kTop};
  for (const double tick : ticks) {
    svg.line(kLeft, scale.at(tick), kWidth - kRight, scale.at(tick), kGrid);
    svg.text(kLeft - 6, scale.at(tick) + 4, "end", tick_text(tick, ticks[1] - ticks[0]));
  }
  svg.line(kLeft, kTop, kLeft, kHeight - kBottom, kAxis);
  svg.vertical_text(14, (kTop + kHeight - kBottom) / 2, name);
  return scale;
}

void horizontal_line(Svg& svg, const std::string& name) {
  svg.line(kLeft, kHeight - kBottom, kWidth - kRight, kHeight - kBottom, kAxis);
  svg.text((kLeft + kWidth - kRight) / 2, kHeight - 8, "middle", name);
}

std::string fitted(const std::string& label, double width) {
  const auto most = static_cast<std::size_t>(std::max(width / 6.2, 3.0));
  return label.size() <= most ? label : label.substr(0, most - 1) + "…";
}

}  // namespace plaza::plot
