#pragma once

#include <memory>
#include <opencv2/objdetect.hpp>
#include <vector>

#include "plaza/component/declaration.h"
#include "plugins/detectors/common/box_ground.h"
#include "plugins/detectors/hog/search_plan.h"

namespace plaza {

/// People by histograms of oriented gradients and OpenCV's linear SVM (N. Dalal and B. Triggs,
/// "Histograms of oriented gradients for human detection", CVPR 2005), searched only at the sizes
/// and places that the calibration allows.
class HogDetector final : public Detector {
 public:
  struct Options : BoxGroundOptions {
    Options();
    double hit_threshold = 0.0;
    int stride_px = 8;
    double scale_step = 1.1;
    double min_height_px = 30.0;
    double height_spread = 0.1;
    double body_share = 0.75;
    double width_share = 0.6;
  };
  static Declaration<Options> declare();
  HogDetector(const Options& options, const BuildContext& context);

  /// People's boxes in one image of `camera`, before anything is suppressed; by level, then
  /// position.
  std::vector<ImageDetection> detect_boxes(const cv::Mat& image, std::size_t camera) const;

 private:
  Observations do_detect(const NodeIo& io) const override;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  BoxGround ground_;
  cv::HOGDescriptor hog_;
  std::vector<std::vector<SearchLevel>> plans_;  ///< [camera]
};

}  // namespace plaza
