#include "modalities/edges/plain_transform.h"

#include <algorithm>
#include <vector>

namespace plaza::edges {
namespace {

/// The lines of a direction over an image: a pixel is step `major` of line `line`.
class Lines {
 public:
  Lines(const Direction& direction, cv::Size size)
      : steep_(direction.steep),
        length_(steep_ ? size.height : size.width),
        across_(steep_ ? size.width : size.height) {
    for (int major = 0; major < length_; ++major) shift_.push_back(direction.shift(major));
  }
  int length() const { return length_; }
  /// Lines [first, end) cross the image, some of them starting outside of it.
  int first() const { return std::min(0, -shift_.back()); }
  int end() const { return across_ + std::max(0, -shift_.back()); }

  bool inside(int major, int line) const {
    if (major < 0 || major >= length_) return false;
    const int minor = minor_of(major, line);
    return minor >= 0 && minor < across_;
  }
  /// Of a step inside the image.
  cv::Point pixel(int major, int line) const {
    const int minor = minor_of(major, line);
    return steep_ ? cv::Point(minor, major) : cv::Point(major, minor);
  }
  int major_of(const cv::Point& p) const { return steep_ ? p.y : p.x; }
  int line_of(const cv::Point& p) const {
    return (steep_ ? p.x : p.y) - shift_[static_cast<std::size_t>(major_of(p))];
  }

 private:
  int minor_of(int major, int line) const { return line + shift_[static_cast<std::size_t>(major)]; }

  bool steep_;
  int length_, across_;
  std::vector<int> shift_;
};

/// One exploring unit: a line iterator with its distance counter.
struct Explorer {
  int major, line;
  int step;  ///< -1 or 1
  int count;
};

}  // namespace

cv::Mat1b transform_by_scanning(const cv::Mat1b& edges, const Direction& direction) {
  cv::Mat1b out(edges.size(), kNoEdge);
  const Lines lines(direction, edges.size());
  std::vector<int> found;
  for (int line = lines.first(); line < lines.end(); ++line) {
    found.clear();
    for (int major = 0; major < lines.length(); ++major) {
      if (lines.inside(major, line) && edges(lines.pixel(major, line)) != 0) found.push_back(major);
    }
    if (found.empty()) continue;
    std::size_t nearest = 0;
    for (int major = 0; major < lines.length(); ++major) {
      if (!lines.inside(major, line)) continue;
      while (nearest + 1 < found.size() &&
             std::abs(found[nearest + 1] - major) <= std::abs(found[nearest] - major)) {
        ++nearest;
      }
      const int steps = std::abs(found[nearest] - major);
      if (steps <= direction.gate) {
        out(lines.pixel(major, line)) = static_cast<unsigned char>(steps);
      }
    }
  }
  return out;
}

cv::Mat1b transform_by_exploring(const cv::Mat1b& edges, const Direction& direction) {
  cv::Mat1b out(edges.size(), kNoEdge);
  const Lines lines(direction, edges.size());
  std::vector<Explorer> explorers;
  for (int y = 0; y < edges.rows; ++y) {
    for (int x = 0; x < edges.cols; ++x) {
      if (edges(y, x) == 0) continue;
      out(y, x) = 0;
      for (const int step : {-1, 1}) {
        explorers.push_back({lines.major_of({x, y}), lines.line_of({x, y}), step, 0});
      }
    }
  }
  // the units' circular list: one round moves every unit by one pixel and drops those that stop
  while (!explorers.empty()) {
    std::size_t going = 0;
    for (Explorer unit : explorers) {
      unit.major += unit.step;
      ++unit.count;
      if (unit.count > direction.gate || !lines.inside(unit.major, unit.line)) continue;
      unsigned char& distance = out(lines.pixel(unit.major, unit.line));
      if (distance <= unit.count) continue;
      distance = static_cast<unsigned char>(unit.count);
      explorers[going++] = unit;
    }
    explorers.resize(going);
  }
  return out;
}

}  // namespace plaza::edges
