#include "plugins/detectors/common/box_views.h"

#include <iterator>
#include <string>

#include "plaza/core/error.h"
#include "plaza/core/parallel.h"

namespace plaza {
namespace {

void require_calibrated(const cv::Mat& image, const Camera& camera) {
  if (image.cols == camera.width() && image.rows == camera.height() && image.type() == CV_8UC3) {
    return;
  }
  throw UserError("image is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) +
                  ", the calibration of camera '" + camera.name() + "' is for " +
                  std::to_string(camera.width()) + "x" + std::to_string(camera.height()) + " BGR");
}

}  // namespace

Observations observe_views(const FrameSet& frames, const Scene& scene, const BoxGround& ground,
                           const FindBoxes& find_boxes) {
  if (frames.views.size() != scene.cameras.size()) {
    throw InternalError("images of " + std::to_string(frames.views.size()) +
                        " views in a scene of " + std::to_string(scene.cameras.size()));
  }
  std::vector<std::vector<Observation>> seen(frames.views.size());
  parallel_for(frames.views.size(), [&](std::size_t camera) {
    const cv::Mat& image = frames.views[camera];
    if (image.empty()) return;
    try {
      require_calibrated(image, scene.cameras[camera]);
      seen[camera] = ground.observe(camera, find_boxes(camera, image));
    } catch (Error& error) {
      error.add_context({.component = {}, .frame = {}, .camera = scene.cameras[camera].name()});
      throw;
    }
  });
  Observations all;
  for (std::vector<Observation>& view : seen) {
    std::move(view.begin(), view.end(), std::back_inserter(all.items));
  }
  return all;
}

}  // namespace plaza
