#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/core/diagnostic.h"
#include "plaza/data/evidence.h"
#include "plaza/geometry/scene.h"
#include "plaza/geometry/silhouette.h"

/// Looking at images in a smaller size, which costs less and loses little as long as people are
/// many pixels high (thesis 4.4.5).
namespace plaza {

/// How many times smaller, along both axes. A pixel of the smaller image stands for a block of
/// pixels, so that x and y there are (x + 0.5) / shrink - 0.5 of those of the image.
class Shrink {
 public:
  static constexpr int kMost = 8;

  /// From 1, which leaves everything as it is, to kMost; throws std::invalid_argument.
  explicit Shrink(int times);

  /// Whether all cameras' images are a whole number of blocks wide and high.
  bool fits(const Scene& scene) const;
  /// Adds a fault at "/shrink" for every camera whose images aren't.
  void check(const Scene& scene, Diagnostics& faults) const;
  /// The scene in the smaller images: its cameras and occluders.
  std::shared_ptr<const Scene> operator()(std::shared_ptr<const Scene> scene) const;
  /// Each pixel the mean of its block. Not a copy where nothing is shrunk.
  cv::Mat operator()(const cv::Mat& image) const;
  /// Pixels that at least half of their block belongs to, and one contour point of as many as a
  /// block is wide.
  Silhouette operator()(Silhouette silhouette) const;
  /// A mask or picture in the image's size: every pixel as its block is.
  cv::Mat back(const cv::Mat& small) const;
  /// Pictures of what was seen in the smaller image, in the image's size.
  std::vector<Picture> back(std::vector<Picture> pictures) const;

 private:
  int times_;
};

/// The parameter "shrink" of a modality.
template <class Options>
void declare_shrink(Parameters<Options>& parameters, int Options::*shrink) {
  parameters.value("shrink", shrink)
      .at_least(1)
      .at_most(Shrink::kMost)
      .meaning(
          "how many times smaller images are looked at along both axes, each pixel the mean of a "
          "block; lengths in pixels are those of the smaller image")
      .source("thesis 4.4.5");
}

}  // namespace plaza
