// Payloads as bytes and back: every bit, or a clear no.
#include "framework/cache/payload_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/cache/bytes.h"
#include "plaza/data/detections.h"
#include "plaza/data/evidence.h"
#include "plaza/data/frames.h"
#include "plaza/data/ground_likelihood.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"

namespace plaza {
namespace {

/// A word.
struct Word final : FeatureOf<Word> {
  static constexpr std::string_view kFeature = "word";
  explicit Word(std::string_view t) : text(t) {}
  static std::shared_ptr<const Word> load(std::string_view bytes) {
    if (bytes == "none") throw UserError("this is no word");
    if (bytes == "alien") throw 42;
    if (bytes == "nothing") return nullptr;
    return std::make_shared<Word>(bytes);
  }
  std::optional<std::string> do_save() const override { return text; }
  std::string text;
};

FeatureLoaders loaders() {
  const FeatureSpec spec = feature_spec<Word>("a word");
  return {{spec.name, spec.load}};
}

/// What comes back of a payload.
template <class T>
std::shared_ptr<const T> again(const T& payload) {
  const auto bytes = encode_payload(payload, loaders());
  EXPECT_TRUE(bytes.has_value());
  auto back =
      std::dynamic_pointer_cast<const T>(decode_payload(T::kPort, *bytes, loaders(), "test"));
  EXPECT_NE(back, nullptr);
  EXPECT_EQ(encode_payload(*back, loaders()), bytes) << "the same bytes again";
  for (std::size_t cut = 0; cut < std::min<std::size_t>(bytes->size(), 400); ++cut) {
    EXPECT_THROW(
        decode_payload(T::kPort, std::string_view(*bytes).substr(0, cut), loaders(), "test"),
        DamagedEntry)
        << cut << " of " << bytes->size() << " bytes";
  }
  EXPECT_THROW(decode_payload(T::kPort, *bytes + "x", loaders(), "test"), DamagedEntry);
  return back;
}

cv::Mat noise(int type) {
  cv::Mat image(48, 64, type);
  std::uint32_t state = 1;
  for (int row = 0; row < image.rows; ++row) {
    for (std::size_t b = 0; b < image.cols * image.elemSize(); ++b) {
      image.ptr(row)[b] = static_cast<unsigned char>((state = state * 1664525 + 1013904223) >> 24);
    }
  }
  return image;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         std::equal(a.datastart, a.dataend, b.datastart, b.dataend);
}

TEST(PayloadCodecTest, ImagesAreLosslessAndMissingViewsStayMissing) {
  FrameSet frames;
  frames.frame = 7;
  frames.time_ns = 280000000;
  frames.views = {noise(CV_8UC3), cv::Mat()};
  const auto back = again(frames);
  EXPECT_EQ(back->frame, 7);
  EXPECT_EQ(back->time_ns, 280000000);
  ASSERT_EQ(back->views.size(), 2U);
  EXPECT_TRUE(same(back->views[0], frames.views[0]));
  EXPECT_TRUE(back->views[1].empty());

  ForegroundMask mask;
  mask.views = {noise(CV_8UC1)};
  EXPECT_TRUE(same(again(mask)->views[0], mask.views[0]));
}

Observation observation() {
  Observation o;
  o.position_m = {0.1, -1.0 / 3};
  o.covariance_m2 << 0.5, 0.125, 0.125, 2;
  o.probability = std::numeric_limits<double>::denorm_min();
  o.score = -1.0 / 7;
  o.heading_rad = -0.0;
  o.boxes = {{.camera = 3, .box = {1.5, 2, 30, 60}, .score = -7}};
  return o;
}

TEST(PayloadCodecTest, NumbersKeepAllTheirBits) {
  Observations observations;
  observations.items = {observation(), Observation{}};
  observations.grid = GroundGrid{{1, 2}, {0.1, 0.2}, 40, 30};
  const auto back = again(observations);
  ASSERT_EQ(back->items.size(), 2U);
  EXPECT_EQ(back->items[0].position_m, observations.items[0].position_m);
  EXPECT_EQ(back->items[0].covariance_m2, observations.items[0].covariance_m2);
  EXPECT_EQ(back->items[0].probability, std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(back->items[0].score, -1.0 / 7);
  EXPECT_TRUE(std::signbit(*back->items[0].heading_rad));
  EXPECT_EQ(back->items[0].boxes.at(0).camera, 3U);
  EXPECT_EQ(back->items[0].boxes.at(0).box, observations.items[0].boxes[0].box);
  EXPECT_FALSE(back->items[1].heading_rad);
  EXPECT_EQ(back->grid->columns, 40);

  GroundLikelihood likelihood;
  likelihood.joint = {std::nan(""), -std::numeric_limits<double>::infinity(), 1};
  likelihood.views = {{2, 3}, {}};
  const auto surface = again(likelihood);
  EXPECT_TRUE(std::isnan(surface->joint[0]));
  EXPECT_EQ(surface->views, likelihood.views);
}

TEST(PayloadCodecTest, PeopleAndTracks) {
  GroundTruth truth;
  truth.annotated = false;
  truth.people = {{.id = 4,
                   .position_m = Eigen::Vector2d(1, 2),
                   .heading_rad = {},
                   .views = {{.camera = 1, .box = {1, 2, 3, 4}, .visibility = 0.25}}},
                  {.id = 5, .position_m = {}, .heading_rad = 1.5, .views = {}}};
  const auto people = again(truth);
  EXPECT_FALSE(people->annotated);
  EXPECT_EQ(people->people[0].views[0].visibility, 0.25);
  EXPECT_FALSE(people->people[1].position_m);

  Detections detections;
  detections.views = {{{.box = {1, 2, 3, 4}, .score = 0.5}}, {}};
  EXPECT_EQ(again(detections)->views[0][0].score, 0.5);

  Tracks tracks;
  tracks.points = {{.id = 2,
                    .frame = 9,
                    .position_m = {3, 4},
                    .heading_rad = 0.5,
                    .score = 0.75,
                    .observed = false,
                    .final = true,
                    .boxes = observation().boxes}};
  const auto points = again(tracks);
  EXPECT_EQ(points->points[0].frame, 9);
  EXPECT_TRUE(points->points[0].final);
  EXPECT_FALSE(points->points[0].observed);

  Tracklets tracklets;
  tracklets.items.push_back({.id = 8, .points = tracks.points, .features = {}});
  EXPECT_EQ(again(tracklets)->items[0].points[0].heading_rad, 0.5);
}

TEST(PayloadCodecTest, FeaturesComeBackAsTheyWereSaved) {
  Observations observations;
  observations.items = {observation(), observation()};
  observations.items[1].features.set(std::make_shared<Word>(std::string_view("a\0b", 3)));
  const auto back = again(observations);
  EXPECT_TRUE(back->items[0].features.empty());
  ASSERT_NE(back->items[1].features.get<Word>(), nullptr);
  EXPECT_EQ(back->items[1].features.get<Word>()->text, std::string_view("a\0b", 3));
  Tracklets tracklets;
  tracklets.items.resize(1);
  tracklets.items[0].features.set(std::make_shared<Word>(""));
  EXPECT_NE(again(tracklets)->items[0].features.get<Word>(), nullptr);
}

TEST(PayloadCodecTest, FeaturesThatArentWhatTheyShouldBeAreDamaged) {
  Observations observations;
  observations.items = {observation()};
  for (const char* word : {"none", "alien", "nothing"}) {
    observations.items[0].features.set(std::make_shared<Word>(word));
    const auto bytes = encode_payload(observations, loaders());
    ASSERT_TRUE(bytes);
    EXPECT_THROW(decode_payload(Observations::kPort, *bytes, loaders(), "test"), DamagedEntry)
        << word;
    EXPECT_THROW(decode_payload(Observations::kPort, *bytes, {}, "test"), DamagedEntry);
  }
}

struct Secret final : FeatureOf<Secret> {
  static constexpr std::string_view kFeature = "secret";
};

TEST(PayloadCodecTest, WhatCannotBeKeptIsSaid) {
  EXPECT_FALSE(can_keep(EvidenceSet::kPort));
  EXPECT_TRUE(can_keep(FrameSet::kPort));
  EXPECT_FALSE(encode_payload(EvidenceSet(), {}));
  Observations observations;
  observations.items = {observation()};
  observations.items[0].features.set(std::make_shared<Secret>());
  EXPECT_FALSE(encode_payload(observations, loaders())) << "its features would be lost";
  EXPECT_THROW(decode_payload("Nonsense", "", {}, "test"), DamagedEntry);
}

}  // namespace
}  // namespace plaza
