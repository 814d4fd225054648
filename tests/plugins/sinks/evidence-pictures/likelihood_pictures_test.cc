#include "plugins/sinks/evidence-pictures/likelihood_pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::evidence_pictures {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

GroundGrid grid_of(int columns, int rows) {
  GroundGrid grid;
  grid.origin_m = {-4, -3};
  grid.step_m = {0.5, 0.5};
  grid.columns = columns;
  grid.rows = rows;
  return grid;
}

/// Nothing anywhere but at one cell.
std::vector<double> peak(const GroundGrid& grid, int column, int row) {
  std::vector<double> shares(static_cast<std::size_t>(grid.columns * grid.rows), 0.0);
  shares[static_cast<std::size_t>(row * grid.columns + column)] = 1;
  return shares;
}

bool is_color(const cv::Mat& image, const cv::Point& at, const cv::Scalar& color, double within) {
  const auto c = image.at<cv::Vec3b>(at);
  double worst = 0;
  for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(c[i] - color[i]));
  return worst <= within;
}

TEST(RelativeLikelihood, IsOneAtTheBestCellAndUnknownWhereItWas) {
  const std::vector<double> shares =
      relative_likelihood(std::vector<double>{-2000, -2000 + std::log(2.0), kNan});
  EXPECT_NEAR(shares[0], 0.5, 1e-12);
  EXPECT_EQ(shares[1], 1);
  EXPECT_TRUE(std::isnan(shares[2]));
  for (const double s : relative_likelihood(std::vector<double>{kNan, kNan})) {
    EXPECT_TRUE(std::isnan(s));
  }
}

TEST(LikelihoodColor, GetsBrighterAllTheWay) {
  double before = -1;
  for (int i = 0; i <= 20; ++i) {
    const auto c = likelihood_color(i / 20.0);
    const double grey = 0.114 * c[0] + 0.587 * c[1] + 0.299 * c[2];
    EXPECT_GT(grey, before) << i;
    before = grey;
  }
  EXPECT_EQ(likelihood_color(-3), likelihood_color(0));
  EXPECT_EQ(likelihood_color(7), likelihood_color(1));
}

TEST(LikelihoodOnView, PutsTheBestCellWhereItsGroundIs) {
  const auto scene = test::ring_scene(3);
  const GroundGrid grid = grid_of(17, 13);
  const cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(100));
  for (const Camera& camera : scene->cameras) {
    const cv::Mat out = likelihood_on_view(image, camera, grid, peak(grid, 10, 4));
    const auto foot = camera.project({-4 + 10 * 0.5, -3 + 4 * 0.5, 0});
    ASSERT_TRUE(foot && camera.contains(*foot));
    const cv::Point at(static_cast<int>(std::lround(foot->x())),
                       static_cast<int>(std::lround(foot->y())));
    EXPECT_TRUE(is_color(out, at, likelihood_color(1), 30)) << camera.name();
    EXPECT_TRUE(is_color(out, {5, 5}, cv::Scalar::all(55), 1)) << "the image in dark grey";
  }
}

TEST(LikelihoodOnView, LeavesOutWhatIsUnknownAndManagesWithoutAnImage) {
  const auto scene = test::ring_scene(1);
  const GroundGrid grid = grid_of(17, 13);
  const std::vector<double> unknown(17 * 13, kNan);
  const cv::Mat out = likelihood_on_view({}, scene->cameras[0], grid, unknown);
  EXPECT_EQ(out.size(), cv::Size(640, 480));
  EXPECT_EQ(cv::norm(out, cv::Mat(out.size(), CV_8UC3, cv::Scalar::all(30)), cv::NORM_INF), 0);
}

/// The highest row of the picture that has a colour of the upper half of the scale.
int top_of_bright(const cv::Mat& image) {
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const auto c = image.at<cv::Vec3b>(y, x);
      if (c[1] > 120 && c[1] > c[0] + 20) return y;  // green to yellow
    }
  }
  return image.rows;
}

TEST(LikelihoodSurface, RisesWithTheLikelihood) {
  const GroundGrid grid = grid_of(20, 20);
  std::vector<double> shares(400, 0.0);
  const auto block = [&](double share) {
    for (int row = 8; row < 12; ++row) {
      for (int column = 8; column < 12; ++column) {
        shares[static_cast<std::size_t>(row * 20 + column)] = share;
      }
    }
    return top_of_bright(likelihood_surface(grid, shares, {600, 400}));
  };
  EXPECT_LT(block(1.0), block(0.7) - 20);
  EXPECT_EQ(block(0.0), 400) << "nothing bright on flat ground";
}

TEST(LikelihoodSurface, AnySizeAndUnknownCells) {
  for (const int columns : {1, 2, 30}) {
    for (const int rows : {1, 2, 30}) {
      const GroundGrid grid = grid_of(columns, rows);
      std::vector<double> shares = peak(grid, columns / 2, rows / 2);
      EXPECT_FALSE(likelihood_surface(grid, shares, {320, 200}).empty());
      shares.assign(shares.size(), kNan);
      const cv::Mat holes = likelihood_surface(grid, shares, {320, 200});
      EXPECT_EQ(top_of_bright(holes), holes.rows);
    }
  }
}

}  // namespace
}  // namespace plaza::evidence_pictures
