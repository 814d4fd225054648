#include "modalities/edges/edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <thread>

#include "plaza/contract/gtest.h"
#include "tests/modalities/edges/upright_box.h"

namespace plaza::edges {
namespace {

using test::scene_of;
using test::UprightBox;

constexpr double kWorst = -4.5;  // every point beyond the gate: D_max^2 / 2 R^2

Edges::Options without_background() {
  Edges::Options options;
  options.background = BackgroundMethod::kNone;
  return options;
}

BuildContext context_of(const std::shared_ptr<const Scene>& scene) {
  BuildContext context;
  context.name = "edges";
  context.scene = scene;
  return context;
}

/// A grey image with a bright upright box where the model stands.
cv::Mat image_of(const Scene& scene, const std::vector<Pose>& people, double noise = 0) {
  const Camera& camera = scene.cameras[0];
  cv::Mat image(camera.height(), camera.width(), CV_8UC3, cv::Scalar::all(80));
  for (const Pose& pose : people) {
    for (const RowSpan& span : UprightBox().silhouette(pose, camera).spans) {
      image.row(span.row).colRange(span.begin, span.end).setTo(cv::Scalar(160, 180, 200));
    }
  }
  if (noise > 0) {
    cv::Mat grain(image.size(), CV_16SC3);
    cv::RNG(7).fill(grain, cv::RNG::NORMAL, 0, noise);
    cv::add(image, grain, image, cv::noArray(), CV_8U);
  }
  return image;
}

std::vector<double> matched(const Modality& edges, const Evidence& evidence,
                            const std::vector<Pose>& poses) {
  const UprightBox model;
  std::vector<double> out(poses.size());
  edges.match(evidence, *edges.sample(model, poses, 0), out);
  return out;
}

TEST(EdgesContract, IsKept) {
  for (const char* method : {"canny", "sobel"}) {
    for (const char* background : {"people-free", "median", "none"}) {
      contract::Trial trial;
      trial.label = std::string(method) + ", " + background;
      trial.values = {{"method", method}, {"background", background}, {"explains", "silhouette"}};
      contract::expect_kept(contract::subject_of<Edges>(), trial);
      trial.label += ", shrink 2";
      trial.values["shrink"] = 2;
      contract::expect_kept(contract::subject_of<Edges>(), trial);
    }
  }
}

TEST(Edges, LikelihoodPeaksWhereTheModelStands) {
  const auto scene = scene_of({320, 240});
  const Edges edges(without_background(), context_of(scene));
  const Pose truth{{0.4, 0.2}, 0, 1};
  const auto prepared = edges.prepare(image_of(*scene, {truth}, 6), 0);
  std::vector<Pose> poses = {truth};
  for (int i = -8; i <= 8; ++i) {
    for (int j = -8; j <= 8; ++j) {
      if (i != 0 || j != 0) poses.push_back({{0.4 + 0.25 * i, 0.2 + 0.25 * j}, 0, 1});
    }
  }
  const auto values = matched(edges, *prepared.evidence, poses);
  EXPECT_GT(values[0], -0.2);
  for (std::size_t i = 1; i < values.size(); ++i) EXPECT_LT(values[i], values[0]) << i;
}

TEST(Edges, LikelihoodPeaksThereInSmallerImagesToo) {
  const auto scene = scene_of({320, 240});
  Edges::Options options = without_background();
  options.shrink = 2;
  options.sigma_px = 1.5;
  const Edges edges(options, context_of(scene));
  const Pose truth{{0.4, 0.2}, 0, 1};
  const auto prepared = edges.prepare(image_of(*scene, {truth}, 6), 0);
  EXPECT_EQ(dynamic_cast<const EdgeEvidence&>(*prepared.evidence).layout()->size(),
            cv::Size(160, 120));
  const auto values =
      matched(edges, *prepared.evidence,
              {truth, {{0.65, 0.2}, 0, 1}, {{0.15, 0.2}, 0, 1}, {{0.4, -0.3}, 0, 1}});
  EXPECT_GT(values[0], -0.3);
  for (std::size_t i = 1; i < values.size(); ++i) EXPECT_LT(values[i], values[0] - 0.2) << i;
}

TEST(Edges, ImagesThatCantBeDividedAreRefused) {
  Edges::Options options = without_background();
  options.shrink = 3;
  const Edges edges(options, context_of(scene_of({320, 240})));
  const Diagnostics faults = edges.check();
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].pointer, "/shrink");
}

TEST(Edges, LikelihoodIsTheFormulaOfTheThesis) {
  const auto scene = scene_of({320, 240});
  Edges::Options options = without_background();
  options.link_px = 0;
  const Edges edges(options, context_of(scene));
  const auto prepared = edges.prepare(image_of(*scene, {{{0, 0}, 0, 1}}, 20), 0);
  const auto& evidence = dynamic_cast<const EdgeEvidence&>(*prepared.evidence);
  const UprightBox model;
  const Pose pose{{0.1, 0.3}, 0, 1};
  const double got = matched(edges, evidence, {pose})[0];

  double sum = 0;
  int count = 0;
  const double gate = 3 * options.sigma_px;
  for (const ContourPoint& point : model.silhouette(pose, scene->cameras[0]).contour) {
    const int x = static_cast<int>(std::lround(point.pixel.x()));
    const int y = static_cast<int>(std::lround(point.pixel.y()));
    if (!cv::Rect(0, 0, 320, 240).contains({x, y})) continue;
    const auto d = static_cast<std::size_t>(nearest_direction(point.normal, options.directions));
    const Direction& direction = evidence.layout()->directions()[d];
    const int steps =
        steps_of(evidence.block().planes.data()[evidence.layout()->offset(d, x, y)], direction);
    const double distance = steps == 255 ? gate : steps * direction.step_px;
    sum += std::min(distance * distance, gate * gate);
    ++count;
  }
  EXPECT_NEAR(got, -sum / (2 * count * options.sigma_px * options.sigma_px), 1e-12);
}

TEST(Edges, WhatCannotBeSeenIsUnknown) {
  const auto scene = scene_of({320, 240});
  const Edges edges(without_background(), context_of(scene));
  const auto prepared = edges.prepare(image_of(*scene, {}, 5), 0);
  const auto values =
      matched(edges, *prepared.evidence, {{{0, 0}, 0, 1}, {{500, 500}, 0, 1}, {{0, -9.5}, 0, 1}});
  EXPECT_TRUE(std::isfinite(values[0]));
  EXPECT_TRUE(std::isnan(values[1])) << "far outside the view";
  EXPECT_TRUE(std::isnan(values[2])) << "behind or below the image: " << values[2];
}

TEST(Edges, AnImageOfOneColourTellsNothing) {
  const auto scene = scene_of({320, 240});
  const Edges edges(without_background(), context_of(scene));
  for (const int grey : {0, 255, 90}) {
    const cv::Mat image(240, 320, CV_8UC3, cv::Scalar::all(grey));
    EXPECT_TRUE(std::isnan(matched(edges, *edges.prepare(image, 0).evidence, {{{0, 0}, 0, 1}})[0]));
  }
  cv::Mat image(240, 320, CV_8UC3, cv::Scalar::all(90));
  image.at<cv::Vec3b>(3, 3) = {91, 91, 91};
  EXPECT_EQ(matched(edges, *edges.prepare(image, 0).evidence, {{{0, 0}, 0, 1}})[0], kWorst)
      << "an image that shows something, but no edge";
}

TEST(Edges, TinyAndNoisyImagesDoNoHarm) {
  for (const cv::Size size : {cv::Size(1, 1), {3, 5}, {2, 1}, {1, 40}, {33, 2}, {200, 150}}) {
    const auto scene = scene_of(size);
    for (const EdgeMethod method : {EdgeMethod::kCanny, EdgeMethod::kSobel}) {
      Edges::Options options = without_background();
      options.method = method;
      options.blur_px = size.width == 3 ? 1 : 0;
      options.min_points = 1;
      options.min_visible = 0;
      const Edges edges(options, context_of(scene));
      cv::Mat image(size, CV_8UC3);
      cv::RNG(3).fill(image, cv::RNG::UNIFORM, 0, 256);
      const auto prepared = edges.prepare(image, 0);
      const std::vector<Pose> poses = {{{0, 0}, 0, 1}, {{0.5, 0.5}, 0, 1}};
      const auto batch = edges.sample(UprightBox(), poses, 0);
      for (const double v : matched(edges, *prepared.evidence, poses)) {
        EXPECT_TRUE(std::isnan(v) || (v <= 0 && v >= kWorst)) << v;
      }
      const auto rest = edges.explain(prepared.evidence, *batch, 0);
      for (const Picture& picture : rest->pictures()) EXPECT_EQ(picture.image.size(), size);
    }
  }
}

TEST(Edges, AnExplainedPersonIsGoneAndOthersStay) {
  const auto scene = scene_of({320, 240});
  for (const Explains explains : {Explains::kContour, Explains::kSilhouette}) {
    Edges::Options options = without_background();
    options.explains = explains;
    const Edges edges(options, context_of(scene));
    const std::vector<Pose> people = {{{-1, 0}, 0, 1}, {{1, 0}, 0, 1}};
    const auto prepared = edges.prepare(image_of(*scene, people), 0);
    const auto before = matched(edges, *prepared.evidence, people);
    const auto rest = edges.explain(prepared.evidence, *edges.sample(UprightBox(), people, 0), 0);
    const auto after = matched(edges, *rest, people);
    EXPECT_GT(before[0], -0.3);
    EXPECT_LT(after[0], -4.0);
    EXPECT_EQ(after[1], before[1]);
    EXPECT_EQ(matched(edges, *prepared.evidence, people), before) << "the input stays";
  }
}

TEST(Edges, AnExplainedRegionSpeaksNeitherForNorAgainst) {
  const auto scene = scene_of({320, 240});
  Edges::Options options = without_background();
  options.explains = Explains::kRegion;
  const Edges edges(options, context_of(scene));
  // two side by side, the second half behind the first, and a third who has nothing
  const std::vector<Pose> poses = {{{0, 0}, 0, 1}, {{0.12, 0}, 0, 1}, {{1.5, 0}, 0, 1}};
  const std::vector<Pose> people(poses.begin(), poses.begin() + 1);
  const auto prepared = edges.prepare(image_of(*scene, people), 0);
  const auto before = matched(edges, *prepared.evidence, poses);
  const auto batch = edges.sample(UprightBox(), poses, 0);
  const auto rest = edges.explain(prepared.evidence, *batch, 0);
  const auto after = matched(edges, *rest, poses);
  EXPECT_GT(before[0], -0.3);
  EXPECT_TRUE(std::isnan(after[0])) << after[0] << ": nothing of it is left to look at";
  EXPECT_TRUE(std::isnan(after[1]) || after[1] < before[1] - 1) << after[1];
  EXPECT_EQ(after[2], before[2]);
  EXPECT_EQ(matched(edges, *prepared.evidence, poses), before) << "the input stays";
  bool grey = false;
  for (const Picture& picture : rest->pictures()) {
    if (picture.name != "linked-edges") continue;
    const cv::Mat3b image = picture.image;
    grey = std::any_of(image.begin(), image.end(),
                       [](const cv::Vec3b& p) { return p == cv::Vec3b(90, 90, 90); });
  }
  EXPECT_TRUE(grey) << "the picture shows what is explained";
}

TEST(ContourMatcher, CountsWhatIsNotHidden) {
  const cv::Size size(60, 50);
  const auto layout = std::make_shared<const PlaneLayout>(size, make_directions(6, 6));
  const ContourMatcher matcher(layout, 2, 6);
  FastTransform transform(layout);
  ByteBlock block(layout->bytes());
  const EdgePoint edge[] = {{30, 20}, {31, 20}, {12, 40}};
  transform.run(edge, block);
  // a contour of points in all directions, and the same without those that are hidden
  Silhouette whole, part;
  whole.inside_share = part.inside_share = 1;
  std::vector<RowSpan> region;
  for (int row = 5; row < 45; row += 2) region.push_back({row, 8, 8 + row});
  HiddenRegion hidden(*layout);
  hidden.add(region, 2);
  int hidden_points = 0;
  for (int i = 0; i < 300; ++i) {
    const int x = 7 * i % size.width, y = 11 * i % size.height;
    const float turn = 0.1F * static_cast<float>(i);
    const ContourPoint p{{static_cast<float>(x), static_cast<float>(y)},
                         {std::cos(turn), std::sin(turn)}};
    whole.contour.push_back(p);
    const bool hides = std::any_of(region.begin(), region.end(), [&](const RowSpan& s) {
      const int up = std::abs(s.row - y);
      return (up == 0 || up == 2) && s.begin - 2 <= x && x < s.end + 2;
    });
    EXPECT_EQ(hidden.at(x, y), hides);
    hidden_points += hides ? 1 : 0;
    if (!hides) part.contour.push_back(p);
  }
  ASSERT_GT(hidden_points, 30);
  EdgeTemplates templates(layout);
  templates.add(whole, {});
  templates.add(part, {});
  const auto found = matcher.log_likelihood(block.data(), hidden, templates, 0, 0.3, 20);
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(*found, matcher.log_likelihood(block.data(), templates, 1));
  EXPECT_FALSE(matcher.log_likelihood(block.data(), hidden, templates, 0, 0.99, 20));
  EXPECT_FALSE(matcher.log_likelihood(block.data(), hidden, templates, 0, 0.3, 1000));
}

TEST(Edges, ExplainingTheSilhouetteTakesItsTextureToo) {
  const auto scene = scene_of({320, 240});
  const std::vector<Pose> person = {{{0, 0}, 0, 1}};
  cv::Mat image = image_of(*scene, person);
  const Box box = UprightBox().silhouette(person[0], scene->cameras[0]).box;
  const cv::Point middle(static_cast<int>(box.left + box.width / 2),
                         static_cast<int>(box.top + box.height / 2));
  cv::rectangle(image, middle - cv::Point(3, 3), middle + cv::Point(3, 3), cv::Scalar::all(20), -1);
  const auto left = [&](Explains explains) {
    Edges::Options options = without_background();
    options.explains = explains;
    const Edges edges(options, context_of(scene));
    const auto rest =
        edges.explain(edges.prepare(image, 0).evidence, *edges.sample(UprightBox(), person, 0), 0);
    return dynamic_cast<const EdgeEvidence&>(*rest).points().size();
  };
  EXPECT_EQ(left(Explains::kSilhouette), 0u);
  EXPECT_GT(left(Explains::kContour), 5u);
}

TEST(Edges, EvidenceOutlivesItsModalityAndBlocksComeBack) {
  const auto scene = scene_of({64, 48});
  EvidencePtr last;
  {
    const Edges edges(without_background(), context_of(scene));
    const void* first = nullptr;
    for (int i = 0; i < 3; ++i) {
      const auto evidence = edges.prepare(image_of(*scene, {}, 5), 0).evidence;
      const void* planes = dynamic_cast<const EdgeEvidence&>(*evidence).block().planes.data();
      if (first == nullptr) first = planes;
      EXPECT_EQ(planes, first) << "the planes are reused as soon as their evidence has died";
    }
    last = edges.prepare(image_of(*scene, {}, 5), 0).evidence;
    const auto other = edges.prepare(image_of(*scene, {}, 5), 0).evidence;
    EXPECT_NE(dynamic_cast<const EdgeEvidence&>(*other).block().planes.data(),
              dynamic_cast<const EdgeEvidence&>(*last).block().planes.data());
  }
  EXPECT_EQ(last->pictures().size(), 5u);
}

TEST(Edges, RefusesTemplatesAndEvidenceOfOthers) {
  const auto scene = scene_of({64, 48});
  const Edges one(without_background(), context_of(scene)),
      two(without_background(), context_of(scene));
  const auto evidence = one.prepare(image_of(*scene, {}, 5), 0).evidence;
  const std::vector<Pose> poses = {{{0, 0}, 0, 1}};
  const auto foreign = two.sample(UprightBox(), poses, 0);
  std::vector<double> out(1);
  EXPECT_THROW(one.match(*evidence, *foreign, out), std::invalid_argument);
  EXPECT_THROW(two.match(*evidence, *foreign, out), std::invalid_argument);
}

TEST(Edges, ThresholdsMustNotContradict) {
  Edges::Options options = without_background();
  options.low_threshold = 200;
  EXPECT_THROW(Edges(options, context_of(scene_of({64, 48}))), UserError);
}

}  // namespace
}  // namespace plaza::edges
