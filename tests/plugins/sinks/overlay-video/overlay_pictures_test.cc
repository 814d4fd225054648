// What can be seen in overlay-video's pictures.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/plugins/sinks/overlay-video/overlay_run.h"

namespace plaza::overlay {
namespace {

constexpr double kGrey = 90;

constexpr double kLine = 32;

/// Pixels of a region that differ from a colour by at most `tolerance` in each channel. Antialiased
/// lines of one pixel never quite reach their colour.
int count_near(const cv::Mat& region, const drawing::Color& color, double tolerance = 4) {
  int count = 0;
  for (int y = 0; y < region.rows; ++y) {
    for (int x = 0; x < region.cols; ++x) {
      const cv::Vec3b p = region.at<cv::Vec3b>(y, x);
      bool near = true;
      for (int i = 0; i < 3; ++i) near = near && std::abs(p[i] - color[i]) <= tolerance;
      count += near ? 1 : 0;
    }
  }
  return count;
}

struct Picture {
  cv::Mat whole;
  Layout layout;
  cv::Mat view(std::size_t i) const { return whole(layout.views.at(i)); }
  cv::Mat plan() const { return whole(layout.plan); }
};

Picture last_picture(OverlayRun& r) {
  r.options.stills = 0;
  r.options.still_frames = {r.end};
  r.run();
  return {r.still(r.end - 1), r.layout()};
}

std::vector<TrackPoint> one_at(TrackId id, std::int64_t frame, double x_m, double y_m) {
  return {test::track_point(id, frame, x_m, y_m)};
}

TEST(OverlayPictures, ImagesAreShown) {
  OverlayRun r;
  r.options.area = false;
  const Picture p = last_picture(r);
  const drawing::Color grey(kGrey, kGrey, kGrey);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_GT(count_near(p.view(i), grey), 0.97 * p.view(i).size().area());
  }
}

TEST(OverlayPictures, APersonHasOneColourInEveryViewAndThePlan) {
  for (const TrackId id : {1, 2, 17}) {
    OverlayRun r;
    r.tracks = [id](std::int64_t f) { return one_at(id, f, 0.5, 0.5); };
    const Picture p = last_picture(r);
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_GT(count_near(p.view(i), drawing::color_of(id), kLine), 100);
    EXPECT_GT(count_near(p.plan(), drawing::color_of(id), kLine), 30);
    EXPECT_EQ(count_near(p.whole, drawing::color_of(id + 1)), 0);
  }
}

TEST(OverlayPictures, BoxesAreWhereTheyWereMeasured) {
  OverlayRun r;
  r.options.width_px = 1280;
  r.tracks = [](std::int64_t f) {
    auto people = one_at(3, f, 0, 0);
    people[0].boxes = {{0, {100, 60, 50, 120}, 1}};
    return people;
  };
  const Picture p = last_picture(r);
  const cv::Mat view = p.view(0);
  const double scale = view.cols / 640.0;
  const auto at = [&](double x, double y) {
    const cv::Rect spot(cvRound((x + 0.5) * scale - 0.5) - 1, cvRound((y + 0.5) * scale - 0.5) - 1,
                        3, 3);
    return count_near(view(spot), drawing::color_of(3), kLine) > 0;
  };
  EXPECT_TRUE(at(100, 120));
  EXPECT_TRUE(at(150, 120));
  EXPECT_TRUE(at(125, 180));
  EXPECT_FALSE(at(125, 120));
  EXPECT_FALSE(at(100, 230));
}

TEST(OverlayPictures, WithoutMeasuredBoxTheBodysBoxIsDrawn) {
  OverlayRun r;
  r.tracks = [](std::int64_t f) { return one_at(3, f, 1, -1); };
  const Picture p = last_picture(r);
  for (std::size_t i = 0; i < 2; ++i) {
    const cv::Mat view = p.view(i);
    const Camera camera = r.scene->cameras[i].scaled({view.cols, view.rows});
    const Box box = *body_box(camera, {1, -1}, r.scene->body);
    const cv::Rect left_side(cvRound(box.left) - 2, cvRound(box.top + box.height / 2) - 2, 5, 5);
    EXPECT_GT(count_near(view(left_side), drawing::color_of(3), kLine), 0);
    const cv::Rect inside(cvRound(box.left + box.width / 2) - 2,
                          cvRound(box.top + box.height / 2) - 2, 5, 5);
    EXPECT_EQ(count_near(view(inside), drawing::color_of(3), kLine), 0);
  }
}

TEST(OverlayPictures, CylindersAndBoxesCanBeChosen) {
  const auto inked = [](Draw draw) {
    OverlayRun r;
    r.options.draw = draw;
    r.tracks = [](std::int64_t f) { return one_at(3, f, 1, -1); };
    return count_near(last_picture(r).view(0), drawing::color_of(3), kLine);
  };
  const int boxes = inked(Draw::kBoxes), cylinders = inked(Draw::kCylinders),
            both = inked(Draw::kBoth);
  EXPECT_NE(boxes, cylinders);
  EXPECT_GT(both, boxes);
  EXPECT_GT(both, cylinders);
}

TEST(OverlayPictures, BridgedPeopleAreDashed) {
  const auto inked = [](bool observed) {
    OverlayRun r;
    r.tracks = [observed](std::int64_t f) {
      auto people = one_at(3, f, 1, -1);
      people[0].observed = observed;
      return people;
    };
    return count_near(last_picture(r).view(0), drawing::color_of(3), kLine);
  };
  EXPECT_LT(inked(false), 0.9 * inked(true));
}

TEST(OverlayPictures, TrailsReachAsFarBackAsAsked) {
  const auto inked = [](double trail_s) {
    OverlayRun r;
    r.end = 30;
    r.options.trail_s = trail_s;
    r.tracks = [](std::int64_t f) { return one_at(3, f, -2 + 0.1 * static_cast<double>(f), 0); };
    return count_near(last_picture(r).plan(), drawing::color_of(3), kLine);
  };
  const int none = inked(0), half = inked(0.5), two = inked(2);
  EXPECT_LT(none, half);
  EXPECT_LT(half, two);
}

TEST(OverlayPictures, HeadingIsAnArrowOnTheGround) {
  const auto inked = [](std::optional<double> heading) {
    OverlayRun r;
    r.tracks = [heading](std::int64_t f) {
      auto people = one_at(3, f, 0, 0);
      people[0].heading_rad = heading;
      return people;
    };
    return count_near(last_picture(r).view(0), drawing::color_of(3), kLine);
  };
  EXPECT_GT(inked(1.57), inked(std::nullopt) + 10);
}

TEST(OverlayPictures, AMissingImageIsADarkTileInItsFrameOnly) {
  OverlayRun r;
  r.end = 3;
  const auto grey = r.image;
  r.image = [grey](std::size_t camera, std::int64_t frame) {
    return camera == 1 && frame == 1 ? cv::Mat() : grey(camera, frame);
  };
  r.options.stills = 0;
  r.options.still_frames = {1, 2, 3};
  r.run();
  const cv::Rect tile = r.layout().views[1];
  const auto brightness = [&](std::int64_t frame) { return cv::mean(r.still(frame)(tile))[0]; };
  EXPECT_NEAR(brightness(0), kGrey, 12);
  EXPECT_LT(brightness(1), 35);
  EXPECT_NEAR(brightness(2), kGrey, 12);
  EXPECT_GT(count_near(r.still(1)(tile), drawing::dark_theme().quiet_text), 10) << "no text on it";
}

TEST(OverlayPictures, AViewThatNeverHasImagesShowsTheGround) {
  OverlayRun r;
  r.image = [](std::size_t, std::int64_t) { return cv::Mat(); };
  r.tracks = [](std::int64_t f) { return one_at(3, f, 0, 0); };
  const Picture p = last_picture(r);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_GT(count_near(p.view(i), drawing::dark_theme().floor), 0.5 * p.view(i).size().area());
    EXPECT_GT(count_near(p.view(i), drawing::dark_theme().grid), 200);
    EXPECT_GT(count_near(p.view(i), drawing::color_of(3), kLine), 50);
  }
}

TEST(OverlayPictures, FrameSetsMayHoldFewerViewsThanTheScene) {
  // a source that gives no Frames at all leaves an empty set
  OverlayRun r;
  OverlayVideo overlay(r.options, test::context_of(r.scene, r.folder.path()));
  Renderer& renderer = overlay;
  renderer.begin(0, 1);
  const FrameSet none;
  RenderFrame frame;
  frame.frames = &none;
  renderer.render(frame);
  EXPECT_FALSE(renderer.end(true).empty());
  EXPECT_EQ(r.video().size(), 1U);
}

TEST(OverlayPictures, PeopleOutsideOfAViewLeaveItAlone) {
  OverlayRun r;
  r.options.area = false;
  // behind camera 1, far in front of camera 2, and one who is nowhere near
  r.tracks = [](std::int64_t f) {
    return std::vector{test::track_point(4, f, 30, 0), test::track_point(5, f, 1e7, -1e7)};
  };
  const Picture p = last_picture(r);
  EXPECT_EQ(count_near(p.view(0), drawing::color_of(4), kLine), 0);
  EXPECT_EQ(count_near(p.view(0), drawing::color_of(5), kLine), 0);
  EXPECT_EQ(count_near(p.view(1), drawing::color_of(5), kLine), 0);
}

TEST(OverlayPictures, TruthIsDrawnOnlyWhenAskedFor) {
  const auto inked = [](bool asked) {
    OverlayRun r;
    r.options.truth = asked;
    r.options.area = false;
    r.truth = [](std::int64_t) {
      GroundTruth truth;
      truth.people.push_back(
          {1, Eigen::Vector2d(0, 0), std::nullopt, {{0, {200, 150, 80, 160}, 1}}});
      return truth;
    };
    const Picture p = last_picture(r);
    const drawing::Color white(255, 255, 255);
    return std::pair(count_near(p.view(0), white, kLine), count_near(p.view(1), white, kLine));
  };
  EXPECT_GT(inked(true).first, inked(false).first + 20);
  EXPECT_EQ(inked(true).second, inked(false).second);
}

TEST(OverlayPictures, ImagesOfAnotherSizeAreFittedIntoTheTile) {
  OverlayRun r;
  r.options.area = false;
  r.image = [](std::size_t, std::int64_t) {
    return cv::Mat(100, 333, CV_8UC3, cv::Scalar(kGrey, kGrey, kGrey));
  };
  const Picture p = last_picture(r);
  EXPECT_GT(count_near(p.view(0), {kGrey, kGrey, kGrey}), 0.97 * p.view(0).size().area());
}

}  // namespace
}  // namespace plaza::overlay
