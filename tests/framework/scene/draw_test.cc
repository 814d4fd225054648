#include "framework/scene/draw.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "framework/scene/draw_canvas.h"
#include "framework/scene/scene_file.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

std::shared_ptr<const Scene> make_scene() {
  return parse_scene(parse_json(
      R"({"plaza_scene": 1, "name": "Yard", "frame_rate_hz": 25,
      "area": {"x_m": [-3, 3], "y_m": [-2, 2]},
      "cameras": [{"name": "left", "image_size": [320, 240], "calibration":
        {"format": "pinhole", "fx_px": 250, "fy_px": 250, "cx_px": 160, "cy_px": 120,
         "centre_m": [-8, 0, 3], "look_at_m": [0, 0, 1]}}],
      "occluders": [{"camera": "left", "name": "pillar", "polygon_px": [[10, 150], [30, 150], [30, 200]]}]})",
      "scene.json"));
}

/// Whether a pixel within 3 px has about this colour.
bool has_colour(const cv::Mat& image, const Eigen::Vector2d& at, const cv::Scalar& colour) {
  for (int dy = -3; dy <= 3; ++dy) {
    for (int dx = -3; dx <= 3; ++dx) {
      const int x = static_cast<int>(at.x()) + dx, y = static_cast<int>(at.y()) + dy;
      if (x < 0 || y < 0 || x >= image.cols || y >= image.rows) continue;
      const auto p = image.at<cv::Vec3b>(y, x);
      if (std::abs(p[0] - colour[0]) + std::abs(p[1] - colour[1]) + std::abs(p[2] - colour[2]) <
          60) {
        return true;
      }
    }
  }
  return false;
}

TEST(DrawTest, TheBorderIsWhereTheCameraSeesIt) {
  const auto scene = make_scene();
  const cv::Mat image = draw_scene_view(*scene, 0);
  const Camera large = scene->cameras[0].scaled({image.cols, image.rows});
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(-3, 0.3, 0), Eigen::Vector3d(3, -0.6, 0), Eigen::Vector3d(0.4, 2, 0)}) {
    EXPECT_TRUE(has_colour(image, *large.project(p), canvas::kArea)) << p.transpose();
  }
  EXPECT_FALSE(has_colour(image, {image.cols - 20.0, image.rows - 20.0}, canvas::kArea));
  // the occluder, enlarged with the image
  EXPECT_TRUE(has_colour(image, {30.5 * image.cols / 320 - 0.5, 175.0 * image.rows / 240},
                         canvas::kOccluder));
}

TEST(DrawTest, WritesOnePictureAViewAndAPlan) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "plaza-draw" / "nested";
  const auto files = draw_scene_grid(*make_scene(), folder);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].filename(), "left.png");
  EXPECT_EQ(files[1].filename(), "plan.png");
  for (const auto& file : files) EXPECT_FALSE(cv::imread(file.string()).empty()) << file;
  std::filesystem::remove_all(folder.parent_path());
}

TEST(DrawTest, DrawsOntoABackgroundOfTheCamerasSizeOnly) {
  const auto scene = make_scene();
  const cv::Mat black(240, 320, CV_8UC3, cv::Scalar::all(0));
  const cv::Mat image = draw_scene_view(*scene, 0, {{"left", black}});
  EXPECT_EQ(image.at<cv::Vec3b>(image.rows - 5, image.cols - 5), cv::Vec3b(0, 0, 0));
  EXPECT_THROW(draw_scene_view(*scene, 0, {{"left", black.rowRange(0, 200)}}), UserError);
}

TEST(DrawTest, AFolderThatCannotBeMadeIsTheUsersError) {
  EXPECT_THROW(draw_scene_grid(*make_scene(), "/proc/nothing/here"), UserError);
}

TEST(DrawTest, TheGridIsCoarserOnLargeAreas) {
  EXPECT_EQ(grid_step_m({6, 4}), 1);
  EXPECT_EQ(grid_step_m({19, 16}), 1);
  EXPECT_EQ(grid_step_m({60, 4}), 2);
  EXPECT_EQ(grid_step_m({10, 150}), 5);
  EXPECT_EQ(grid_step_m({399, 4}), 10);
  EXPECT_EQ(grid_step_m({700, 4}), 20);
}

}  // namespace
}  // namespace plaza
