// The modality as detectors and the kernel see it.
#include "modalities/color/color.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "plaza/contract/gtest.h"
#include "tests/modalities/color/pictures.h"

namespace plaza {
namespace {

using color::ColorEvidence;
using color::test::equal;
using color::test::random_image;
using color::test::seen;
using color::test::street;
using ::testing::HasSubstr;

/// An upright rectangle of pixels that stands where the pose says, in pixels.
class Rectangle final : public ShapeModel {
 protected:
  Silhouette do_silhouette(const Pose& pose, const Camera& camera) const override {
    const int left = static_cast<int>(pose.position_m.x());
    const int top = static_cast<int>(pose.position_m.y());
    Silhouette s;
    s.box = {static_cast<double>(left), static_cast<double>(top), 10, 30};
    const cv::Rect inside =
        cv::Rect(left, top, 10, 30) & cv::Rect(0, 0, camera.width(), camera.height());
    for (int row = inside.y; row < inside.br().y; ++row) {
      s.spans.push_back({row, inside.x, inside.br().x});
    }
    s.inside_share = inside.area() / 300.0;
    return s;
  }
  Body do_body() const override { return {}; }
};

class ColorTest : public ::testing::Test {
 protected:
  ColorTest() {
    resize(80, 60);
    options_.gap = 0;
    options_.ring = 0.2;  // people of 30 pixels only: windows of 3 x 3 widen them by one all around
  }

  void resize(int width, int height) {
    auto scene = std::make_shared<Scene>();
    PinholeIntrinsics lens;
    lens.fx_px = lens.fy_px = 100;
    scene->cameras.push_back(Camera::pinhole("one", {width, height}, lens, {}));
    scene_ = scene;
    ground_ = street(width, height);
  }
  std::unique_ptr<ColorModality> make() const {
    BuildContext context;
    context.scene = scene_;
    return std::make_unique<ColorModality>(options_, context);
  }
  static void teach(ColorModality& modality, const std::vector<cv::Mat>& images) {
    for (const cv::Mat& image : images) {
      FrameSet frames;
      frames.views = {image};
      modality.learner()->learn(frames);
    }
    modality.learner()->finish(static_cast<std::int64_t>(images.size()));
  }
  std::unique_ptr<ColorModality> taught() const {
    auto modality = make();
    teach(*modality, {ground_});
    return modality;
  }
  /// The ground with people (dark, as in winter) at these corners.
  cv::Mat with_people(const std::vector<cv::Point>& corners) const {
    cv::Mat image = seen(ground_, 1, 1, 3);
    for (const cv::Point& corner : corners) {
      const cv::Rect body =
          cv::Rect(corner, cv::Size(10, 30)) & cv::Rect(cv::Point(), image.size());
      image(body).setTo(cv::Scalar(20, 22, 25));
    }
    return image;
  }
  static std::vector<double> matched(const Modality& modality, const EvidencePtr& evidence,
                                     const std::vector<Pose>& poses) {
    const auto batch = modality.sample(Rectangle(), poses, 0);
    std::vector<double> out(poses.size());
    modality.match(*evidence, *batch, out);
    return out;
  }
  static Pose at(double x, double y) { return {{x, y}, 0, 1}; }

  ColorModality::Options options_;
  std::shared_ptr<const Scene> scene_;
  cv::Mat ground_;
};

TEST_F(ColorTest, KeepsTheContractOfModalities) {
  for (const int shrink : {1, 2}) {
    contract::Trial trial;
    trial.label = "shrink " + std::to_string(shrink);
    trial.values = {{"shrink", shrink}};
    contract::expect_kept(contract::subject_of<ColorModality>(), trial);
  }
}

TEST_F(ColorTest, PeopleFillTheirSilhouettes) {
  const auto modality = taught();
  const auto evidence = modality->prepare(with_people({{20, 15}}), 0).evidence;
  const std::vector<double> out =
      matched(*modality, evidence, {at(20, 15), at(23, 15), at(30, 15), at(55, 20), at(500, 500)});
  EXPECT_GT(out[0], -0.6);
  EXPECT_GT(out[0], out[1]);
  EXPECT_GT(out[1], out[2]);
  const double nobody = -0.5 / (options_.occupancy_sigma * options_.occupancy_sigma);
  EXPECT_NEAR(out[3], nobody, 1e-9);
  EXPECT_TRUE(std::isnan(out[4]));
}

TEST_F(ColorTest, LikelihoodIsTheDeclaredFunctionOfOccupancy) {
  const auto modality = taught();
  const auto prepared = modality->prepare(with_people({{20, 15}}), 0);
  const auto batch = modality->sample(Rectangle(), std::vector<Pose>{at(24, 18)}, 0);
  const double occupancy = dynamic_cast<const ColorEvidence&>(*prepared.evidence)
                               .occupancy(dynamic_cast<const color::SpanTemplates&>(*batch), 0, 0.3)
                               .value();
  EXPECT_GT(occupancy, 0.2);
  EXPECT_LT(occupancy, 0.8);
  for (const double sigma : {0.2, 0.5}) {
    options_.occupancy_sigma = sigma;
    const auto other = taught();
    EXPECT_NEAR(matched(*other, prepared.evidence, {at(24, 18)})[0],
                -(1 - occupancy) * (1 - occupancy) / (2 * sigma * sigma), 1e-12);
  }
}

TEST_F(ColorTest, AWiderRingSeesTheNeighbour) {
  const cv::Mat image = with_people({{20, 15}, {36, 15}});
  options_.ring = 0.15;
  const auto narrow = taught();
  const double alone = matched(*narrow, narrow->prepare(image, 0).evidence, {at(20, 15)})[0];
  options_.ring = 0.5;
  const auto wide = taught();
  const double crowded = matched(*wide, wide->prepare(image, 0).evidence, {at(20, 15)})[0];
  EXPECT_GT(alone, crowded);
}

TEST_F(ColorTest, AGapForgivesWhatStandsOut) {
  cv::Mat image = with_people({{20, 15}});
  image(cv::Rect(17, 20, 16, 8)).setTo(cv::Scalar(20, 22, 25));  // arms
  double last = -1e9;
  for (const double gap : {0.0, 0.1, 0.2}) {
    options_.gap = gap;
    const auto modality = taught();
    const double now = matched(*modality, modality->prepare(image, 0).evidence, {at(20, 15)})[0];
    EXPECT_GT(now, last) << gap;
    last = now;
  }
  EXPECT_NEAR(last, 0, 0.02);
}

TEST_F(ColorTest, ExplainedPeopleFeedNobodyElse) {
  const auto modality = taught();
  const auto evidence = modality->prepare(with_people({{20, 15}, {26, 20}}), 0).evidence;
  const std::vector<Pose> poses = {at(20, 15), at(26, 20), at(21, 16), at(16, 13)};
  const auto batch = modality->sample(Rectangle(), poses, 0);
  const auto before = matched(*modality, evidence, poses);
  const auto rest = modality->explain(evidence, *batch, 0);
  const auto after = matched(*modality, rest, poses);
  EXPECT_TRUE(std::isnan(after[0]));  // nothing is left to look at
  EXPECT_GT(after[1], before[1]);     // the one behind stands out from its surroundings now
  EXPECT_TRUE(std::isnan(after[2]));
  EXPECT_LT(after[3], before[3]);
  EXPECT_EQ(matched(*modality, evidence, poses), before);
}

TEST_F(ColorTest, ArmsAreExplainedWithTheirPerson) {
  cv::Mat image = with_people({{20, 15}});
  image(cv::Rect(17, 16, 16, 28)).setTo(cv::Scalar(20, 22, 25));
  options_.gap = 0.15;
  const auto modality = taught();
  const std::vector<Pose> poses = {at(20, 15), at(27, 15)};
  const auto evidence = modality->prepare(image, 0).evidence;
  const auto batch = modality->sample(Rectangle(), poses, 0);
  const double nobody = -0.5 / (options_.occupancy_sigma * options_.occupancy_sigma);
  const double beside = matched(*modality, modality->explain(evidence, *batch, 0), poses)[1];
  EXPECT_TRUE(std::isnan(beside) || beside < nobody + 0.1) << beside;
}

TEST_F(ColorTest, PixelsBehindOccludersDontCount) {
  const cv::Mat image = with_people({{20, 15}});
  cv::Mat hidden = image.clone();
  hidden(cv::Rect(20, 15, 10, 15)).setTo(cv::Scalar(200, 200, 0));
  ground_(cv::Rect(20, 15, 10, 15)).setTo(cv::Scalar(200, 200, 0));  // a plate, always there
  const auto unaware = taught();
  const double low = matched(*unaware, unaware->prepare(hidden, 0).evidence, {at(20, 15)})[0];
  auto scene = std::make_shared<Scene>(*scene_);
  scene->occluders.push_back({"one", "plate", {{19, 14}, {31, 14}, {31, 29}, {19, 29}}});
  scene->occluders.push_back({"another", "all", {{0, 0}, {80, 0}, {80, 60}, {0, 60}}});
  scene_ = scene;
  const auto aware = taught();
  const double high = matched(*aware, aware->prepare(hidden, 0).evidence, {at(20, 15)})[0];
  EXPECT_GT(high, low + 0.5);
  options_.least_visible = 0.8;
  const auto strict = taught();
  EXPECT_TRUE(std::isnan(matched(*strict, strict->prepare(hidden, 0).evidence, {at(20, 15)})[0]));
}

TEST_F(ColorTest, LooksAtSmallerImagesAndGivesMasksOfTheirOwnSize) {
  resize(160, 120);
  const cv::Mat image = with_people({{40, 30}, {100, 60}});
  options_.shrink = 2;
  const auto modality = taught();
  const auto prepared = modality->prepare(image, 0);
  EXPECT_EQ(dynamic_cast<const ColorEvidence&>(*prepared.evidence).mask().size(), cv::Size(80, 60));
  ASSERT_EQ(prepared.foreground.size(), image.size());
  EXPECT_NE(prepared.foreground.at<uchar>(45, 45), 0);
  EXPECT_EQ(prepared.foreground.at<uchar>(45, 75), 0);
  const std::vector<double> out = matched(
      *modality, prepared.evidence, {at(40, 30), at(46, 30), at(100, 60), at(70, 10), at(500, 0)});
  EXPECT_GT(out[0], out[1]);
  EXPECT_GT(out[2], out[1]);
  EXPECT_NEAR(out[3], -0.5 / (options_.occupancy_sigma * options_.occupancy_sigma), 1e-9);
  EXPECT_TRUE(std::isnan(out[4]));
  // what is stored is of the smaller images, and of no others
  std::stringstream file;
  modality->learner()->save(file);
  const auto restored = make();
  restored->learner()->load(file);
  EXPECT_TRUE(equal(restored->prepare(image, 0).foreground, prepared.foreground));
  options_.shrink = 4;
  file.seekg(0);
  EXPECT_THROW(make()->learner()->load(file), UserError);
}

TEST_F(ColorTest, ImagesThatCantBeDividedAreRefused) {
  resize(80, 61);
  options_.shrink = 2;
  const Diagnostics faults = make()->check();
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].pointer, "/shrink");
}

TEST_F(ColorTest, TheMaskIsThePreviousFramesPrior) {
  options_.threshold = 12;
  options_.previous = 2;
  const auto modality = taught();
  cv::Mat image = ground_.clone();
  image(cv::Rect(10, 10, 20, 20)) += cv::Scalar(12, 0, 0);  // hardly another colour
  const cv::Mat fresh = modality->prepare(image, 0).foreground;
  cv::Mat previous(image.size(), CV_8UC1, cv::Scalar(0));
  previous(cv::Rect(10, 10, 20, 20)).setTo(cv::Scalar(255));
  const cv::Mat kept = modality->prepare(image, 0, previous).foreground;
  EXPECT_GT(cv::countNonZero(kept), cv::countNonZero(fresh) + 100);
}

TEST_F(ColorTest, BlackWhiteAndForeignImagesCantTell) {
  const auto modality = taught();
  for (const cv::Mat& image :
       {cv::Mat(60, 80, CV_8UC3, cv::Scalar::all(0)),
        cv::Mat(60, 80, CV_8UC3, cv::Scalar(255, 0, 0)), random_image(80, 60, 8)}) {
    const auto prepared = modality->prepare(image, 0);
    EXPECT_TRUE(prepared.foreground.empty());
    EXPECT_TRUE(std::isnan(matched(*modality, prepared.evidence, {at(20, 15)})[0]));
    const auto batch = modality->sample(Rectangle(), std::vector<Pose>{at(20, 15)}, 0);
    const auto rest = modality->explain(prepared.evidence, *batch, 0);
    EXPECT_TRUE(std::isnan(matched(*modality, rest, {at(20, 15)})[0]));
  }
  options_.most_foreground = 1;
  const auto trusting = taught();
  EXPECT_FALSE(trusting->prepare(random_image(80, 60, 8), 0).foreground.empty());
}

TEST_F(ColorTest, TinyImagesAreImages) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 5)}) {
    resize(size.width, size.height);
    const auto modality = taught();
    const auto prepared = modality->prepare(seen(ground_, 1, 1, 1), 0);
    EXPECT_EQ(cv::countNonZero(prepared.foreground), 0);
    EXPECT_EQ(prepared.evidence->pictures().size(), 3U);
    options_.least_visible = 0;
    const auto out = matched(*modality, prepared.evidence, {at(0, 0), at(-20, 0)});
    EXPECT_TRUE(std::isnan(out[1]));
  }
}

TEST_F(ColorTest, AViewThatWasNeverSeenCantTell) {
  auto scene = std::make_shared<Scene>(*scene_);
  scene->cameras.push_back(Camera::pinhole(
      "two", {80, 60}, {.fx_px = 9, .fy_px = 9, .cx_px = 1, .cy_px = 1, .distortion = {}}, {}));
  scene_ = scene;
  const auto modality = make();
  FrameSet frames;
  frames.views = {ground_, cv::Mat()};
  modality->learner()->learn(frames);
  modality->learner()->finish(1);
  std::stringstream file;
  modality->learner()->save(file);
  const auto restored = make();
  restored->learner()->load(file);
  for (const auto* m : {modality.get(), restored.get()}) {
    const auto prepared = m->prepare(ground_, 1);
    EXPECT_TRUE(prepared.foreground.empty());
    EXPECT_TRUE(prepared.evidence->pictures().empty());
    const auto batch = m->sample(Rectangle(), std::vector<Pose>{at(20, 15)}, 1);
    std::vector<double> out(1);
    m->match(*prepared.evidence, *batch, out);
    EXPECT_TRUE(std::isnan(out[0]));
    EXPECT_FALSE(m->prepare(ground_, 0).foreground.empty());
  }
}

TEST_F(ColorTest, WhatWasLearnedIsStored) {
  const auto modality = make();
  std::vector<cv::Mat> images;
  for (std::uint32_t i = 0; i < 9; ++i) images.push_back(seen(ground_, 1, 3, i));
  teach(*modality, images);
  std::stringstream file;
  modality->learner()->save(file);
  const auto restored = make();
  restored->learner()->load(file);
  const cv::Mat image = with_people({{20, 15}});
  const auto a = modality->prepare(image, 0);
  const auto b = restored->prepare(image, 0);
  EXPECT_TRUE(equal(a.foreground, b.foreground));
  EXPECT_TRUE(equal(dynamic_cast<const ColorEvidence&>(*a.evidence).strength(),
                    dynamic_cast<const ColorEvidence&>(*b.evidence).strength()));
}

TEST_F(ColorTest, StoredBackgroundsOfAnotherSceneAreRefused) {
  std::stringstream file;
  taught()->learner()->save(file);
  const std::string content = file.str();
  resize(60, 80);
  const auto refuse = [&](const char* words) {
    std::istringstream in(content);
    try {
      make()->learner()->load(in);
      ADD_FAILURE() << "loaded";
    } catch (const UserError& error) {
      EXPECT_THAT(error.what(), HasSubstr(words));
    }
  };
  refuse("of camera 'one' is 80x60, images are looked at in 60x80");
  auto scene = std::make_shared<Scene>(*scene_);
  scene->cameras.clear();
  scene_ = scene;
  refuse("is of 1 views, the scene has 0");
}

TEST_F(ColorTest, LearningFromNothingIsTheUsersError) {
  options_.background = ColorModality::Learning::kPeopleFree;
  const auto modality = make();
  EXPECT_TRUE(modality->learner()->plan()->people_free_only);
  try {
    modality->learner()->finish(0);
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("\"background\": \"median\""));
  }
  options_.background = ColorModality::Learning::kMedian;
  EXPECT_FALSE(make()->learner()->plan()->people_free_only);
  EXPECT_THROW(teach(*make(), {cv::Mat()}), UserError);
  EXPECT_THROW(teach(*make(), {random_image(7, 7, 1)}), UserError);
}

TEST_F(ColorTest, LabIsOpenCVs) {
  const auto modality = taught();
  cv::Mat image = ground_.clone();
  image.at<cv::Vec3b>(0, 0) = {255, 255, 255};
  image.at<cv::Vec3b>(0, 1) = {0, 0, 255};
  const auto prepared = modality->prepare(image, 0);
  const cv::Mat& lab = dynamic_cast<const ColorEvidence&>(*prepared.evidence).lab();
  ASSERT_EQ(lab.size(), image.size());
  EXPECT_EQ(lab.at<cv::Vec3b>(0, 0), cv::Vec3b(255, 128, 128));
  EXPECT_EQ(lab.at<cv::Vec3b>(0, 1), cv::Vec3b(136, 208, 195));  // sRGB red: L 53, a 80, b 67
}

TEST_F(ColorTest, ShowsWhatItSaw) {
  const auto modality = taught();
  const auto pictures = modality->prepare(with_people({{20, 15}}), 0).evidence->pictures();
  ASSERT_EQ(pictures.size(), 3U);
  EXPECT_EQ(pictures[0].name, "background");
  EXPECT_TRUE(equal(pictures[0].image, ground_));
  EXPECT_EQ(pictures[1].name, "change");
  EXPECT_GT(pictures[1].image.at<cv::Vec3b>(25, 25)[0], 150);
  EXPECT_LT(pictures[1].image.at<cv::Vec3b>(50, 70)[0], 60);
  EXPECT_EQ(pictures[2].name, "foreground");
  EXPECT_EQ(pictures[2].image.at<cv::Vec3b>(25, 25), cv::Vec3b(255, 255, 255));
}

}  // namespace
}  // namespace plaza
