#include "plugins/sources/synthetic/laboratory.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <opencv2/core.hpp>

#include "tests/plugins/sources/synthetic/laboratory/small_scene.h"

namespace plaza::synthetic {
namespace {

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST(Laboratory, ASeedFixesEveryPixelInAnyOrderOfFrames) {
  const Laboratory first(small_options(), small_scene());
  const Laboratory second(small_options(), small_scene());
  const auto late = second.images(40);
  const auto images = first.images(20), again = second.images(20);
  const auto first_late = first.images(40);
  for (std::size_t c = 0; c < images.size(); ++c) {
    EXPECT_TRUE(same(images[c], again[c])) << "camera " << c;
    EXPECT_TRUE(same(first_late[c], late[c])) << "camera " << c;
    EXPECT_FALSE(same(images[c], late[c])) << "camera " << c;
  }
}

TEST(Laboratory, AnotherSeedIsAnotherPlaceWithOtherPeople) {
  LaboratoryOptions other = small_options();
  other.seed = 4;
  const Laboratory first(small_options(), small_scene()), second(other, small_scene());
  EXPECT_GT(cv::norm(first.empty_images(0)[0], second.empty_images(0)[0], cv::NORM_L1),
            2.0 * 160 * 100 * 3);
}

TEST(Laboratory, LooksOnlyWherePeopleCanChangeAPixelAndMissesNothing) {
  LaboratoryOptions everywhere = small_options();
  everywhere.render.everywhere = true;
  const Laboratory cached(small_options(), small_scene()), uncached(everywhere, small_scene());
  for (const std::int64_t frame : {0, 30, 60}) {
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_TRUE(same(cached.radiance(frame, c), uncached.radiance(frame, c)))
          << "frame " << frame << " camera " << c;
    }
  }
}

}  // namespace
}  // namespace plaza::synthetic
