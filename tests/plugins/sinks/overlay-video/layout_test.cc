#include "plugins/sinks/overlay-video/layout.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace plaza::overlay {
namespace {

std::vector<cv::Rect> parts_of(const Layout& layout) {
  std::vector<cv::Rect> parts = layout.views;
  parts.push_back(layout.plan);
  parts.push_back(layout.header);
  return parts;
}

void expect_sound(const Layout& layout, const std::string& what) {
  EXPECT_EQ(layout.canvas.width % 2, 0) << what;
  EXPECT_EQ(layout.canvas.height % 2, 0) << what;
  EXPECT_LE(layout.canvas.height, 0.76 * layout.canvas.width) << what;
  const auto parts = parts_of(layout);
  const cv::Rect canvas({0, 0}, layout.canvas);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_GT(parts[i].area(), 0) << what;
    EXPECT_EQ(parts[i] & canvas, parts[i]) << what << ": part " << i << " leaves the canvas";
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      EXPECT_EQ((parts[i] & parts[j]).area(), 0) << what << ": " << i << " overlaps " << j;
    }
  }
}

TEST(Layout, HoldsAnyNumberOfViewsAtAnyWidth) {
  for (const int width : {320, 641, 1280, 1920, 7680}) {
    for (std::size_t n = 1; n <= 12; ++n) {
      for (const double aspect : {0.1, 0.7, 1.2, 8.0}) {
        const Layout layout = make_layout(std::vector(n, cv::Size(640, 480)), aspect, width);
        ASSERT_EQ(layout.views.size(), n);
        EXPECT_EQ(layout.canvas.width, width - width % 2);
        expect_sound(layout, std::to_string(n) + " views at " + std::to_string(width));
      }
    }
  }
}

TEST(Layout, KeepsEveryViewsProportions) {
  const std::vector<cv::Size> sizes = {{768, 576}, {720, 576}, {1920, 1080}, {480, 640}};
  const Layout layout = make_layout(sizes, 1.2, 1280);
  expect_sound(layout, "mixed");
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const cv::Rect& r = layout.views[i];
    const double aspect = static_cast<double>(sizes[i].width) / sizes[i].height;
    EXPECT_NEAR(static_cast<double>(r.width) / r.height, aspect, 0.02 * aspect) << i;
  }
}

TEST(Layout, FillsItsCanvas) {
  for (std::size_t n = 1; n <= 8; ++n) {
    const Layout layout = make_layout(std::vector(n, cv::Size(768, 576)), 1.2, 1280);
    int used = 0;
    for (const cv::Rect& part : parts_of(layout)) used += part.area();
    EXPECT_GT(used, 0.75 * layout.canvas.area()) << n;
    for (const cv::Rect& view : layout.views) {
      EXPECT_GT(view.width, 1280 / 6) << n << " views: too small to see anything in";
    }
  }
}

TEST(Layout, ReadsFromLeftToRight) {
  const Layout layout = make_layout(std::vector(4, cv::Size(640, 480)), 1, 1280);
  EXPECT_LT(layout.views[0].x, layout.views[1].x);
  EXPECT_EQ(layout.views[0].y, layout.views[1].y);
  EXPECT_LT(layout.views[0].y, layout.views[2].y);
  for (const cv::Rect& view : layout.views) EXPECT_LE(view.br().x, layout.plan.x);
}

TEST(Layout, NeedsAView) { EXPECT_THROW(make_layout({}, 1, 1280), std::invalid_argument); }

}  // namespace
}  // namespace plaza::overlay
