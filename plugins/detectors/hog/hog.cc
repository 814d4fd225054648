#include "plugins/detectors/hog/hog.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "plugins/detectors/common/box_views.h"

namespace plaza {

HogDetector::Options::Options() {
  nms_overlap = 0.3;
  min_score = 0.0;
  // the SVM's margin
  probability = {{0.0, 0.2}, {0.5, 0.5}, {1.0, 0.8}, {2.0, 0.95}};
  foot_sigma = 0.06;
  head_sigma = 0.06;
  centre_sigma = 0.06;
}

Declaration<HogDetector::Options> HogDetector::declare() {
  Parameters<Options> p;
  p.value("hit_threshold", &Options::hit_threshold)
      .meaning("least distance from the SVM's plane, which is the score of a box");
  p.value("stride_px", &Options::stride_px)
      .unit("px")
      .at_least(4)
      .meaning(
          "step of the 64 x 128 window in the scaled image; a multiple of 4, 8 is the usual one")
      .source("Dalal and Triggs 2005");
  p.value("scale_step", &Options::scale_step)
      .above(1.005)
      .at_most(2)
      .meaning("ratio of neighbouring scales");
  p.value("min_height_px", &Options::min_height_px)
      .unit("px")
      .at_least(16)
      .meaning("people who appear smaller are not looked for");
  p.value("height_spread", &Options::height_spread)
      .at_least(0)
      .below(1)
      .meaning("how much taller or smaller than the scene's body people may appear, as a share");
  p.value("body_share", &Options::body_share)
      .above(0)
      .at_most(1)
      .meaning("height of the person in the window, as a share of the window's")
      .source("Dalal and Triggs 2005: 96 of 128 pixels");
  p.value("width_share", &Options::width_share)
      .above(0)
      .at_most(1)
      .meaning("width of the person in the window, as a share of the window's");
  add_box_ground_parameters(p);
  Declaration<Options> d(
      "hog", "Finds people by oriented gradients and a linear SVM on calibrated ground.");
  return d.source("Dalal and Triggs 2005; OpenCV's people detector")
      .input<FrameSet>("images of all views")
      .output<Observations>("one observation per box, with that view's box")
      .parameters(std::move(p));
}

HogDetector::HogDetector(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene), ground_(options, context.scene) {
  if (options_.stride_px % 4 != 0) {
    // windows lie on a grid of 8-pixel cells; in between, OpenCV caches blocks in steps of 4
    throw UserError(fault_at("/stride_px", "must be a multiple of 4"));
  }
  hog_.setSVMDetector(cv::HOGDescriptor::getDefaultPeopleDetector());
  for (const Camera& camera : scene_->cameras) {
    plans_.push_back(plan_search(camera, *scene_,
                                 {.scale_step = options_.scale_step,
                                  .min_height_px = options_.min_height_px,
                                  .height_spread = options_.height_spread,
                                  .margin_m = options_.margin_m,
                                  .room = 0.5 / options_.body_share}));
  }
}

std::vector<ImageDetection> HogDetector::detect_boxes(const cv::Mat& image,
                                                      std::size_t camera) const {
  const cv::Size window = hog_.winSize;
  const cv::Size stride(options_.stride_px, options_.stride_px);
  const cv::Size padding(16, 16);  // people at the border miss the window's margin
  std::vector<ImageDetection> found;
  for (const SearchLevel& level : plans_.at(camera)) {
    const double scale = options_.body_share * window.height / level.body_height_px;
    const cv::Size size(static_cast<int>(std::lround(level.region.width * scale)),
                        static_cast<int>(std::lround(level.region.height * scale)));
    if (size.width < window.width || size.height < window.height) continue;
    cv::Mat scaled;
    cv::resize(image(level.region), scaled, size, 0, 0,
               scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
    std::vector<cv::Point> corners;
    std::vector<double> weights;
    hog_.detect(scaled, corners, weights, options_.hit_threshold, stride, padding);
    const double x_scale = static_cast<double>(level.region.width) / size.width;
    const double y_scale = static_cast<double>(level.region.height) / size.height;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const double width = options_.width_share * window.width;
      const double height = options_.body_share * window.height;
      const double left = corners[i].x + 0.5 * (window.width - width);
      const double top = corners[i].y + 0.5 * (window.height - height);
      found.push_back({.box = {.left = level.region.x + left * x_scale,
                               .top = level.region.y + top * y_scale,
                               .width = width * x_scale,
                               .height = height * y_scale},
                       .score = weights[i]});
    }
  }
  return found;
}

Observations HogDetector::do_detect(const NodeIo& io) const {
  return observe_views(
      io.in<FrameSet>(0), *scene_, ground_,
      [this](std::size_t camera, const cv::Mat& image) { return detect_boxes(image, camera); });
}

}  // namespace plaza
