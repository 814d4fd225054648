#include "modalities/common/shrink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace plaza {
namespace {

using ::testing::HasSubstr;

/// 3 m above the ground, looking along +y and down.
std::shared_ptr<const Scene> scene_of(Eigen::Vector2i size) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  CameraFromWorld pose;
  pose.rotation << 1, 0, 0, 0, -s, -c, 0, c, -s;  // rows: right, down, ahead
  pose.translation = -pose.rotation * Eigen::Vector3d(0, 0, 3);
  auto scene = std::make_shared<Scene>();
  scene->cameras.push_back(Camera::pinhole(
      "one", size,
      {.fx_px = 500, .fy_px = 500, .cx_px = 320, .cy_px = 240, .distortion = {.k1 = -0.1}}, pose));
  scene->occluders.push_back({"one", "post", {{-0.5, -0.5}, {9.5, -0.5}, {9.5, 19.5}}});
  return scene;
}

Silhouette person_at(const Eigen::Vector2d& position_m, const Camera& camera) {
  const Prism body[] = {cylinder_prism(position_m, 0.25, 0, 1.75, camera)};
  return silhouette_of(body, camera);
}

double area(const Silhouette& s) {
  return std::accumulate(s.spans.begin(), s.spans.end(), 0.0,
                         [](double sum, const RowSpan& r) { return sum + (r.end - r.begin); });
}

TEST(ShrinkTest, OnceLeavesEverythingAsItIs) {
  const Shrink once(1);
  const auto scene = scene_of({641, 479});
  EXPECT_TRUE(once.fits(*scene));
  EXPECT_EQ(once(scene), scene);
  const cv::Mat image(7, 5, CV_8UC3);
  EXPECT_EQ(once(image).data, image.data);
  const Silhouette s = person_at({0.2, 6}, scene->cameras[0]);
  EXPECT_EQ(once(s).spans, s.spans);
  EXPECT_EQ(once(s).contour.size(), s.contour.size());
}

TEST(ShrinkTest, ImagesMustBeWholeNumbersOfBlocks) {
  EXPECT_TRUE(Shrink(4).fits(*scene_of({640, 480})));
  EXPECT_FALSE(Shrink(2).fits(*scene_of({640, 479})));
  Diagnostics faults;
  Shrink(2).check(*scene_of({640, 479}), faults);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].pointer, "/shrink");
  EXPECT_THAT(faults[0].message, HasSubstr("'one' are 640x479"));
  EXPECT_THROW(Shrink(0), std::invalid_argument);
  EXPECT_THROW(Shrink(9), std::invalid_argument);
}

TEST(ShrinkTest, PixelsAreMeansOfTheirBlocks) {
  const cv::Mat1b image = (cv::Mat1b(2, 4) << 10, 20, 0, 0, 30, 40, 0, 200);
  const cv::Mat1b small = Shrink(2)(image);
  ASSERT_EQ(small.size(), cv::Size(2, 1));
  EXPECT_EQ(small(0, 0), 25);
  EXPECT_EQ(small(0, 1), 50);
  const cv::Mat1b back = Shrink(2).back(small);
  ASSERT_EQ(back.size(), image.size());
  EXPECT_EQ(back(1, 1), 25);
  EXPECT_EQ(back(0, 2), 50);
}

class ShrunkBodyTest : public ::testing::TestWithParam<int> {};

/// What is projected and then shrunk is what the smaller image's camera sees.
TEST_P(ShrunkBodyTest, IsTheSmallerCamerasOwn) {
  const int times = GetParam();
  const auto scene = scene_of({640, 480});
  const auto small = Shrink(times)(scene);
  ASSERT_EQ(small->cameras[0].width(), 640 / times);
  for (const double x : {-3.0, 0.0, 1.7}) {  // the first is cut by the image's border
    const Silhouette shrunk = Shrink(times)(person_at({x, 6}, scene->cameras[0]));
    const Silhouette own = person_at({x, 6}, small->cameras[0]);
    ASSERT_FALSE(own.spans.empty());
    // a quarter of a pixel along the outline
    EXPECT_NEAR(area(shrunk), area(own), 0.25 * static_cast<double>(own.contour.size()));
    EXPECT_NEAR(shrunk.box.left, own.box.left, 0.05);
    EXPECT_NEAR(shrunk.box.bottom(), own.box.bottom(), 0.05);
    EXPECT_NEAR(shrunk.inside_share, own.inside_share, 0.03);
    EXPECT_NEAR(static_cast<double>(shrunk.contour.size()), static_cast<double>(own.contour.size()),
                0.05 * static_cast<double>(own.contour.size()) + 2);
    for (const ContourPoint& p : shrunk.contour) {
      double nearest = 1e9;
      for (const ContourPoint& q : own.contour) {
        nearest = std::min(nearest, static_cast<double>((p.pixel - q.pixel).norm()));
      }
      EXPECT_LT(nearest, 0.75);
    }
    for (std::size_t i = 1; i < shrunk.spans.size(); ++i) {
      const RowSpan &a = shrunk.spans[i - 1], &b = shrunk.spans[i];
      EXPECT_TRUE(a.row < b.row || (a.row == b.row && a.end < b.begin));
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Times, ShrunkBodyTest, ::testing::Values(2, 4, 5, 8));

TEST(ShrinkTest, OccludersShrinkWithTheImage) {
  const auto small = Shrink(4)(scene_of({640, 480}));
  const std::vector<Eigen::Vector2d>& p = small->occluders[0].polygon_px;
  EXPECT_NEAR(p[0].x(), -0.5, 1e-12);
  EXPECT_NEAR(p[1].x(), 2.0, 1e-12);
  EXPECT_NEAR(p[2].y(), 4.5, 1e-12);
}

}  // namespace
}  // namespace plaza
