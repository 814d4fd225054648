#include "modalities/edges/background.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <sstream>

#include "modalities/edges/edges.h"
#include "plaza/core/error.h"
#include "tests/modalities/edges/upright_box.h"

namespace plaza::edges {
namespace {

using test::scene_of;
using testing::HasSubstr;

const cv::Size kSize(80, 60);

BackgroundOptions options_of(BackgroundMethod method) {
  BackgroundOptions options;
  options.method = method;
  return options;
}

cv::Mat grey(int value) { return {kSize, CV_8UC3, cv::Scalar::all(value)}; }

/// A wall's edge at column 30, and somebody as a bright box at column `person` where it isn't -1.
cv::Mat yard(int person = -1) {
  cv::Mat image = grey(60);
  image.colRange(30, kSize.width).setTo(cv::Scalar::all(160));
  if (person >= 0) image({person, 20, 8, 30}).setTo(cv::Scalar::all(250));
  return image;
}

void learn(Learner& learner, const std::vector<cv::Mat>& images) {
  std::int64_t frame = 0;
  for (const cv::Mat& image : images) {
    FrameSet frames;
    frames.frame = frame++;
    frames.views = {image};
    learner.learn(frames);
  }
  learner.finish(frame);
}

int edges_in(const ViewBackground& view, const cv::Rect& part) {
  return cv::countNonZero(view.edges(part));
}
const cv::Rect kWall(28, 5, 5, 50), kRight(45, 5, 30, 50);

TEST(BackgroundLearner, UnitesTheEdgesOfPeopleFreeFrames) {
  BackgroundLearner learner(options_of(BackgroundMethod::kPeopleFree), scene_of(kSize));
  EXPECT_TRUE(learner.plan()->people_free_only);
  learn(learner, {yard(), yard(60)});
  const ViewBackground& view = *learner.view(0);
  EXPECT_GE(edges_in(view, kWall), 50);
  EXPECT_GE(edges_in(view, kRight), 50) << "what one frame shows is in the union";
  // brightness rises to the right at the wall: the mean gradient, of unit length
  const cv::Vec2f gradient = view.gradient(10, 30);
  EXPECT_NEAR(gradient[0], 1, 1e-6);
  EXPECT_NEAR(gradient[1], 0, 1e-6);
  EXPECT_EQ(view.gradient(10, 10), cv::Vec2f(0, 0));
}

TEST(BackgroundLearner, TheMedianForgetsWhoWalksThrough) {
  BackgroundOptions options = options_of(BackgroundMethod::kMedian);
  options.every = 5;
  options.first = 100;
  BackgroundLearner learner(options, scene_of(kSize));
  EXPECT_FALSE(learner.plan()->people_free_only);
  EXPECT_EQ(learner.plan()->every, 5);
  EXPECT_EQ(learner.plan()->first, 100);
  learn(learner, {yard(40), yard(50), yard(60), yard(), yard(70)});
  EXPECT_GE(edges_in(*learner.view(0), kWall), 50);
  EXPECT_EQ(edges_in(*learner.view(0), kRight), 0);
}

TEST(BackgroundLearner, TheMedianIsOfTheWholeStreamHoweverLong) {
  BackgroundLearner learner(options_of(BackgroundMethod::kMedian), scene_of(kSize));
  std::vector<cv::Mat> images(300, grey(60));  // a wall is put up in the middle
  images.insert(images.end(), 400, yard());
  learn(learner, images);
  EXPECT_GE(edges_in(*learner.view(0), kWall), 50) << "the later 400 of 700 frames have it";
}

TEST(BackgroundLearner, LowersThresholdsForTheMedian) {
  cv::Mat faint = grey(60);
  faint.colRange(30, kSize.width).setTo(cv::Scalar::all(80));  // 4 * 20 = 80: between 60 and 120
  for (const double sensitivity : {1.0, 0.5}) {
    BackgroundOptions options = options_of(BackgroundMethod::kMedian);
    options.sensitivity = sensitivity;
    BackgroundLearner learner(options, scene_of(kSize));
    learn(learner, {faint});
    EXPECT_EQ(edges_in(*learner.view(0), kWall) > 0, sensitivity == 0.5);
  }
}

TEST(BackgroundLearner, TheZoneReachesAsFarAsTheTolerance) {
  for (const double tolerance : {0.0, 1.0, 3.0}) {
    BackgroundOptions options = options_of(BackgroundMethod::kPeopleFree);
    options.tolerance_px = tolerance;
    BackgroundLearner learner(options, scene_of(kSize));
    learn(learner, {yard()});
    const ViewBackground& view = *learner.view(0);
    const int edge = cv::countNonZero(view.edges.row(30));
    EXPECT_EQ(cv::countNonZero(view.zone.row(30)), edge + 2 * static_cast<int>(tolerance));
  }
}

TEST(BackgroundLearner, NoFrameIsTheUsersError) {
  BackgroundLearner learner(options_of(BackgroundMethod::kPeopleFree), scene_of(kSize));
  try {
    learner.finish(0);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("\"background\": \"median\""));
  }
  FrameSet frames;
  frames.views = {cv::Mat(10, 10, CV_8UC3)};
  EXPECT_THROW(learner.learn(frames), UserError) << "an image of another size";
}

TEST(BackgroundLearner, AViewWithoutImagesIsUnknown) {
  const auto scene = scene_of(kSize);
  BuildContext context;
  context.name = "edges";
  context.scene = scene;
  Edges edges({}, context);
  EXPECT_THROW(edges.prepare(yard(), 0), InternalError) << "not learned";
  learn(*edges.learner(), {cv::Mat()});
  std::vector<double> out(1);
  const std::vector<Pose> poses = {{{0, 0}, 0, 1}};
  edges.match(*edges.prepare(yard(), 0).evidence, *edges.sample(test::UprightBox(), poses, 0), out);
  EXPECT_TRUE(std::isnan(out[0]));
}

TEST(BackgroundLearner, ACameraThatWasSwappedDoesNoHarm) {
  const auto scene = scene_of({160, 120});
  BuildContext context;
  context.name = "edges";
  context.scene = scene;
  Edges::Options options;
  options.min_points = 1;
  Edges edges(options, context);
  cv::Mat here(120, 160, CV_8UC3), elsewhere(120, 160, CV_8UC3);
  cv::RNG(1).fill(here, cv::RNG::UNIFORM, 0, 256);
  cv::RNG(2).fill(elsewhere, cv::RNG::UNIFORM, 0, 256);
  learn(*edges.learner(), {here});  // from one frame only
  const auto foreground = [&](const cv::Mat& image) {
    const auto prepared = edges.prepare(image, 0);
    std::vector<double> out(1);
    const std::vector<Pose> poses = {{{0, 0}, 0, 1}};
    edges.match(*prepared.evidence, *edges.sample(test::UprightBox(), poses, 0), out);
    EXPECT_TRUE(out[0] <= 0 && out[0] >= -4.5) << out[0];
    return dynamic_cast<const EdgeEvidence&>(*prepared.evidence).block().points.size();
  };
  EXPECT_EQ(foreground(here), 0u) << "what was learned is background";
  EXPECT_GT(foreground(elsewhere), 1000u);
}

std::string saved(const Learner& learner) {
  std::ostringstream out;
  learner.save(out);
  return out.str();
}

TEST(BackgroundFile, GivesBackEveryBit) {
  const auto scene = scene_of(kSize);
  BackgroundLearner learner(options_of(BackgroundMethod::kPeopleFree), scene);
  learn(learner, {yard(20), yard(50)});
  const std::string bytes = saved(learner);
  BackgroundLearner other(options_of(BackgroundMethod::kPeopleFree), scene);
  std::istringstream in(bytes);
  other.load(in);
  EXPECT_EQ(saved(other), bytes);
  EXPECT_EQ(cv::norm(learner.view(0)->gradient, other.view(0)->gradient, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(learner.view(0)->zone, other.view(0)->zone, cv::NORM_INF), 0);
}

TEST(BackgroundFile, RefusesWhatIsDamagedOrOfAnotherCamera) {
  BackgroundLearner learner(options_of(BackgroundMethod::kPeopleFree), scene_of(kSize));
  learn(learner, {yard()});
  const std::string bytes = saved(learner);
  const auto load = [&](const std::string& content, cv::Size size) {
    BackgroundLearner other(options_of(BackgroundMethod::kPeopleFree), scene_of(size));
    std::istringstream in(content);
    other.load(in);
  };
  load(bytes, kSize);
  EXPECT_THROW(load(bytes, {60, 80}), Error) << "another size";
  EXPECT_THROW(load("", kSize), Error);
  EXPECT_THROW(load("something else altogether, and long enough", kSize), Error);
  for (const std::size_t length : {30u, 60u, 1000u}) {
    EXPECT_THROW(load(bytes.substr(0, length), kSize), Error) << length;
  }
  EXPECT_THROW(load(bytes + "x", kSize), Error);
  for (std::size_t at = 0; at < bytes.size(); at += 997) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    EXPECT_THROW(load(damaged, kSize), Error) << at;
  }
}

}  // namespace
}  // namespace plaza::edges
