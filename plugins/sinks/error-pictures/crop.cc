#include "plugins/sinks/error-pictures/crop.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace plaza::error_pictures {
namespace {

constexpr double kRoom = 1.9;           // height of the crop over that of its focus
constexpr double kLeastHeight_px = 60;  // nobody recognises less

const drawing::Color kOccluder(200, 180, 60);

}  // namespace

Box around(const Box& a, const Box& b) {
  const double left = std::min(a.left, b.left), top = std::min(a.top, b.top);
  return {left, top, std::max(a.right(), b.right()) - left, std::max(a.bottom(), b.bottom()) - top};
}

cv::Mat crop_around(const cv::Mat& image, const Box& focus, std::span<const DrawnBox> boxes,
                    std::span<const std::vector<Eigen::Vector2d>> polygons, cv::Size size) {
  const double aspect = static_cast<double>(size.width) / size.height;
  const double height =
      std::max({kRoom * focus.height, kRoom * focus.width / aspect, kLeastHeight_px});
  const double scale = size.height / height;
  const drawing::Point centre(focus.left + focus.width / 2, focus.top + focus.height / 2);
  const drawing::Point shift(size.width / 2.0 - scale * centre.x,
                             size.height / 2.0 - scale * centre.y);
  const drawing::Theme& theme = drawing::dark_theme();
  cv::Mat crop(size, CV_8UC3, theme.floor);
  if (!image.empty()) {
    const cv::Matx23d map(scale, 0, shift.x, 0, scale, shift.y);
    cv::warpAffine(image, crop, map, size, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR,
                   cv::BORDER_CONSTANT, theme.floor);
  }
  for (const auto& polygon : polygons) {
    drawing::Path path;
    for (const Eigen::Vector2d& p : polygon) {
      path.emplace_back(scale * p.x() + shift.x, scale * p.y() + shift.y);
    }
    drawing::draw_seamed_path(crop, path, true, {kOccluder, 1});
  }
  for (const DrawnBox& drawn : boxes) {
    const Box& b = drawn.box;
    drawing::draw_box(
        crop,
        {scale * b.left + shift.x, scale * b.top + shift.y, scale * b.width, scale * b.height},
        drawn.stroke);
  }
  return crop;
}

}  // namespace plaza::error_pictures
