// Figures against what they cost.
#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/results/number_text.h"
#include "framework/study/report/plot_frame.h"
#include "framework/study/report/plots.h"
#include "framework/study/report/statistics.h"

namespace plaza {
namespace {

using namespace plot;

struct NumberedDot {
  std::size_t number = 0;
  double x = 0, y = 0;
};

/// "1-3, 7"; after a few the rest is left to what one points at.
std::string numbers_text(const std::vector<std::size_t>& numbers) {
  constexpr std::size_t kLongest = 18;
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i;
    while (end + 1 < numbers.size() && numbers[end + 1] == numbers[end] + 1) ++end;
    std::string piece = std::to_string(numbers[i]);
    if (end > i) piece += (end == i + 1 ? ", " : "-") + std::to_string(numbers[end]);
    if (!text.empty() && text.size() + piece.size() > kLongest) return text + ", …";
    text += (text.empty() ? "" : ", ") + piece;
    i = end + 1;
  }
  return text;
}

/// Writes the numbers of dots beside them; those that would cover each other share one text.
void add_numbers(Svg& svg, const std::vector<NumberedDot>& dots) {
  constexpr double kNearX = 40, kNearY = 11;
  std::vector<bool> done(dots.size(), false);
  for (std::size_t i = 0; i < dots.size(); ++i) {
    if (done[i]) continue;
    std::vector<std::size_t> numbers;
    double right = dots[i].x;
    for (std::size_t j = i; j < dots.size(); ++j) {
      if (done[j] || std::abs(dots[j].x - dots[i].x) > kNearX ||
          std::abs(dots[j].y - dots[i].y) > kNearY) {
        continue;
      }
      done[j] = true;
      numbers.push_back(dots[j].number);
      right = std::max(right, dots[j].x);
    }
    const std::string text = numbers_text(numbers);
    const bool fits = right + 7 + 5.5 * static_cast<double>(text.size()) < kWidth;
    svg.text(fits ? right + 7 : dots[i].x - 7, dots[i].y - 5, fits ? "start" : "end", text,
             "class=\"small\"");
  }
}

}  // namespace

std::optional<double> milliseconds_per_frame(const StudyResults& results, std::size_t variant) {
  constexpr double kMilliseconds = 1e3;
  std::vector<double> times;
  for (std::size_t j = 0; j < results.jobs.size(); ++j) {
    const JobOutcome& job = results.jobs[j];
    if (results.prepared->expansion.jobs[j].variant != variant || !job.done()) continue;
    if (job.result->frames <= 0 || job.result->node_seconds <= 0) continue;
    times.push_back(kMilliseconds * job.result->node_seconds /
                    static_cast<double>(job.result->frames));
  }
  if (times.empty()) return std::nullopt;
  return quantile(times, 0.5);
}

std::string time_plot(const StudyResults& results, std::size_t column) {
  struct Point {
    std::size_t variant;
    double ms, figure;
  };
  std::vector<Point> points;
  const auto& variants = results.prepared->expansion.variants;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const auto spread = spread_of(results.figures(v, column));
    const auto ms = milliseconds_per_frame(results, v);
    if (spread && ms) points.push_back({v, *ms, spread->median});
  }
  if (points.empty()) return {};
  std::vector<double> figures;
  double low = points[0].ms;
  double high = low;
  for (const Point& point : points) {
    figures.push_back(point.figure);
    low = std::min(low, point.ms);
    high = std::max(high, point.ms);
  }
  Svg svg(kWidth, kHeight);
  const std::string title = results.columns[column].title();
  const Scale y = vertical_axis(svg, figures, axis_title(results.columns[column]));
  const std::vector<double> ticks = nice_ticks(std::min(0.0, low), high, 5);
  const Scale x{ticks.front(), ticks.back(), kLeft, kWidth - kRight};
  for (const double tick : ticks) {
    svg.line(x.at(tick), kTop, x.at(tick), kHeight - kBottom, kGrid);
    svg.text(x.at(tick), kHeight - kBottom + 16, "middle", tick_text(tick, ticks[1] - ticks[0]));
  }
  horizontal_line(svg, "milliseconds per frame, all nodes together");
  std::vector<NumberedDot> dots;
  for (const Point& point : points) {
    dots.push_back({point.variant + 1, x.at(point.ms), y.at(point.figure)});
    svg.dot(x.at(point.ms), y.at(point.figure), 4, "fill=\"#0072b2\"",
            variant_text(results.prepared->study, variants[point.variant]) + ": " +
                fixed_text(point.figure, 3) + ", " + fixed_text(point.ms, 2) + " ms");
  }
  add_numbers(svg, dots);
  return "<figure>" + svg.str(title + " against time") + "</figure>";
}

}  // namespace plaza
