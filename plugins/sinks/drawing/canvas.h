#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "plaza/geometry/box.h"
#include "plugins/sinks/drawing/palette.h"

/// Antialiased drawing into 8-bit BGR images. Coordinates are pixels with centres at integers and
/// may lie anywhere: what is outside of the image is cut off before it can overflow OpenCV's fixed
/// point.
namespace plaza::drawing {

using Point = cv::Point2d;
using Path = std::vector<Point>;

struct Stroke {
  Color color;
  int width_px = 1;
  double dash_px = 0;  ///< 0: solid; else length of the dashes and of the gaps between them
};

void draw_path(cv::Mat& image, std::span<const Point> path, bool closed, const Stroke& stroke);
/// The same with a dark seam on both sides, so that it stands out from any image.
void draw_seamed_path(cv::Mat& image, std::span<const Point> path, bool closed,
                      const Stroke& stroke);

/// With a seam; its sides at whole pixels, where antialiasing does not blur them.
void draw_box(cv::Mat& image, const Box& box, const Stroke& stroke);

/// A convex polygon.
void fill_convex(cv::Mat& image, std::span<const Point> polygon, const Color& color);
void draw_disk(cv::Mat& image, Point centre, double radius_px, const Color& color);
void draw_ring(cv::Mat& image, Point centre, double radius_px, const Stroke& stroke);

/// `image` = `share` of `layer`, the rest `image`, in the pixels where they differ.
void blend(cv::Mat& image, const cv::Mat& layer, double share);

/// Where the given point is on the text's box.
enum class Anchor { kTopLeft, kTopRight, kCentre, kBottomLeft, kBottomCentre, kTopCentre };

/// Text of capital letters `height_px` high.
struct TextStyle {
  double height_px = 11;
  Color color;
  Anchor anchor = Anchor::kTopLeft;
};

/// Size of a text's box: from the left to the right end, and from the capitals' top to the base
/// line.
cv::Size2d text_size(const std::string& text, double height_px);
void draw_text(cv::Mat& image, const std::string& text, Point at, const TextStyle& style);
/// Text on a filled plate of `color` in a readable ink, moved so that it is inside the image if it
/// fits.
void draw_plate(cv::Mat& image, const std::string& text, Point at, const TextStyle& style);

}  // namespace plaza::drawing
