#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "tests/bench/taught_clip.h"

namespace plaza::bench {

/// The frames that a ScaledLaboratory has: five runs of three, far apart, so that what remembers
/// the frame before has one.
inline constexpr Chosen kScaledFrames = {.every = 100, .run = 3};

/// What of the laboratory a pipeline sees.
struct LaboratoryPart {
  int width_px = 752;       ///< of every view; the height in proportion, 480 of 752
  std::size_t cameras = 4;  ///< of pipelines/scenes/lab.json, one after the other
  std::size_t first = 0;    ///< of them; after the last one comes the first one
};

/// The laboratory's four-crossing, seed 1, rendered once and kept as files, from which parts and
/// smaller images are taken: what a detector costs can be compared over them without anything else
/// in the world being different.
class ScaledLaboratory {
 public:
  /// Renders; takes half a minute of processor time.
  ScaledLaboratory();
  ~ScaledLaboratory();
  ScaledLaboratory(const ScaledLaboratory&) = delete;
  ScaledLaboratory& operator=(const ScaledLaboratory&) = delete;

  /// A pipeline file that runs modalities and detector of `pipeline`, a file below pipelines/, on
  /// that part. It lives as long as this.
  std::filesystem::path pipeline(const std::string& pipeline, const LaboratoryPart& part);

 private:
  struct Image {
    std::string file;  ///< "CAMERA/NUMBER", below a folder of frames or of people-free images
    cv::Mat pixels;
  };
  /// The folder with all images in that width, written when first asked for.
  std::filesystem::path images(int width_px);
  std::filesystem::path scene(const LaboratoryPart& part) const;

  std::filesystem::path folder_;
  std::vector<std::string> cameras_;
  std::vector<Image> images_;  ///< of full size
};

}  // namespace plaza::bench
