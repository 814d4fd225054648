#include "modalities/edges/plain_transform.h"

#include <algorithm>
#include <vector>

namespace plaza::edges {
namespace {

/// A pixel by its place on its line: step `major`, on the line number `line`.
cv::Point pixel_of(const Direction& d, int major, int line) {
  const int minor = line + d.shift(major);
  return d.steep ? cv::Point(minor, major) : cv::Point(major, minor);
}

int length_along(const Direction& d, cv::Size size) { return d.steep ? size.height : size.width; }
int length_across(const Direction& d, cv::Size size) { return d.steep ? size.width : size.height; }

/// One exploring unit: a line iterator with its distance counter.
struct Explorer {
  int major, line;
  int step;  ///< -1 or 1
  int count;
};

}  // namespace

cv::Mat1b transform_by_scanning(const cv::Mat1b& edges, const Direction& direction) {
  cv::Mat1b out(edges.size(), kNoEdge);
  const cv::Rect inside({}, edges.size());
  const int length = length_along(direction, edges.size());
  const int across = length_across(direction, edges.size());
  const int drift = direction.shift(length - 1);
  // lines that cross the image at all, the first ones of a rising slope from outside of it
  for (int line = std::min(0, -drift); line < across + std::max(0, -drift); ++line) {
    std::vector<int> found;
    for (int major = 0; major < length; ++major) {
      const cv::Point p = pixel_of(direction, major, line);
      if (inside.contains(p) && edges(p) != 0) found.push_back(major);
    }
    if (found.empty()) continue;
    std::size_t nearest = 0;
    for (int major = 0; major < length; ++major) {
      const cv::Point p = pixel_of(direction, major, line);
      if (!inside.contains(p)) continue;
      while (nearest + 1 < found.size() &&
             std::abs(found[nearest + 1] - major) <= std::abs(found[nearest] - major)) {
        ++nearest;
      }
      const int steps = std::abs(found[nearest] - major);
      if (steps <= direction.gate) out(p) = static_cast<unsigned char>(steps);
    }
  }
  return out;
}

cv::Mat1b transform_by_exploring(const cv::Mat1b& edges, const Direction& direction) {
  cv::Mat1b out(edges.size(), kNoEdge);
  const cv::Rect inside({}, edges.size());
  std::vector<Explorer> explorers;
  for (int y = 0; y < edges.rows; ++y) {
    for (int x = 0; x < edges.cols; ++x) {
      if (edges(y, x) == 0) continue;
      out(y, x) = 0;
      const int major = direction.steep ? y : x, minor = direction.steep ? x : y;
      for (const int step : {-1, 1}) {
        explorers.push_back({major, minor - direction.shift(major), step, 0});
      }
    }
  }
  // the units' circular list: one round moves every unit by one pixel and drops those that stop
  while (!explorers.empty()) {
    std::size_t going = 0;
    for (Explorer unit : explorers) {
      unit.major += unit.step;
      ++unit.count;
      const cv::Point p = pixel_of(direction, unit.major, unit.line);
      if (unit.count > direction.gate || !inside.contains(p) || out(p) <= unit.count) continue;
      out(p) = static_cast<unsigned char>(unit.count);
      explorers[going++] = unit;
    }
    explorers.resize(going);
  }
  return out;
}

}  // namespace plaza::edges
