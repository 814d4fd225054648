#include "framework/execution/missing_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plaza {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Scene scene_of(const std::vector<std::string>& names) {
  Scene scene;
  PinholeIntrinsics intrinsics;
  intrinsics.fx_px = intrinsics.fy_px = 10;
  for (const std::string& name : names) {
    scene.cameras.push_back(Camera::pinhole(name, {8, 8}, intrinsics, {}));
  }
  return scene;
}

/// Adds frames from `first`: one text per camera, '#' for an image, '.' for none.
std::vector<std::string> notes(const std::vector<std::string>& views, std::int64_t first = 0) {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < views.size(); ++c) names.push_back(std::string(1, "abc"[c]));
  MissingViews missing(scene_of(names));
  for (std::size_t f = 0; f < views[0].size(); ++f) {
    FrameSet set;
    set.frame = first + static_cast<std::int64_t>(f);
    for (const std::string& view : views) {
      set.views.push_back(view[f] == '#' ? cv::Mat(8, 8, CV_8UC3) : cv::Mat());
    }
    missing.add(set);
  }
  return missing.notes();
}

TEST(MissingViews, SaysNothingWhenAllIsThere) { EXPECT_THAT(notes({"####", "####"}), IsEmpty()); }

TEST(MissingViews, NamesCameraAndFrames) {
  EXPECT_THAT(notes({"##.#####", "########"}),
              ElementsAre("camera 'a': no image in frame 3 (1 of 8)"));
  EXPECT_THAT(notes({".#..#...", "#######.", "########"}),
              ElementsAre("camera 'a': no image in frames 1, 3-4, 6-8 (6 of 8); its last one is "
                          "that of frame 5",
                          "camera 'b': no image in frame 8 (1 of 8)"));
}

TEST(MissingViews, CountsFramesOfTheWholeSequence) {
  EXPECT_THAT(notes({"#.#"}, 100), ElementsAre("camera 'a': no image in frame 102 (1 of 3)"));
}

TEST(MissingViews, ACameraWithoutAnyImageIsSaidSo) {
  EXPECT_THAT(notes({"...", "###"}), ElementsAre("camera 'a': no image in any frame"));
}

TEST(MissingViews, ASourceWithoutImagesIsNoNews) {
  EXPECT_THAT(notes({"...", "..."}), IsEmpty());
  EXPECT_THAT(MissingViews(scene_of({"a"})).notes(), IsEmpty()) << "no frame at all";
}

TEST(MissingViews, LongListsAreCutShort) {
  EXPECT_THAT(
      notes({"#.#.#.#.#.#.#.#.#.#."}),
      ElementsAre("camera 'a': no image in frames 2, 4, 6, 8, 10, 12, 14, 16, ... (10 of 20)"));
}

}  // namespace
}  // namespace plaza
