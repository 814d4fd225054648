// Light that changes, a shadow that moves, furniture that is shoved about, cameras that are lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "plaza/core/error.h"
#include "plugins/sources/synthetic/laboratory.h"
#include "tests/plugins/sources/synthetic/laboratory/small_scene.h"

namespace plaza::synthetic {
namespace {

LaboratoryOptions steady() {
  LaboratoryOptions options = small_options();
  options.illumination_drift = 0;
  return options;
}

TEST(ChangingPlace, WhatDoesNotChangeLeavesEveryByteAsItIs) {
  LaboratoryOptions options = small_options();
  options.light = {.factor = 1, .from_s = 0, .seconds = 3};
  options.shadow = {.share = 0, .from_s = 0, .speed_mps = 1, .width_m = 9, .edge_m = 1};
  const Laboratory plain(small_options(), small_scene()), other(options, small_scene());
  for (const std::int64_t frame : {-50, 0, 60}) {
    const auto a = plain.images(frame), b = other.images(frame);
    for (std::size_t c = 0; c < a.size(); ++c) EXPECT_TRUE(same(a[c], b[c])) << frame;
  }
}

TEST(ChangingPlace, LightBecomesWhatWasAskedForWithinTheTime) {
  LaboratoryOptions options = steady();
  options.light = {.factor = 4, .from_s = 1, .seconds = 2};
  const Laboratory plain(steady(), small_scene()), lab(options, small_scene());
  const auto factor = [&](std::int64_t frame) {
    return cv::mean(lab.radiance(frame, 0))[0] / cv::mean(plain.radiance(frame, 0))[0];
  };
  EXPECT_NEAR(factor(-30), 1, 1e-3) << "people-free images are as they were";
  EXPECT_NEAR(factor(25), 1, 1e-3);
  EXPECT_NEAR(factor(50), 2, 0.02) << "evenly in its logarithm";
  EXPECT_NEAR(factor(75), 4, 0.02);
  EXPECT_NEAR(factor(95), 4, 0.02);
  double brightest = 0;
  cv::minMaxLoc(lab.images(95)[0].reshape(1), nullptr, &brightest);
  EXPECT_EQ(brightest, 255) << "exposure stays: values clip";
  EXPECT_GT(cv::mean(lab.images(95)[0])[0], cv::mean(plain.images(95)[0])[0] + 30);
}

TEST(ChangingPlace, AShadowMovesAcrossFloorAndPeopleAndTakesNoMoreThanItsShare) {
  LaboratoryOptions options = steady();
  options.shadow = {.share = 0.6, .from_s = 0, .speed_mps = 0.5, .width_m = 1, .edge_m = 0.2};
  const Laboratory plain(steady(), small_scene()), lab(options, small_scene());
  const auto centre = [&](std::int64_t frame, double* least) {
    const cv::Mat with = lab.radiance(frame, 0), without = plain.radiance(frame, 0);
    double moment = 0, sum = 0;
    *least = 1;
    for (int y = 0; y < with.rows; ++y) {
      for (int x = 0; x < with.cols; ++x) {
        const float all = without.at<cv::Vec3f>(y, x)[1];
        if (all <= 0.01F) continue;
        const double left = with.at<cv::Vec3f>(y, x)[1] / all;
        *least = std::min(*least, left);
        sum += 1 - left;
        moment += (1 - left) * (x + 2.0 * y);
      }
    }
    return sum > 0 ? moment / sum : 0;
  };
  double before = 0, early = 0, late = 0;
  EXPECT_EQ(centre(-1, &before), 0);
  EXPECT_EQ(before, 1);
  const double first = centre(55, &early), second = centre(95, &late);
  EXPECT_LT(early, 0.8);
  EXPECT_GT(early, 0.25) << "reflected light stays; where people keep light off, it is noisy";
  EXPECT_GT(std::abs(first - second), 3) << "0.8 m farther";
}

TEST(ChangingPlace, FurnitureStandsElsewhereAfterItsTimeAndNobodyWalksThroughIt) {
  LaboratoryOptions options = steady();
  options.scenario = "three-targets";
  options.duration_s = 8;
  options.moved_furniture_s = 2;
  const Laboratory lab(options, small_scene());
  EXPECT_FALSE(same(lab.empty_images(49)[0], lab.empty_images(50)[0]));
  EXPECT_EQ(cv::norm(lab.radiance(-60, 0), lab.radiance(-60, 0), cv::NORM_INF), 0);
  int moved = 0;
  const StaticView &before = lab.view(0, 49), &after = lab.view(0, 50);
  for (std::size_t pixel = 0; pixel < before.pixels(); ++pixel) {
    if ((before.point[pixel] - after.point[pixel]).norm() > 0.05f) ++moved;
  }
  EXPECT_GT(moved, 300);
  EXPECT_LT(moved, 8000) << "of 16000: the room is the same";
  const Stage now = with_moved_furniture(stage_of("three-targets", *small_scene()));
  for (std::int64_t frame = 0; frame < 200; frame += 5) {
    for (const TruePerson& person : lab.people(frame)) {
      for (const Furniture& thing : now.furniture) {
        EXPECT_GT(thing.footprint.distance(*person.position_m), 0.0);
      }
    }
  }
}

TEST(ChangingPlace, OutdoorsThereIsNoFurnitureToMove) {
  LaboratoryOptions options = small_options();
  options.scenario = "campus";
  options.moved_furniture_s = 2;
  EXPECT_THROW(Laboratory(options, small_scene()), UserError);
}

TEST(LostCameras, GiveNoImageFromTheirTimeOnAndChangeNothingElse) {
  LaboratoryOptions options = small_options();
  options.lost = {.names = {"b"}, .from_s = 1};
  const Laboratory plain(small_options(), small_scene()), lab(options, small_scene());
  for (const std::int64_t frame : {-30, 24, 25, 99}) {
    const auto all = plain.images(frame), left = lab.images(frame);
    EXPECT_TRUE(same(all[0], left[0])) << frame;
    if (frame < 25) {
      EXPECT_TRUE(same(all[1], left[1])) << frame;
    } else {
      EXPECT_TRUE(left[1].empty()) << frame;
    }
    const auto truth = plain.people(frame), told = lab.people(frame);
    ASSERT_EQ(told.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_EQ(told[i].views.size(), truth[i].views.size()) << "figures stay comparable";
    }
  }
}

TEST(LostCameras, FromTheFirstFrameOnWasOnlyThereBefore) {
  LaboratoryOptions options = small_options();
  options.lost = {.names = {"a", "b"}, .from_s = 0};
  const Laboratory lab(options, small_scene());
  for (const cv::Mat& view : lab.images(0)) EXPECT_TRUE(view.empty());
  for (const cv::Mat& view : lab.images(-1)) EXPECT_FALSE(view.empty());
  for (const cv::Mat& view : lab.empty_images(-25)) EXPECT_FALSE(view.empty());
}

TEST(LostCameras, MustBeTheScenes) {
  LaboratoryOptions options = small_options();
  options.lost.names = {"b", "c"};
  try {
    Laboratory lab(options, small_scene());
    FAIL() << "'c' is no camera";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("no camera 'c'"));
    EXPECT_THAT(error.what(), testing::HasSubstr("it has 'a', 'b'"));
  }
}

}  // namespace
}  // namespace plaza::synthetic
