#include "plugins/sinks/occluder-map/sight_counts.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plaza::occluder_map {
namespace {

// of a silhouette: what is left out at either end of each row, and of its height at head and feet
constexpr double kSides = 0.2, kEnds = 0.1;
constexpr double kTolerance_px = 1.0;  ///< of polygons

}  // namespace

SightCounts::SightCounts(cv::Size image)
    : covered_(cv::Mat::zeros(image, CV_32S)), seen_(cv::Mat::zeros(image, CV_32S)) {}

void SightCounts::add(const Silhouette& silhouette, const cv::Mat& foreground) {
  CV_Assert(foreground.size() == covered_.size() && foreground.type() == CV_8UC1);
  const double top = silhouette.box.top + kEnds * silhouette.box.height;
  const double bottom = silhouette.box.bottom() - kEnds * silhouette.box.height;
  for (const RowSpan& span : silhouette.spans) {
    if (span.row < top || span.row > bottom) continue;
    const int side = static_cast<int>(std::lround(kSides * (span.end - span.begin)));
    auto* const covered = covered_.ptr<int>(span.row);
    auto* const seen = seen_.ptr<int>(span.row);
    const auto* const mask = foreground.ptr<uchar>(span.row);
    for (int x = span.begin + side; x < span.end - side; ++x) {
      ++covered[x];
      seen[x] += mask[x] != 0 ? 1 : 0;
    }
  }
}

cv::Mat SightCounts::share_seen(int least_covered) const {
  cv::Mat share(covered_.size(), CV_32F, cv::Scalar(-1));
  for (int y = 0; y < share.rows; ++y) {
    for (int x = 0; x < share.cols; ++x) {
      const int covered = covered_.at<int>(y, x);
      if (covered < std::max(least_covered, 1)) continue;
      share.at<float>(y, x) = static_cast<float>(seen_.at<int>(y, x)) / static_cast<float>(covered);
    }
  }
  return share;
}

std::vector<Polygon> SightCounts::occluders(const Criterion& criterion) const {
  const cv::Mat share = share_seen(criterion.least_covered);
  cv::Mat hidden;
  cv::inRange(share, 0, criterion.most_seen, hidden);
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  cv::morphologyEx(hidden, hidden, cv::MORPH_OPEN, kernel);
  cv::Mat closed;
  const int bridge = criterion.bridge_px + 1;
  cv::morphologyEx(hidden, closed, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, {bridge, bridge}));
  hidden |= closed & (share < 0);
  std::vector<Polygon> contours, found;
  cv::findContours(hidden, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  for (const Polygon& contour : contours) {
    Polygon polygon;
    cv::approxPolyDP(contour, polygon, kTolerance_px, true);
    if (polygon.size() < 3 || cv::contourArea(polygon) < criterion.least_area_px) continue;
    found.push_back(std::move(polygon));
  }
  std::stable_sort(found.begin(), found.end(), [](const Polygon& a, const Polygon& b) {
    return cv::contourArea(a) > cv::contourArea(b);
  });
  return found;
}

}  // namespace plaza::occluder_map
