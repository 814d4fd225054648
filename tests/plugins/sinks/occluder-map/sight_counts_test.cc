#include "plugins/sinks/occluder-map/sight_counts.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace plaza::occluder_map {
namespace {

const cv::Size kImage(200, 120);
const cv::Rect kPanel(90, 40, 24, 30);

Silhouette upright(int left, int top, int width = 30, int height = 60) {
  Silhouette s;
  s.box = {static_cast<double>(left), static_cast<double>(top), static_cast<double>(width),
           static_cast<double>(height)};
  for (int y = top; y < top + height; ++y) s.spans.push_back({y, left, left + width});
  return s;
}

cv::Mat seen(const Silhouette& silhouette, bool board) {
  cv::Mat mask(kImage, CV_8UC1, cv::Scalar(0));
  for (const RowSpan& s : silhouette.spans) {
    mask(cv::Rect(s.begin, s.row, s.end - s.begin, 1)).setTo(cv::Scalar(255));
  }
  if (board) mask(kPanel).setTo(cv::Scalar(0));
  return mask;
}

/// People who walk past behind the board, seen as they are.
SightCounts walked(bool board, int step = 2) {
  SightCounts counts(kImage);
  for (int left = 10; left < 160; left += step) {
    const Silhouette person = upright(left, 30);
    counts.add(person, seen(person, board));
  }
  return counts;
}

TEST(SightCounts, FindsWhatPeopleWalkBehind) {
  const auto found = walked(true).occluders({.least_covered = 4, .least_area_px = 50});
  ASSERT_EQ(found.size(), 1U);
  const cv::Rect box = cv::boundingRect(found[0]);
  EXPECT_NEAR(box.x, kPanel.x, 1);
  EXPECT_NEAR(box.y, kPanel.y, 1);
  EXPECT_NEAR(box.width, kPanel.width, 2);
  EXPECT_NEAR(box.height, kPanel.height, 2);
}

TEST(SightCounts, FindsNothingWhereEverybodyIsSeen) {
  EXPECT_TRUE(walked(false).occluders({.least_covered = 4}).empty());
}

TEST(SightCounts, KnowsNothingWhereFewHaveBeen) {
  const SightCounts counts = walked(true);
  EXPECT_TRUE(counts.occluders({.least_covered = 1000}).empty());
  EXPECT_EQ(counts.share_seen(1).at<float>(5, 5), -1);
  EXPECT_EQ(counts.share_seen(1).at<float>(60, 60), 1);
  EXPECT_EQ(counts.share_seen(1).at<float>(60, 100), 0);
}

TEST(SightCounts, LeavesSmallRegionsOut) {
  EXPECT_TRUE(walked(true).occluders({.least_covered = 4, .least_area_px = 1000}).empty());
}

TEST(SightCounts, BridgesWhatNobodyCovered) {
  // two places only, so that a strip of the board is covered by nobody
  SightCounts counts(kImage);
  for (const int left : {70, 96}) {
    const Silhouette person = upright(left, 30);
    for (int i = 0; i < 5; ++i) counts.add(person, seen(person, true));
  }
  SightCounts::Criterion criterion{.least_covered = 4, .bridge_px = 0, .least_area_px = 20};
  EXPECT_EQ(counts.occluders(criterion).size(), 2U);
  criterion.bridge_px = 12;
  EXPECT_EQ(counts.occluders(criterion).size(), 1U);
}

TEST(SightCounts, NeverFillsWherePeopleWereSeen) {
  // a slit in the board through which everybody is seen
  SightCounts counts(kImage);
  for (int left = 10; left < 160; ++left) {
    const Silhouette person = upright(left, 30);
    cv::Mat mask = seen(person, true);
    seen(person, false)(cv::Rect(100, 40, 4, 30)).copyTo(mask(cv::Rect(100, 40, 4, 30)));
    counts.add(person, mask);
  }
  for (const Polygon& polygon : counts.occluders({.least_covered = 4, .bridge_px = 20})) {
    EXPECT_LT(cv::pointPolygonTest(polygon, cv::Point2f(101, 55), false), 0);
  }
}

}  // namespace
}  // namespace plaza::occluder_map
