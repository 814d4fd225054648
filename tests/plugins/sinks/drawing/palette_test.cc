#include "plugins/sinks/drawing/palette.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plaza::drawing {
namespace {

double distance(const Color& a, const Color& b) { return std::sqrt((a - b).dot(a - b)); }

double contrast(const Color& a, const Color& b) {
  const auto luminance = [](const Color& c) {
    const double weights[] = {0.0722, 0.7152, 0.2126};
    double sum = 0.05;
    for (int i = 0; i < 3; ++i) sum += weights[i] * std::pow(c[i] / 255, 2.2);
    return sum;
  };
  const double ratio = luminance(a) / luminance(b);
  return std::max(ratio, 1 / ratio);
}

TEST(Palette, NeighbouringIdsAreFarApart) {
  for (TrackId id = 1; id <= 200; ++id) {
    for (TrackId other = id + 1; other <= id + 7; ++other) {
      EXPECT_GT(distance(color_of(id), color_of(other)), 40) << id << " and " << other;
    }
  }
}

TEST(Palette, EveryColourStandsOutFromBlackAndFromWhite) {
  for (TrackId id = 1; id <= 500; ++id) {
    const Color color = color_of(id);
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(color[i], 0);
      EXPECT_LE(color[i], 255);
    }
    EXPECT_GT(contrast(color, {255, 255, 255}), 1.5) << id;
    EXPECT_GT(contrast(color, {0, 0, 0}), 5) << id;
  }
}

TEST(Palette, TheColourOfAnIdNeverChanges) {
  EXPECT_EQ(color_of(7), color_of(7));
  const TrackId huge = 9'000'000'000'000'000'000;
  EXPECT_EQ(color_of(huge), color_of(huge));
}

TEST(Palette, InkIsReadableOnAnyPlate) {
  EXPECT_EQ(ink_on({255, 255, 255}), Color(0, 0, 0));
  EXPECT_EQ(ink_on({0, 0, 0}), Color(255, 255, 255));
  for (TrackId id = 1; id <= 100; ++id) {
    EXPECT_GT(contrast(ink_on(color_of(id)), color_of(id)), 4.5) << id;  // WCAG AA
  }
}

TEST(Palette, MixGoesFromOneColourToTheOther) {
  const Color a(10, 20, 30), b(110, 220, 130);
  EXPECT_EQ(mix(a, b, 1), a);
  EXPECT_EQ(mix(a, b, 0), b);
  EXPECT_EQ(mix(a, b, 0.5), Color(60, 120, 80));
}

}  // namespace
}  // namespace plaza::drawing
