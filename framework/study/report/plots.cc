#include "framework/study/report/plots.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/results/number_text.h"
#include "framework/study/report/plot_frame.h"
#include "framework/study/report/statistics.h"

namespace plaza {
namespace {

using namespace plot;

constexpr std::size_t kMostSeries = 6;

/// Where the values of an axis stand: numbers to scale, words side by side.
std::vector<double> places_of(Svg& svg, const Axis& axis) {
  std::vector<double> places;
  const std::size_t count = axis.values.size();
  const double width = kWidth - kLeft - kRight;
  if (axis.numeric() && count > 1) {
    double low = *axis.values[0].number;
    double high = low;
    for (const AxisValue& value : axis.values) {
      low = std::min(low, *value.number);
      high = std::max(high, *value.number);
    }
    const double margin = 0.06 * width;
    const Scale scale{low, high, kLeft + margin, kWidth - kRight - margin};
    for (const AxisValue& value : axis.values) places.push_back(scale.at(*value.number));
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      places.push_back(kLeft + width * (static_cast<double>(i) + 0.5) / static_cast<double>(count));
    }
  }
  double last = -1e9;  // labels of near numbers would cover each other
  for (std::size_t i = 0; i < count; ++i) {
    const std::string label = fitted(axis.values[i].label, width / static_cast<double>(count));
    if (places[i] - last < 6.5 * static_cast<double>(label.size())) continue;
    last = places[i];
    svg.text(places[i], kHeight - kBottom + 16, "middle", label);
  }
  return places;
}

/// The axis that has lines of its own: one of the baseline's where there is a choice.
std::optional<std::size_t> series_axis(const Study& study, std::size_t axis) {
  std::optional<std::size_t> found;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const std::size_t count = study.axes[a].values.size();
    if (a == axis || count < 2 || count > kMostSeries) continue;
    const bool compared = study.baseline.values.contains(study.axes[a].name);
    if (!found || compared) found = a;
    if (compared) break;
  }
  return found;
}

/// Figures of all runs with this label on `axis` (and this one on `series`).
std::vector<double> figures_at(const StudyResults& results, std::size_t column, std::size_t axis,
                               const std::string& label, std::optional<std::size_t> series,
                               const std::string& series_label) {
  std::vector<double> figures;
  const Expansion& expansion = results.prepared->expansion;
  for (std::size_t j = 0; j < results.jobs.size(); ++j) {
    const Variant& variant = expansion.variants[expansion.jobs[j].variant];
    if (variant.labels[axis] != label) continue;
    if (series && variant.labels[*series] != series_label) continue;
    if (const auto& figure = results.jobs[j].figures[column]) figures.push_back(*figure);
  }
  return figures;
}

void draw_series(Svg& svg, const std::vector<double>& places,
                 const std::vector<std::vector<double>>& figures, const Scale& y, double shift,
                 const std::string& color, const std::vector<std::string>& titles, bool scaled) {
  const std::string stroke = "stroke=\"" + color + "\" stroke-width=\"2\"";
  std::vector<std::pair<double, double>> medians;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto spread = spread_of(figures[i]);
    if (!spread) continue;
    const double x = places[i] + shift;
    if (spread->count > 1) {
      svg.line(x, y.at(spread->low), x, y.at(spread->high), stroke + " stroke-opacity=\"0.55\"");
      for (const double figure : figures[i]) {
        svg.dot(x, y.at(figure), 1.8, "fill=\"" + color + "\" fill-opacity=\"0.45\"",
                fixed_text(figure, 3));
      }
    }
    medians.emplace_back(x, y.at(spread->median));
  }
  // between words there is nothing: their line only shows what belongs together
  svg.path(medians, scaled ? stroke : stroke + " stroke-dasharray=\"3 4\" stroke-opacity=\"0.7\"");
  for (std::size_t i = 0, m = 0; i < places.size(); ++i) {
    const auto spread = spread_of(figures[i]);
    if (!spread) continue;
    svg.dot(medians[m].first, medians[m].second, 4, "fill=\"" + color + "\"",
            titles[i] + ": " + fixed_text(spread->median, 3) +
                (spread->count > 1 ? " (median of " + std::to_string(spread->count) + ")" : ""));
    ++m;
  }
}

std::vector<double> all_figures(const StudyResults& results, std::size_t column) {
  std::vector<double> figures;
  for (const JobOutcome& job : results.jobs) {
    if (job.figures[column]) figures.push_back(*job.figures[column]);
  }
  return figures;
}

}  // namespace

std::string axis_plot(const StudyResults& results, std::size_t axis, std::size_t column) {
  const Study& study = results.prepared->study;
  const Axis& along = study.axes[axis];
  const std::string title = results.columns[column].title();
  Svg svg(kWidth, kHeight);
  const Scale y =
      vertical_axis(svg, all_figures(results, column), axis_title(results.columns[column]));
  const std::vector<double> places = places_of(svg, along);
  horizontal_line(svg, along.name);

  const auto series = series_axis(study, axis);
  std::vector<std::string> lines = {""};
  if (series) {
    lines.clear();
    for (const AxisValue& value : study.axes[*series].values) lines.push_back(value.label);
  }
  std::vector<std::string> titles;
  for (std::size_t s = 0; s < lines.size(); ++s) {
    std::vector<std::vector<double>> figures;
    titles.clear();
    for (const AxisValue& value : along.values) {
      figures.push_back(figures_at(results, column, axis, value.label, series, lines[s]));
      titles.push_back(along.name + "=" + value.label +
                       (series ? ", " + study.axes[*series].name + "=" + lines[s] : ""));
    }
    const double shift = 5 * (static_cast<double>(s) - 0.5 * static_cast<double>(lines.size() - 1));
    draw_series(svg, places, figures, y, shift, series_color(s), titles, along.numeric());
  }
  std::string legend;
  for (std::size_t s = 0; series && s < lines.size(); ++s) {
    legend += "<span class=\"key\"><i style=\"background:" + series_color(s) + "\"></i>" +
              escaped(study.axes[*series].name + "=" + lines[s]) + "</span>";
  }
  return "<figure>" + svg.str(title + " along " + along.name) +
         (legend.empty() ? "" : "<figcaption>" + legend + "</figcaption>") + "</figure>";
}

std::string difference_plot(const StudyResults& results, const std::vector<Comparison>& comparisons,
                            std::size_t column) {
  constexpr double kRow = 26, kWords = 180;
  std::vector<double> values = {0};
  std::size_t rows = 0;
  for (const Comparison& comparison : comparisons) {
    const auto& estimate = comparison.estimates[column];
    if (!estimate) continue;
    ++rows;
    values.insert(values.end(), {estimate->mean, estimate->low.value_or(estimate->mean),
                                 estimate->high.value_or(estimate->mean)});
    const std::vector<double>& runs = comparison.differences[column];
    values.insert(values.end(), runs.begin(), runs.end());
  }
  if (rows == 0) return {};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const std::vector<double> ticks = nice_ticks(*least, *most, 4);
  const double bottom = kTop + kRow * static_cast<double>(rows);
  const int width = 560;
  Svg svg(width, static_cast<int>(bottom) + 40);
  const Scale x{ticks.front(), ticks.back(), kWords, width - 20.0};
  for (const double tick : ticks) {
    svg.line(x.at(tick), kTop, x.at(tick), bottom, kGrid);
    svg.text(x.at(tick), bottom + 15, "middle", tick_text(tick, ticks[1] - ticks[0]));
  }
  svg.line(x.at(0), kTop, x.at(0), bottom, "class=\"zero\"");
  const Better better = results.columns[column].metric.better;
  double y = kTop + kRow / 2;
  for (const Comparison& comparison : comparisons) {
    const auto& estimate = comparison.estimates[column];
    if (!estimate) continue;
    const int sign = verdict(*estimate, better);
    const std::string color = sign > 0 ? "#009e73" : sign < 0 ? "#d55e00" : "#555555";
    if (estimate->low) {
      svg.line(x.at(*estimate->low), y, x.at(*estimate->high), y,
               "stroke=\"" + color + "\" stroke-width=\"3\" stroke-opacity=\"0.6\"");
    }
    for (const double difference : comparison.differences[column]) {
      svg.dot(x.at(difference), y, 1.8, "fill=\"" + color + "\" fill-opacity=\"0.35\"",
              fixed_text(difference, 3));
    }
    svg.dot(x.at(estimate->mean), y, 4.5, "fill=\"" + color + "\"",
            comparison.label + ": " + fixed_text(estimate->mean, 3));
    svg.text(kWords - 10, y + 4, "end", fitted(comparison.label, kWords - 10));
    y += kRow;
  }
  const std::string title = axis_title(results.columns[column]) + ", minus that of " +
                            baseline_text(results.prepared->study);
  svg.text((kWords + width - 20) / 2, bottom + 34, "middle", title);
  return "<figure>" + svg.str(title) + "</figure>";
}

}  // namespace plaza
