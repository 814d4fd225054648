#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "plaza/component/build_context.h"
#include "plaza/data/track.h"
#include "tests/sdk/geometry/test_cameras.h"
#include "tests/support/temporary_folder.h"

namespace plaza::test {

/// A place of 10 m x 8 m around the origin with `cameras` cameras on a circle of 14 m, 640 x 480,
/// 10 Hz.
inline std::shared_ptr<Scene> ring_scene(int cameras) {
  auto scene = std::make_shared<Scene>();
  scene->name = "Ring";
  scene->area = {{-5, -4}, {5, 4}};
  scene->frame_rate_hz = 10;
  for (int i = 0; i < cameras; ++i) {
    const double a = 2 * 3.14159265358979 * i / cameras;
    scene->cameras.push_back(
        Camera::pinhole("cam" + std::to_string(i + 1), {640, 480}, {600, 600, 319.5, 239.5, {}},
                        look_at({14 * std::cos(a), 14 * std::sin(a), 4}, {0, 0, 0.8})));
  }
  return scene;
}

inline BuildContext context_of(std::shared_ptr<const Scene> scene,
                               const std::filesystem::path& folder) {
  BuildContext context;
  context.name = "sink";
  context.scene = std::move(scene);
  context.output_folder = folder;
  return context;
}

inline TrackPoint track_point(TrackId id, std::int64_t frame, double x_m, double y_m) {
  TrackPoint t;
  t.id = id;
  t.frame = frame;
  t.position_m = {x_m, y_m};
  t.score = 1;
  t.final = true;
  return t;
}

}  // namespace plaza::test
