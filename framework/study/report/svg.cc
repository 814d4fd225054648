#include "framework/study/report/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "framework/results/number_text.h"

namespace plaza {
namespace {

std::string px(double value) { return fixed_text(value, 1); }

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::vector<double> nice_ticks(double low, double high, int count) {
  if (!(high > low)) {
    const double around = std::max(std::abs(low) * 0.1, 1e-3);
    high = low + around;
    low -= around;
  }
  const double raw = (high - low) / count;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double candidate : {1.0, 2.0, 2.5, 5.0}) {
    if (candidate * power >= raw * (1 - 1e-9)) {
      step = candidate * power;
      break;
    }
  }
  const auto first = static_cast<std::int64_t>(std::floor(low / step + 1e-9));
  const auto last = static_cast<std::int64_t>(std::ceil(high / step - 1e-9));
  std::vector<double> ticks;
  for (std::int64_t i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

std::string tick_text(double value, double step) {
  int decimals = 0;
  while (decimals < 6 && std::abs(step - std::round(step * std::pow(10, decimals)) /
                                             std::pow(10, decimals)) > 1e-9 * step) {
    ++decimals;
  }
  return fixed_text(value, decimals);
}

std::string series_color(std::size_t index) {
  static const std::array<const char*, 8> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#e69f00", "#56b4e9", "#7f7f7f", "#000000"};
  return kColors.at(index % kColors.size());
}

void Svg::line(double x1, double y1, double x2, double y2, const std::string& style) {
  std::ostringstream out;
  out << "<line x1=\"" << px(x1) << "\" y1=\"" << px(y1) << "\" x2=\"" << px(x2) << "\" y2=\""
      << px(y2) << "\" " << style << "/>";
  elements_ += out.str();
}

void Svg::path(const std::vector<std::pair<double, double>>& points, const std::string& style) {
  std::ostringstream out;
  out << "<polyline fill=\"none\" points=\"";
  for (const auto& [x, y] : points) out << px(x) << ',' << px(y) << ' ';
  out << "\" " << style << "/>";
  elements_ += out.str();
}

void Svg::dot(double x, double y, double radius, const std::string& style,
              const std::string& title) {
  std::ostringstream out;
  out << "<circle cx=\"" << px(x) << "\" cy=\"" << px(y) << "\" r=\"" << px(radius) << "\" "
      << style << "><title>" << escaped(title) << "</title></circle>";
  elements_ += out.str();
}

void Svg::rectangle(double x, double y, double width, double height, const std::string& style) {
  std::ostringstream out;
  out << "<rect x=\"" << px(x) << "\" y=\"" << px(y) << "\" width=\"" << px(width) << "\" height=\""
      << px(height) << "\" " << style << "/>";
  elements_ += out.str();
}

void Svg::text(double x, double y, const std::string& anchor, const std::string& text,
               const std::string& style) {
  std::ostringstream out;
  out << "<text x=\"" << px(x) << "\" y=\"" << px(y) << "\" text-anchor=\"" << anchor << "\" "
      << style << '>' << escaped(text) << "</text>";
  elements_ += out.str();
}

void Svg::vertical_text(double x, double y, const std::string& text) {
  std::ostringstream out;
  out << "<text transform=\"translate(" << px(x) << ' ' << px(y)
      << ") rotate(-90)\" text-anchor=\"middle\">" << escaped(text) << "</text>";
  elements_ += out.str();
}

std::string Svg::str(const std::string& title) const {
  std::ostringstream out;
  out << "<svg role=\"img\" viewBox=\"0 0 " << width_ << ' ' << height_ << "\" width=\"" << width_
      << "\" height=\"" << height_ << "\"><title>" << escaped(title) << "</title>" << elements_
      << "</svg>";
  return out.str();
}

}  // namespace plaza
