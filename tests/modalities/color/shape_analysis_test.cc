#include "modalities/color/shape_analysis.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/modalities/color/pictures.h"

namespace plaza::color {
namespace {

using test::camera_above;
using test::equal;

class ShapeAnalysisTest : public ::testing::Test {
 protected:
  ShapeAnalysisTest()
      : camera_(camera_above()),
        scale_(camera_, {.min_m = {-5, 5}, .max_m = {5, 15}}, {.height_m = 1.8, .radius_m = 0.3}),
        mask_(240, 320, CV_8UC1, cv::Scalar(0)) {}

  /// An upright rectangle on the ground, from `low_m` up to `high_m`; what was painted.
  cv::Rect stand(double x_m, double y_m, double half_width_m, double low_m, double high_m) {
    const auto pixel = [&](double x, double z) { return *camera_.project({x, y_m, z}); };
    const Eigen::Vector2d a = pixel(x_m - half_width_m, high_m),
                          b = pixel(x_m + half_width_m, low_m);
    const cv::Rect box(cv::Point(static_cast<int>(a.x()), static_cast<int>(a.y())),
                       cv::Point(static_cast<int>(b.x()) + 1, static_cast<int>(b.y()) + 1));
    mask_(box).setTo(cv::Scalar(255));
    return box;
  }
  static int left_of(const cv::Mat& mask, const cv::Rect& box) {
    return cv::countNonZero(mask(box));
  }

  Camera camera_;
  BodyScale scale_;
  cv::Mat mask_;
};

TEST_F(ShapeAnalysisTest, ABodyIsAsLargeAsTheFarthestOneThatCoversThePixel) {
  for (const double y : {6.0, 9.0, 13.0}) {
    const Eigen::Vector2d foot = *camera_.project({0, y, 0}), crown = *camera_.project({0, y, 1.8});
    const double expected = (foot.y() - crown.y()) / 1.8;
    const float found = scale_.px_per_m(static_cast<int>(foot.x()), static_cast<int>(foot.y()) - 2);
    EXPECT_NEAR(found, expected, 0.12 * expected) << y;
  }
  EXPECT_EQ(scale_.px_per_m(160, 0), 0);  // above everybody's head
}

TEST_F(ShapeAnalysisTest, LowPiecesAreDroppedAtTheirPlace) {
  const cv::Rect person = stand(0, 8, 0.25, 0, 1.7), head = stand(2, 8, 0.12, 1.4, 1.75);
  const cv::Rect speck = stand(-2, 8, 0.1, 0, 0.15), near_speck = stand(-1, 5.5, 0.1, 0, 0.15);
  const cv::Mat out = analysed(mask_, scale_, {.least_height_m = 0.25});
  EXPECT_EQ(left_of(out, person), person.area());
  EXPECT_EQ(left_of(out, head), head.area());
  EXPECT_EQ(left_of(out, speck), 0);
  EXPECT_EQ(left_of(out, near_speck), 0);
  EXPECT_GT(left_of(mask_, speck), 0);  // the input stays
}

TEST_F(ShapeAnalysisTest, AShadowThatLiesAtSomebodysFeetIsTakenOut) {
  const cv::Rect person = stand(0, 8, 0.25, 0, 1.7);
  const cv::Rect shadow(person.br().x, person.br().y - 5, 60,
                        5);  // beside the feet, joined to them
  mask_(shadow).setTo(cv::Scalar(255));
  const cv::Mat pieces = analysed(mask_, scale_, {.least_height_m = 0.3});
  EXPECT_EQ(left_of(pieces, shadow), shadow.area());  // of one piece with the person
  const cv::Mat columns = analysed(mask_, scale_, {.least_column_m = 0.3});
  EXPECT_EQ(left_of(columns, shadow), 0);
  EXPECT_EQ(left_of(columns, person), person.area());
}

TEST_F(ShapeAnalysisTest, GapsBetweenLimbsAreFilledAndThoseBetweenPeopleAreNot) {
  const cv::Rect person = stand(0, 7, 0.3, 0, 1.8);
  const cv::Rect gap(person.x + person.width / 2 - 2, person.y + person.height / 2, 4, 12);
  mask_(gap).setTo(cv::Scalar(0));
  const cv::Rect two = stand(3, 7, 1.0, 0, 1.8);
  const cv::Rect between(two.x + 8, two.y + 8, two.width - 16, two.height - 16);
  mask_(between).setTo(cv::Scalar(0));
  const cv::Rect low = stand(-3, 7, 0.5, 0, 0.6);
  mask_(cv::Rect(low.x + 5, low.y + 5, 4, 4)).setTo(cv::Scalar(0));
  const cv::Mat out = analysed(mask_, scale_, {.most_hole = 0.1});
  EXPECT_EQ(left_of(out, person), person.area());
  EXPECT_EQ(left_of(out, between), 0);
  EXPECT_EQ(left_of(out, low), low.area() - 16);
}

TEST_F(ShapeAnalysisTest, WhereNobodyCanBeSeenAllStays) {
  mask_(cv::Rect(100, 1, 3, 2)).setTo(cv::Scalar(255));
  const cv::Mat out =
      analysed(mask_, scale_, {.least_height_m = 5, .least_column_m = 5, .most_hole = 1});
  EXPECT_TRUE(equal(out, mask_));
}

TEST_F(ShapeAnalysisTest, NothingAskedForIsNothingDone) {
  stand(0, 8, 0.25, 0, 0.1);
  EXPECT_EQ(analysed(mask_, scale_, {}).data, mask_.data);
}

TEST_F(ShapeAnalysisTest, PiecesAndHolesAreThoseOfOpenCV) {
  std::mt19937 random(3);
  int dropped = 0, filled = 0;
  for (const int percent : {20, 38, 50, 62, 85}) {
    for (int y = 0; y < mask_.rows; ++y) {
      for (int x = 0; x < mask_.cols; ++x) {
        mask_.at<uchar>(y, x) =
            static_cast<uchar>(static_cast<int>(random() % 100) < percent ? 255 : 0);
      }
    }
    cv::Mat labels, stats, centres;
    cv::Mat expected = mask_.clone();
    const int n = cv::connectedComponentsWithStats(mask_, labels, stats, centres, 8);
    for (int y = 0; y < mask_.rows; ++y) {
      for (int x = 0; x < mask_.cols; ++x) {
        const int label = labels.at<int>(y, x);
        if (label == 0) continue;
        const int left = stats.at<int>(label, cv::CC_STAT_LEFT);
        const int right = left + stats.at<int>(label, cv::CC_STAT_WIDTH) - 1;
        const int height = stats.at<int>(label, cv::CC_STAT_HEIGHT);
        const int bottom = stats.at<int>(label, cv::CC_STAT_TOP) + height - 1;
        const float px_per_m = scale_.px_per_m((left + right) / 2, bottom);
        if (px_per_m > 0 && height < 0.3 * static_cast<double>(px_per_m)) {
          expected.at<uchar>(y, x) = 0;
          ++dropped;
        }
      }
    }
    EXPECT_GT(n, 1);
    EXPECT_TRUE(equal(analysed(mask_, scale_, {.least_height_m = 0.3}), expected)) << percent;

    // a hole in a piece that is high enough for every hole
    cv::Mat pierced = mask_.clone();
    pierced(cv::Rect(0, 0, 320, 70)).setTo(cv::Scalar(0));
    cv::rectangle(pierced, cv::Rect(0, 60, 320, 180), cv::Scalar(255), 3);
    cv::Mat holes = analysed(pierced, scale_, {.most_hole = 1}) - pierced;
    cv::Mat inverse = 255 - pierced;
    cv::connectedComponentsWithStats(inverse, labels, stats, centres, 4);
    for (int y = 0; y < mask_.rows; ++y) {
      for (int x = 0; x < mask_.cols; ++x) {
        if (holes.at<uchar>(y, x) == 0) continue;
        ++filled;
        const int label = labels.at<int>(y, x);
        ASSERT_GT(label, 0);
        ASSERT_GT(stats.at<int>(label, cv::CC_STAT_TOP), 0) << "open to the border";
        // all of the hole
        ASSERT_EQ(cv::countNonZero((labels == label) & (holes == 0)), 0);
        y = mask_.rows - 1;  // one per image is enough for what that costs
        break;
      }
    }
  }
  EXPECT_GT(dropped, 1000);
  EXPECT_GT(filled, 2);
}

}  // namespace
}  // namespace plaza::color
