#include "framework/scene/draw_canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plaza {
namespace canvas {
namespace {

constexpr int kShift = 4;  // sixteenths of a pixel

/// OpenCV's fixed point overflows far outside the image; what is there is cut off anyway.
cv::Point fixed(const Eigen::Vector2d& p) {
  const auto scaled = [](double v) {
    return static_cast<int>(std::lround(std::clamp(v, -2e4, 2e4) * (1 << kShift)));
  };
  return {scaled(p.x()), scaled(p.y())};
}

std::vector<cv::Point> fixed(const std::vector<Eigen::Vector2d>& points) {
  std::vector<cv::Point> out;
  for (const Eigen::Vector2d& p : points) out.push_back(fixed(p));
  return out;
}

}  // namespace

cv::Scalar camera_colour(std::size_t i) {
  static const std::array<cv::Scalar, 8> kColours{
      cv::Scalar(180, 119, 31),  cv::Scalar(40, 39, 214),  cv::Scalar(44, 140, 44),
      cv::Scalar(189, 103, 148), cv::Scalar(14, 127, 255), cv::Scalar(75, 86, 140),
      cv::Scalar(190, 170, 23),  cv::Scalar(160, 60, 200)};
  return kColours[i % kColours.size()];
}

void line(cv::Mat& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
          const cv::Scalar& colour, int thickness) {
  cv::line(image, fixed(a), fixed(b), colour, thickness, cv::LINE_AA, kShift);
}

void polyline(cv::Mat& image, const std::vector<Eigen::Vector2d>& points, bool closed,
              const cv::Scalar& colour, int thickness) {
  cv::polylines(image, std::vector{fixed(points)}, closed, colour, thickness, cv::LINE_AA, kShift);
}

void fill(cv::Mat& image, const std::vector<Eigen::Vector2d>& points, const cv::Scalar& colour,
          double opacity) {
  cv::Mat layer = image.clone();
  cv::fillPoly(layer, std::vector{fixed(points)}, colour, cv::LINE_AA, kShift);
  cv::addWeighted(layer, opacity, image, 1 - opacity, 0, image);
}

void text(cv::Mat& image, const std::string& words, const Eigen::Vector2d& at,
          const cv::Scalar& colour, double size) {
  if (!(at.array().abs() < 1e5).all()) return;
  const cv::Point p(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())));
  cv::putText(image, words, p, cv::FONT_HERSHEY_SIMPLEX, size, kPaper, 4, cv::LINE_AA);
  cv::putText(image, words, p, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

void centred_text(cv::Mat& image, const std::string& words, const Eigen::Vector2d& at,
                  const cv::Scalar& colour, double size) {
  int baseline = 0;
  const cv::Size box = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, size, 1, &baseline);
  text(image, words, at + Eigen::Vector2d(-box.width / 2.0, box.height / 2.0), colour, size);
}

}  // namespace canvas

double grid_step_m(const Eigen::Vector2d& size_m) {
  double step = 1;
  while (size_m.maxCoeff() / step > 40) {
    const double leading = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
    step *= leading < 1.5 ? 2 : leading < 3 ? 2.5 : 2;
  }
  return step;
}

}  // namespace plaza
