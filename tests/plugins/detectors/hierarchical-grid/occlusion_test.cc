#include "plugins/detectors/hierarchical-grid/occlusion.h"

#include <gtest/gtest.h>

namespace plaza {
namespace {

/// A square of 10 x 10 pixels at (20, 30), half of it inside the image.
Silhouette square() {
  Silhouette s;
  for (int y = 30; y < 40; ++y) s.spans.push_back({y, 20, 30});
  for (int i = 0; i < 10; ++i) {
    s.contour.push_back({{20.0F, 30.0F + static_cast<float>(i)}, {-1, 0}});
    s.contour.push_back({{29.0F, 30.0F + static_cast<float>(i)}, {1, 0}});
  }
  s.box = {20, 30, 9, 9};
  s.inside_share = 0.5;
  return s;
}

TEST(WithoutHidden, LeavesOutWhatThePolygonCovers) {
  // columns 24.5 to 26.5, rows below 35: cuts spans in two
  const OccluderPolygon bar = {{24.5, 20}, {26.5, 20}, {26.5, 34.5}, {24.5, 34.5}};
  const Silhouette s = without_hidden(square(), {&bar, 1});
  ASSERT_EQ(s.spans.size(), 15U);
  EXPECT_EQ(s.spans[0], (RowSpan{30, 20, 25}));
  EXPECT_EQ(s.spans[1], (RowSpan{30, 27, 30}));
  EXPECT_EQ(s.spans[14], (RowSpan{39, 20, 30}));
  EXPECT_EQ(s.contour.size(), 20U) << "no contour point is behind the bar";
  EXPECT_DOUBLE_EQ(s.inside_share, 0.5 * 0.9);
  EXPECT_EQ(s.box, square().box);
}

TEST(WithoutHidden, ContourPointsGoToo) {
  const OccluderPolygon left = {{10, 10}, {24.5, 10}, {24.5, 60}, {10, 60}};
  const Silhouette s = without_hidden(square(), {&left, 1});
  EXPECT_EQ(s.contour.size(), 10U);
  for (const ContourPoint& p : s.contour) EXPECT_EQ(p.pixel.x(), 29.0F);
  EXPECT_DOUBLE_EQ(s.inside_share, 0.25);
}

TEST(WithoutHidden, SeveralPolygonsAddUpAndNothingMayBeLeft) {
  const std::vector<OccluderPolygon> halves = {{{10, 10}, {24.5, 10}, {24.5, 60}, {10, 60}},
                                               {{24.5, 10}, {40, 10}, {40, 60}, {24.5, 60}}};
  const Silhouette s = without_hidden(square(), halves);
  EXPECT_TRUE(s.contour.empty());
  EXPECT_TRUE(s.spans.empty());
  EXPECT_EQ(s.inside_share, 0);
}

}  // namespace
}  // namespace plaza
