#include "modalities/common/body_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "plaza/core/error.h"

namespace plaza {
namespace {

using ::testing::HasSubstr;

std::vector<BodyPart> thirds(double hidden) {
  return {{1.0 / 3, hidden}, {2.0 / 3, hidden}, {1, hidden}};
}

/// 3 m above the ground, looking along +y and down by `tilt`, rolled about its axis.
Camera camera_above(double tilt, double roll) {
  const double c = std::cos(tilt), s = std::sin(tilt);
  Eigen::Matrix3d level;
  level << 1, 0, 0, 0, -s, -c, 0, c, -s;  // rows: right, down, ahead
  CameraFromWorld pose;
  pose.rotation = Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()).toRotationMatrix() * level;
  pose.translation = -pose.rotation * Eigen::Vector3d(0, 0, 3);
  return Camera::pinhole("one", {640, 480},
                         {.fx_px = 500, .fy_px = 500, .cx_px = 320, .cy_px = 240, .distortion = {}},
                         pose);
}

TEST(BodyPartsTest, AreReadFromPairs) {
  const std::vector<std::vector<double>> pairs = {{0.486, 0.3}, {0.829, 0.1}, {1, 0}};
  const std::vector<BodyPart> parts = read_body_parts(pairs);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[1].top, 0.829);
  EXPECT_EQ(parts[1].hidden, 0.1);
  EXPECT_TRUE(read_body_parts({}).empty());
}

TEST(BodyPartsTest, WrongPairsAreTheUsersErrors) {
  const auto refuse = [](const std::vector<std::vector<double>>& pairs, const char* pointer,
                         const char* words) {
    try {
      read_body_parts(pairs);
      ADD_FAILURE() << words;
    } catch (const UserError& error) {
      EXPECT_EQ(error.diagnostics().at(0).pointer, pointer);
      EXPECT_THAT(error.what(), HasSubstr(words));
    }
  };
  refuse({{0.5}, {1, 0.1}}, "/parts/0", "probability to be hidden");
  refuse({{0.5, 0.1}, {0.4, 0.1}, {1, 0.1}}, "/parts/1", "rise");
  refuse({{0.5, 0.1}, {1.2, 0.1}}, "/parts/1", "up to 1");
  refuse({{0, 0.1}, {1, 0.1}}, "/parts/0", "rise");
  refuse({{0.5, 0.1}, {0.9, 0.1}}, "/parts/1", "ends at 1");
  refuse({{0.5, 1}, {1, 0.1}}, "/parts/0", "below 1");
  refuse({{0.5, -0.1}, {1, 0.1}}, "/parts/0", "at least 0");
  refuse({{0.1, 0}, {0.2, 0}, {0.3, 0}, {0.4, 0}, {1, 0}}, "/parts", "at most 4");
}

TEST(BodyPartsTest, AreCutAcrossTheAxisWhereTheirHeightsAreSeen) {
  const std::vector<BodyPart> parts = thirds(0.1);
  for (const double roll : {0.0, 0.4, 1.5, 3.1}) {
    for (const double x : {-1.5, 0.0, 2.0}) {
      const Camera camera = camera_above(0.35, roll);
      const Pose pose{{x, 6}, 0, 1.1};
      const BodyCuts cuts(parts, {.height_m = 1.75, .radius_m = 0.3}, pose, camera);
      ASSERT_EQ(cuts.parts(), 3U);
      for (const double share : {-0.2, 0.1, 0.3, 0.36, 0.6, 0.7, 0.9, 1.2}) {
        const auto pixel = camera.project({x, 6, share * 1.75 * 1.1});
        ASSERT_TRUE(pixel);
        const std::size_t expected = share < 1.0 / 3 ? 0 : share < 2.0 / 3 ? 1 : 2;
        EXPECT_EQ(cuts.part_of(pixel->x(), pixel->y()), expected)
            << roll << " " << x << " " << share;
      }
    }
  }
}

TEST(BodyPartsTest, SpansFallIntoTheirPartsWithoutOverlap) {
  const Camera camera = camera_above(0.35, 0.7);
  const BodyCuts cuts(thirds(0.1), {}, {{0, 6}, 0, 1}, camera);
  std::vector<RowSpan> spans;
  std::size_t pixels = 0;
  for (int row = 0; row < 480; ++row) {
    spans.push_back({row, 100 + row / 4, 500});
    spans.push_back({row, 520, 520 + row % 7});
    pixels += static_cast<std::size_t>(400 - row / 4 + row % 7);
  }
  const auto pieces = cuts.split(spans);
  ASSERT_EQ(pieces.size(), 3U);
  std::size_t split = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    EXPECT_FALSE(pieces[k].empty()) << k;
    for (const RowSpan& s : pieces[k]) {
      split += static_cast<std::size_t>(s.end - s.begin);
      for (int x = s.begin; x < s.end; ++x)
        ASSERT_EQ(cuts.part_of(x, s.row), k) << x << "," << s.row;
    }
  }
  EXPECT_EQ(split, pixels);  // and each once, since each is in the part that it is of
}

TEST(BodyPartsTest, ABodyWhoseAxisIsOutOfSightIsInOnePiece) {
  const BodyCuts cuts(thirds(0.1), {}, {{0, -6}, 0, 1}, camera_above(0.35, 0));
  EXPECT_EQ(cuts.parts(), 3U);
  EXPECT_EQ(cuts.part_of(320, 0), 0U);
  EXPECT_EQ(cuts.part_of(320, 479), 0U);
}

TEST(PartMixtureTest, WhatAllCasesAgreeOnStays) {
  for (const double hidden : {0.0, 0.1, 0.5, 0.9}) {
    const PartMixture mixture(thirds(hidden));
    for (unsigned telling = 1; telling < 8; ++telling) {
      for (const double value : {-8.0, -1.0, 0.0}) {
        EXPECT_NEAR(mixture.log_likelihood(telling, [&](unsigned) { return value; }), value, 1e-12);
      }
    }
  }
}

TEST(PartMixtureTest, IsTheSumOverWhatMayBeInSight) {
  const std::vector<BodyPart> parts = {{0.4, 0.3}, {0.7, 0.1}, {1, 0.05}};
  const PartMixture mixture(parts);
  const auto value = [](unsigned in_sight) { return -1.5 * in_sight; };
  for (unsigned telling = 1; telling < 8; ++telling) {
    double sum = 0, all = 0;
    for (unsigned s = 1; s < 8; ++s) {
      if ((s & telling) != s) continue;
      double prior = 1;
      for (unsigned k = 0; k < 3; ++k) {
        if ((telling >> k & 1U) == 0) continue;
        prior *= (s >> k & 1U) != 0 ? 1 - parts[k].hidden : parts[k].hidden;
      }
      sum += prior * std::exp(value(s));
      all += prior;
    }
    EXPECT_NEAR(mixture.log_likelihood(telling, value), std::log(sum / all), 1e-12) << telling;
  }
}

TEST(PartMixtureTest, NothingHiddenIsTheWholeBody) {
  const PartMixture mixture(thirds(0));
  EXPECT_EQ(mixture.log_likelihood(7, [](unsigned s) { return s == 7 ? -3.0 : 0.0; }), -3.0);
}

}  // namespace
}  // namespace plaza
