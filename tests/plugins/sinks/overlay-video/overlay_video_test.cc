// The files that overlay-video leaves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "plaza/core/error.h"
#include "tests/plugins/sinks/overlay-video/overlay_run.h"

namespace plaza::overlay {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::set<std::string> pictures_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.insert(entry.path().filename());
  }
  return names;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<TrackPoint> two_people(std::int64_t frame) {
  const double t = 0.1 * static_cast<double>(frame);
  TrackPoint a = test::track_point(1, frame, t, 0);
  a.heading_rad = 0;
  return {a, test::track_point(2, frame, -1, 1 - t)};
}

TEST(OverlayVideo, WritesAVideoOfEveryFrameAndTheStills) {
  for (int cameras = 1; cameras <= 8; ++cameras) {
    OverlayRun r;
    r.scene = test::ring_scene(cameras);
    r.tracks = two_people;
    r.options.stills = 2;
    r.options.width_px = 640;
    r.run();
    const auto frames = r.video();
    ASSERT_EQ(frames.size(), 5U) << cameras << " cameras";
    EXPECT_EQ(frames[0].size(), r.layout().canvas);
    EXPECT_EQ(pictures_in(r.folder.path()),
              (std::set<std::string>{"overlay.mp4", "overlay-000002.png", "overlay-000004.png"}));
    EXPECT_EQ(r.still(1).size(), r.layout().canvas);
    ASSERT_EQ(r.artifacts.size(), 3U);
    EXPECT_THAT(r.artifacts[0].what, HasSubstr("video of all views"));
    for (const Artifact& a : r.artifacts) EXPECT_TRUE(std::filesystem::exists(a.file)) << a.file;
  }
}

TEST(OverlayVideo, VideoRunsAtTheScenesRate) {
  OverlayRun r;
  r.scene->frame_rate_hz = 7;
  r.run();
  cv::VideoCapture capture((r.folder.path() / "overlay.mp4").string(), cv::CAP_FFMPEG);
  EXPECT_NEAR(capture.get(cv::CAP_PROP_FPS), 7, 0.01);
}

TEST(OverlayVideo, EndedEarlyItIsAValidShorterVideoThatSaysSo) {
  OverlayRun r;
  r.end = 100;
  r.stop = 4;
  r.options.still_frames = {2};
  r.run();
  EXPECT_EQ(r.video().size(), 4U);
  ASSERT_EQ(r.artifacts.size(), 2U);
  EXPECT_THAT(r.artifacts[0].what, HasSubstr("partial: the first 4 of 100 frames"));
}

TEST(OverlayVideo, EndedBeforeTheFirstFrameItLeavesNothing) {
  OverlayRun r;
  r.stop = 0;
  r.run();
  EXPECT_TRUE(r.artifacts.empty());
  EXPECT_TRUE(pictures_in(r.folder.path()).empty());
}

TEST(OverlayVideo, EndWithoutBeginIsHarmless) {
  const test::TemporaryFolder folder;
  OverlayVideo overlay({}, test::context_of(test::ring_scene(1), folder.path()));
  Renderer& renderer = overlay;
  EXPECT_TRUE(renderer.end(false).empty());
}

TEST(OverlayVideo, SameInputSameBytes) {
  OverlayRun a, b;
  for (OverlayRun* r : {&a, &b}) {
    r->tracks = two_people;
    r->scene = test::ring_scene(3);
    r->run();
  }
  for (const char* file : {"overlay.mp4", "overlay-000001.png", "overlay-000003.png"}) {
    EXPECT_FALSE(bytes_of(a.folder.path() / file).empty()) << file;
    EXPECT_EQ(bytes_of(a.folder.path() / file), bytes_of(b.folder.path() / file)) << file;
  }
}

TEST(OverlayVideo, StillsOutsideOfTheRunAreLeftOut) {
  OverlayRun r;
  r.begin = 10;
  r.end = 13;
  r.options.stills = 0;
  r.options.still_frames = {1, 11, 13, 14, 500};
  r.run();
  EXPECT_EQ(pictures_in(r.folder.path()),
            (std::set<std::string>{"overlay.mp4", "overlay-000011.png", "overlay-000013.png"}));
}

TEST(OverlayVideo, StillsAreNamedAfterTheVideo) {
  OverlayRun r;
  r.options.file = "branch-b.avi";
  r.options.stills = 1;
  r.run();
  EXPECT_EQ(pictures_in(r.folder.path()),
            (std::set<std::string>{"branch-b.avi", "branch-b-000003.png"}));
}

TEST(OverlayVideo, SpreadFramesAreTheMiddlesOfEqualParts) {
  EXPECT_THAT(spread_frames(0, 9, 3), ElementsAre(1, 4, 7));
  EXPECT_THAT(spread_frames(100, 102, 5), ElementsAre(100, 101));
  EXPECT_THAT(spread_frames(0, 795, 1), ElementsAre(397));
  EXPECT_TRUE(spread_frames(5, 5, 3).empty());
  EXPECT_TRUE(spread_frames(0, 9, 0).empty());
}

TEST(OverlayVideo, FolderThatCannotBeWrittenToIsTheUsersError) {
  OverlayVideo overlay({}, test::context_of(test::ring_scene(1), "/nowhere/at/all"));
  Renderer& renderer = overlay;
  try {
    renderer.begin(0, 5);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/at/all/overlay.mp4"));
    EXPECT_THAT(error.what(), HasSubstr("--out"));
  }
}

struct CheckCase {
  std::string file;
  std::string pointer;
  std::string message;
};

TEST(OverlayVideo, CheckFindsFilesThatCannotBeWritten) {
  const std::vector<CheckCase> cases = {
      {"", "/file", "empty"},
      {"out/overlay.mp4", "/file", "plain file name"},
      {"overlay.gif", "/file", ".mp4, .mkv, .mov, .avi"},
      {"overlay", "/file", "must end in"},
  };
  for (const CheckCase& c : cases) {
    OverlayVideo::Options options;
    options.file = c.file;
    const OverlayVideo overlay(options, test::context_of(test::ring_scene(1), "."));
    const Diagnostics faults = overlay.check();
    ASSERT_EQ(faults.size(), 1U) << c.file;
    EXPECT_EQ(faults[0].pointer, c.pointer);
    EXPECT_THAT(faults[0].message, HasSubstr(c.message));
  }
  EXPECT_TRUE(OverlayVideo({}, test::context_of(test::ring_scene(1), ".")).check().empty());
}

TEST(OverlayVideo, DeclaresWhatARendererMust) {
  const auto info = OverlayVideo::declare().info(kind_of<OverlayVideo>());
  EXPECT_EQ(info.kind, "renderer");
  ASSERT_EQ(info.inputs.size(), 3U);
  EXPECT_EQ(info.inputs[0].type, FrameSet::kPort);
  EXPECT_EQ(info.inputs[1].type, Tracks::kPort);
  EXPECT_EQ(info.inputs[2].type, GroundTruth::kPort);
  EXPECT_FALSE(info.inputs[2].required);
  for (const ParameterSpec& p : info.parameters) EXPECT_FALSE(p.meaning.empty()) << p.name;
}

}  // namespace
}  // namespace plaza::overlay
