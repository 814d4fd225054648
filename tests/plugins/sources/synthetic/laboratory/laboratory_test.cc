#include "plugins/sources/synthetic/laboratory.h"

#include <gtest/gtest.h>

#include <functional>
#include <opencv2/core.hpp>

#include "tests/plugins/sources/synthetic/laboratory/small_scene.h"

namespace plaza::synthetic {
namespace {

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

/// Which body each pixel's centre meets in the middle of the exposure: -1 none.
std::vector<int> trace_bodies(const PeopleScene& people, const StaticView& view) {
  std::vector<int> out;
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      const auto pixel = static_cast<std::size_t>(y * view.width() + x);
      const float wall = view.sky(pixel)
                             ? StaticView::kNothing
                             : (view.point[pixel] - view.rays().origin()).norm() + 0.02f;
      const auto hit =
          people.trace(view.rays().origin(), view.rays().direction(x, y, 0.5f, 0.5f), wall, 0.5f);
      out.push_back(hit ? static_cast<int>(hit->geometry) : -1);
    }
  }
  return out;
}

TEST(Truth, BoxesAndVisibilityAreThoseOfTracedPixels) {
  LaboratoryOptions options = small_options();
  options.scenario = "six-targets";
  const Laboratory lab(options, small_scene());
  const auto device = std::make_shared<const RayDevice>();
  int compared = 0;
  for (const std::int64_t frame : {10, 60}) {
    const std::vector<MovingBody> bodies = lab.bodies(frame);
    const PeopleScene all(device, bodies);
    for (std::size_t c = 0; c < 2; ++c) {
      const StaticView& view = lab.view(c);
      const std::vector<int> seen = trace_bodies(all, view);
      for (const BodyView& body : body_views(bodies, view)) {
        const PeopleScene alone(device, {bodies[body.body]});
        int total = 0, visible = 0, left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
        for (int y = 0; y < view.height(); ++y) {
          for (int x = 0; x < view.width(); ++x) {
            const Vec3 d = view.rays().direction(x, y, 0.5f, 0.5f);
            if (!alone.trace(view.rays().origin(), d, StaticView::kNothing, 0.5f)) continue;
            ++total;
            left = std::min(left, x), right = std::max(right, x);
            top = std::min(top, y), bottom = std::max(bottom, y);
            visible +=
                seen[static_cast<std::size_t>(y * view.width() + x)] == static_cast<int>(body.body)
                    ? 1
                    : 0;
          }
        }
        // at the image's border the box goes on where no pixel is
        if (left == 0 || top == 0 || right == view.width() - 1 || bottom == view.height() - 1) {
          continue;
        }
        ASSERT_GT(total, 0);
        ++compared;
        EXPECT_NEAR(body.box.left, left, 2.0);
        EXPECT_NEAR(body.box.top, top, 2.0);
        EXPECT_NEAR(body.box.right(), right, 2.0);
        EXPECT_NEAR(body.box.bottom(), bottom, 2.0);
        EXPECT_NEAR(body.visibility, static_cast<double>(visible) / total, 0.05);
      }
    }
  }
  EXPECT_GT(compared, 5);
}

TEST(Truth, OnlyWhoIsInTheAreaCounts) {
  LaboratoryOptions options = small_options();
  options.scenario = "six-targets";
  options.duration_s = 20;
  const auto scene = small_scene();
  const Laboratory lab(options, scene);
  std::size_t beyond = 0;
  for (std::int64_t frame = 0; frame < 500; frame += 25) {
    const auto people = lab.people(frame);
    for (const TruePerson& person : people) EXPECT_TRUE(scene->area.contains(*person.position_m));
    beyond += lab.bodies(frame).size() - people.size();
  }
  EXPECT_GT(beyond, 0u) << "somebody comes or goes";
}

double difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total() * 3);
}

/// Mean difference of one frame's image from that of the plain options, grey levels.
double effect(const std::function<void(LaboratoryOptions&)>& change) {
  LaboratoryOptions changed = small_options();
  change(changed);
  const Laboratory plain(small_options(), small_scene()), other(changed, small_scene());
  return difference(plain.images(30)[0], other.images(30)[0]);
}

TEST(LaboratoryOptions, EachActsOnTheImage) {
  EXPECT_GT(effect([](auto& o) { o.render.shadows = false; }), 0.1);
  EXPECT_GT(effect([](auto& o) { o.sensor.noise = 0; }), 0.5);
  EXPECT_GT(effect([](auto& o) { o.sensor.blur_px = 2; }), 0.5);
  EXPECT_GT(effect([](auto& o) { o.sensor.vignetting = 0; }), 0.5);
  EXPECT_GT(effect([](auto& o) { o.sensor.colour_spread = 0; }), 0.5);
  EXPECT_GT(effect([](auto& o) { o.sensor.bayer = false; }), 0.5);
  EXPECT_GT(effect([](auto& o) { o.calibration_error_px = 5; }), 0.5);
  EXPECT_GT(effect([](auto& o) { o.illumination_drift = 0.4; }), 0.5);
  EXPECT_GT(effect([](auto& o) { o.light.factor = 0.5; }), 0.5);
  EXPECT_GT(effect([](auto& o) { o.shadow.share = 0.5; }), 0.5);
  EXPECT_GT(effect([](auto& o) { o.moved_furniture_s = 1; }), 0.5);
  EXPECT_GT(effect([](auto& o) { o.samples = 9; }), 0.01);
  EXPECT_GT(effect([](auto& o) { o.shutter_s = 0.08; }), 0.01);
}

TEST(Shadows, OnlyTakeLightAway) {
  LaboratoryOptions without = small_options();
  without.render.shadows = without.render.reflections = false;
  LaboratoryOptions with = without;
  with.render.shadows = true;
  const Laboratory plain(without, small_scene()), shaded(with, small_scene());
  const cv::Mat a = plain.radiance(30, 0), b = shaded.radiance(30, 0);
  cv::Mat more;
  cv::max(b - a, 0, more);
  EXPECT_LT(cv::norm(more, cv::NORM_INF), 1e-5);
  EXPECT_LT(cv::sum(b)[1], 0.999 * cv::sum(a)[1]);
}

TEST(CalibrationError, HasTheRootMeanSquareThatWasAskedFor) {
  const Camera camera = small_scene()->cameras[0];
  for (const double rms : {0.0, 1.0, 3.0}) {
    const CalibrationError error(camera, rms, 5);
    const PixelRays rays(camera, error);
    double sum = 0;
    int count = 0;
    for (int y = 5; y < camera.height(); y += 10) {
      for (int x = 5; x < camera.width(); x += 10) {
        const auto ray = camera.ray({x, y});
        const Eigen::Vector3d point = ray->origin + 4.0 * ray->direction;
        sum += (*rays.project(point) - Eigen::Vector2d(x, y)).squaredNorm();
        ++count;
      }
    }
    EXPECT_NEAR(std::sqrt(sum / count), rms, 0.05 * rms + 1e-6);
  }
}

TEST(PixelRays, LeadBackToTheirPixel) {
  const Camera camera = small_scene()->cameras[1];
  const PixelRays rays(camera, CalibrationError(camera, 1.0, 8));
  for (int y = 0; y < camera.height(); y += 7) {
    for (int x = 0; x < camera.width(); x += 7) {
      const Vec3 p = rays.origin() + 5.0f * rays.direction(x, y, 0.5f, 0.5f);
      const auto back = rays.project(p.cast<double>());
      ASSERT_TRUE(back);
      EXPECT_NEAR((*back - Eigen::Vector2d(x, y)).norm(), 0, 2e-3);
    }
  }
}

}  // namespace
}  // namespace plaza::synthetic
