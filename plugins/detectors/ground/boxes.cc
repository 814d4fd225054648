#include "plugins/detectors/ground/boxes.h"

#include <iterator>
#include <string>

namespace plaza {

Declaration<BoxesDetector::Options> BoxesDetector::declare() {
  Parameters<Options> p;
  add_box_ground_parameters(p);
  Declaration<Options> d("boxes",
                         "Places given image boxes on the ground by their calibrated feet.");
  return d.input<Detections>("boxes of all views")
      .output<Observations>("one observation per box, with that view's box")
      .parameters(std::move(p));
}

BoxesDetector::BoxesDetector(const Options& options, const BuildContext& context)
    : scene_(context.scene), ground_(options, context.scene) {}

Observations BoxesDetector::do_detect(const NodeIo& io) const {
  const Detections& detections = io.in<Detections>(0);
  if (detections.views.size() != scene_->cameras.size()) {
    throw InternalError("detections of " + std::to_string(detections.views.size()) +
                        " views in a scene of " + std::to_string(scene_->cameras.size()));
  }
  Observations all;
  for (std::size_t camera = 0; camera < detections.views.size(); ++camera) {
    std::vector<Observation> seen = ground_.observe(camera, detections.views[camera]);
    std::move(seen.begin(), seen.end(), std::back_inserter(all.items));
  }
  return all;
}

}  // namespace plaza
