#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "plaza/geometry/silhouette.h"

namespace plaza::occluder_map {

/// A polygon in pixels; its corners in order.
using Polygon = std::vector<cv::Point>;

/// How often people in one view covered each pixel, and how often they were seen there.
class SightCounts {
 public:
  explicit SightCounts(cv::Size image);

  /// Somebody's silhouette, and the view's foreground: 8-bit of the image's size, not 0 where
  /// something was seen. Only the silhouette's core counts, since its border is as often beside a
  /// person as not, and models are wider than legs.
  void add(const Silhouette& silhouette, const cv::Mat& foreground);

  /// Where people covered a pixel: the share of times that they were seen there, 32-bit float;
  /// where fewer than `least_covered` did: -1.
  cv::Mat share_seen(int least_covered) const;

  struct Criterion {
    int least_covered = 1;   ///< people; fewer tell nothing of a pixel
    double most_seen = 0.2;  ///< share of them that are seen where something hides them
    int bridge_px = 9;       ///< gaps so wide that nobody covered are filled between hidden pixels
    int least_area_px = 50;  ///< smaller regions are chance
  };
  /// What hides people, largest first.
  std::vector<Polygon> occluders(const Criterion& criterion) const;

 private:
  cv::Mat covered_, seen_;  ///< 32-bit counts
};

}  // namespace plaza::occluder_map
