#pragma once

#include <string>
#include <vector>

namespace plaza {

/// Text as it stands in HTML and SVG.
std::string escaped(const std::string& text);

/// Round numbers that cover [low, high]: about `count` of them, the first at most `low`, the last
/// at least `high`. Equal bounds are widened.
std::vector<double> nice_ticks(double low, double high, int count);

/// A tick's number with as many decimals as `step` needs.
std::string tick_text(double value, double step);

/// The colour of the index-th series; eight that people with any colour vision tell apart (Okabe
/// and Ito).
std::string series_color(std::size_t index);

/// One direction of a plot: from values to pixels.
struct Scale {
  double low = 0, high = 1;   ///< values
  double begin = 0, end = 1;  ///< pixels

  double at(double value) const { return begin + (value - low) / (high - low) * (end - begin); }
};

/// Collects the elements of one inline SVG picture. Coordinates are pixels of its view box.
class Svg {
 public:
  Svg(int width, int height) : width_(width), height_(height) {}

  void line(double x1, double y1, double x2, double y2, const std::string& style);
  void path(const std::vector<std::pair<double, double>>& points, const std::string& style);
  /// A dot that tells `title` when one points at it.
  void dot(double x, double y, double radius, const std::string& style, const std::string& title);
  void rectangle(double x, double y, double width, double height, const std::string& style);
  /// `anchor`: start, middle or end.
  void text(double x, double y, const std::string& anchor, const std::string& text,
            const std::string& style = "");
  /// Text that is read from below, for the name of a vertical axis.
  void vertical_text(double x, double y, const std::string& text);

  /// The picture; `title` is for those who can't see it.
  std::string str(const std::string& title) const;

 private:
  int width_, height_;
  std::string elements_;
};

}  // namespace plaza
