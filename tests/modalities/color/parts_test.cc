// People any part of whom may be hidden (thesis 7.2).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "modalities/color/color.h"
#include "modalities/color/explained_patch.h"
#include "modalities/color/part_occupancy.h"
#include "modalities/common/opencl.h"
#include "tests/modalities/color/pictures.h"

namespace plaza {
namespace {

using color::ColorEvidence;
using color::test::seen;
using color::test::street;

constexpr double kHeightM = 1.8;

/// An upright rectangle of pixels as high as a body, a third of that wide.
class Upright final : public ShapeModel {
 protected:
  Silhouette do_silhouette(const Pose& pose, const Camera& camera) const override {
    const auto at = [&](double z) {
      return *camera.project({pose.position_m.x(), pose.position_m.y(), z * pose.scale});
    };
    const Eigen::Vector2d foot = at(0), crown = at(kHeightM);
    const int top = static_cast<int>(std::lround(crown.y()));
    const int height = static_cast<int>(std::lround(foot.y())) - top;
    const int left = static_cast<int>(std::lround(foot.x())) - height / 6;
    Silhouette s;
    s.box = {static_cast<double>(left), static_cast<double>(top), height / 3.0,
             static_cast<double>(height)};
    const cv::Rect whole(left, top, height / 3, height);
    const cv::Rect inside = whole & cv::Rect(0, 0, camera.width(), camera.height());
    for (int row = inside.y; row < inside.br().y; ++row) {
      s.spans.push_back({row, inside.x, inside.br().x});
    }
    s.inside_share = static_cast<double>(inside.area()) / whole.area();
    return s;
  }
  Body do_body() const override { return {.height_m = kHeightM, .radius_m = 0.3}; }
};

/// 1 m above the ground, looking along +y: at 10 m a metre is 40 pixels.
class ColorPartsTest : public ::testing::Test {
 protected:
  ColorPartsTest() : ground_(street(200, 140)) {
    auto scene = std::make_shared<Scene>();
    CameraFromWorld pose;
    pose.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    pose.translation = -pose.rotation * Eigen::Vector3d(0, 0, 1);
    scene->cameras.push_back(Camera::pinhole(
        "one", {200, 140},
        {.fx_px = 400, .fy_px = 400, .cx_px = 100, .cy_px = 70, .distortion = {}}, pose));
    scene_ = scene;
    options_.gap = 0;
  }
  std::unique_ptr<ColorModality> taught() const {
    BuildContext context;
    context.scene = scene_;
    auto modality = std::make_unique<ColorModality>(options_, context);
    FrameSet frames;
    frames.views = {ground_};
    modality->learner()->learn(frames);
    modality->learner()->finish(1);
    return modality;
  }
  /// The ground with whoever stands at these poses.
  cv::Mat with_people(const std::vector<Pose>& poses) const {
    cv::Mat image = seen(ground_, 1, 1, 3);
    for (const Pose& pose : poses) {
      for (const RowSpan& s : Upright().silhouette(pose, scene_->cameras[0]).spans) {
        image.row(s.row).colRange(s.begin, s.end).setTo(cv::Scalar(20, 22, 25));
      }
    }
    return image;
  }
  /// A table that was there when the background was learned stands before what lies below `z_m`.
  cv::Mat behind_table(cv::Mat image, double z_m) const {
    const int row = static_cast<int>(std::lround(scene_->cameras[0].project({0, 10, z_m})->y()));
    seen(ground_, 1, 1, 3).rowRange(row, 140).copyTo(image.rowRange(row, 140));
    return image;
  }
  static std::vector<double> matched(const Modality& modality, const EvidencePtr& evidence,
                                     const std::vector<Pose>& poses) {
    const auto batch = modality.sample(Upright(), poses, 0);
    std::vector<double> out(poses.size());
    modality.match(*evidence, *batch, out);
    return out;
  }
  static Pose at(double x) { return {{x, 10}, 0, 1}; }
  void in_parts(double hidden) { options_.parts = {{0.486, hidden}, {0.829, hidden}, {1, hidden}}; }

  ColorModality::Options options_;
  std::shared_ptr<const Scene> scene_;
  cv::Mat ground_;
};

TEST_F(ColorPartsTest, HiddenLegsCostLittleInParts) {
  const cv::Mat whole = with_people({at(0)}), hidden = behind_table(whole.clone(), 0.875);
  const auto in_one = taught();
  const double one_whole = matched(*in_one, in_one->prepare(whole, 0).evidence, {at(0)})[0];
  const double one_hidden = matched(*in_one, in_one->prepare(hidden, 0).evidence, {at(0)})[0];
  in_parts(0.3);
  const auto parts = taught();
  const double parts_whole = matched(*parts, parts->prepare(whole, 0).evidence, {at(0)})[0];
  const double parts_hidden = matched(*parts, parts->prepare(hidden, 0).evidence, {at(0)})[0];
  EXPECT_NEAR(parts_whole, one_whole, 0.2);
  EXPECT_GT(one_whole - one_hidden, 1.5);
  EXPECT_LT(parts_whole - parts_hidden, 1.3);
  EXPECT_GT(parts_hidden, one_hidden + 0.3);
}

TEST_F(ColorPartsTest, AHeadAloneIsSeenThoughLessIsBelievedOfIt) {
  const cv::Mat image = behind_table(with_people({at(0)}), 1.5);
  std::vector<double> values;
  for (const double hidden : {0.01, 0.1, 0.3}) {
    in_parts(hidden);
    const auto modality = taught();
    values.push_back(matched(*modality, modality->prepare(image, 0).evidence, {at(0)})[0]);
  }
  EXPECT_LT(values[0], values[1]);
  EXPECT_LT(values[1], values[2]);
  EXPECT_LT(values[2], -1);
}

TEST_F(ColorPartsTest, AnEmptyPlaceGainsNothing) {
  const double nobody = -0.5 / (options_.occupancy_sigma * options_.occupancy_sigma);
  in_parts(0.3);
  const auto modality = taught();
  const auto out = matched(*modality, modality->prepare(with_people({at(-1.5)}), 0).evidence,
                           {at(1), at(-1.5), at(500)});
  EXPECT_NEAR(out[0], nobody, 1e-9);
  EXPECT_GT(out[1], -0.5);
  EXPECT_TRUE(std::isnan(out[2]));
}

TEST_F(ColorPartsTest, ExplainedPartsCountNowhere) {
  // one person before another, who is nearer and hides the other's legs and half of the torso
  const std::vector<Pose> poses = {{{0.1, 6}, 0, 0.7}, at(0), {{0.12, 6.2}, 0, 0.7}};
  in_parts(0.1);
  const auto modality = taught();
  const auto evidence = modality->prepare(with_people({poses[0], poses[1]}), 0).evidence;
  const auto batch = modality->sample(Upright(), poses, 0);
  const auto before = matched(*modality, evidence, poses);
  const auto rest = modality->explain(evidence, *batch, 0);
  const auto after = matched(*modality, rest, poses);
  EXPECT_TRUE(std::isnan(after[0]));
  EXPECT_GT(after[1], before[1]);
  EXPECT_GT(after[1], -0.5);
  EXPECT_EQ(matched(*modality, evidence, poses), before);
}

TEST_F(ColorPartsTest, WithoutPartsAllIsAsBefore) {
  options_.parts = {{1, 0}};
  const auto one_part = taught();
  options_.parts = {};
  const auto whole = taught();
  const cv::Mat image = with_people({at(-1), at(0.3)});
  std::vector<Pose> poses;
  for (int i = -30; i <= 30; ++i) poses.push_back(at(0.1 * i));
  const auto evidence = whole->prepare(image, 0).evidence;
  const auto a = matched(*whole, evidence, poses);
  const auto b = matched(*one_part, one_part->prepare(image, 0).evidence, poses);
  std::size_t told = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(std::isnan(a[i]), std::isnan(b[i])) << i;
    if (std::isnan(a[i])) continue;
    EXPECT_DOUBLE_EQ(a[i], b[i]) << i;
    ++told;
  }
  EXPECT_GT(told, 20U);
}

TEST_F(ColorPartsTest, ADeviceCountsPartsAsTheCpuDoes) {
  ::setenv("OPENCV_OPENCL_DEVICE", ":CPU:", 0);  // what the user has chosen stays
  if (opencl::device_name().empty()) GTEST_SKIP() << "no OpenCL device";
  in_parts(0.2);
  const auto cpu = taught();
  options_.device = ColorModality::Device::kOpencl;
  const auto device = taught();
  const auto evidence = device->prepare(with_people({at(-1), at(0.3)}), 0).evidence;
  std::vector<Pose> poses;
  for (int i = 0; i < 90; ++i) poses.push_back({{-3 + 0.07 * i, 7.0 + i % 5}, 0, 1});
  ASSERT_GE(poses.size(), opencl::kLeastTemplates);
  const auto a = matched(*cpu, evidence, poses), b = matched(*device, evidence, poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) << i;
  }
}

/// Pieces of one body are a partition: their counts sum up to those of the body in one piece.
TEST_F(ColorPartsTest, PiecesSumUpToTheBody) {
  const cv::Size size(200, 140);
  const std::vector<BodyPart> parts = {{0.486, 0.1}, {0.829, 0.1}, {1, 0.1}};
  color::SpanTemplates whole(size), cut(size, 3);
  for (int i = 0; i < 20; ++i) {
    const Pose pose{{-2 + 0.2 * i, 6.0 + i}, 0, 1};
    const Silhouette s = Upright().silhouette(pose, scene_->cameras[0]);
    const color::RingShape ring{.gap = 0.05, .width = 0.08};
    whole.add(s, ring);
    cut.add(s, ring, BodyCuts(parts, Upright().body(), pose, scene_->cameras[0]));
  }
  ASSERT_EQ(cut.size(), whole.size());
  ASSERT_EQ(cut.pieces(), 3 * whole.size());
  cv::Mat mask(size, CV_8UC1), blind(size, CV_8UC1);
  cv::randu(mask, 0, 2), cv::randu(blind, 0, 2);
  mask.setTo(0, blind);
  const color::AreaCounts foreground(mask), hidden(blind);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const color::TemplateCounts expected = count(whole, i, foreground, hidden);
    for (const auto region : {&color::TemplateCounts::inner, &color::TemplateCounts::near,
                              &color::TemplateCounts::outer}) {
      color::Counts sum;
      for (std::size_t k = 0; k < 3; ++k) {
        const color::TemplateCounts piece = count(cut, 3 * i + k, foreground, hidden);
        sum.set += (piece.*region).set;
        sum.hidden += (piece.*region).hidden;
      }
      EXPECT_EQ(sum.set, (expected.*region).set) << i;
      EXPECT_EQ(sum.hidden, (expected.*region).hidden) << i;
    }
    EXPECT_EQ(cut.near_box(i), whole.near_box(i)) << i;
    EXPECT_EQ(cut.near_box(i), whole.at(i).near_box) << i;
  }
}

}  // namespace
}  // namespace plaza
