#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plugins/detectors/common/box_ground.h"
#include "plugins/detectors/onnx/head.h"
#include "plugins/detectors/onnx/input_image.h"
#include "plugins/detectors/onnx/network.h"

namespace plaza {

/// People by a detection network that the user brings as an ONNX file, run by OpenCV on the
/// processor. Heads of YOLOv8, YOLOv5 and SSD.
class OnnxDetector final : public Detector {
 public:
  enum class Channels { kRgb, kBgr };
  struct Options : BoxGroundOptions {
    Options();
    std::filesystem::path model;
    Head head = Head::kAuto;
    std::optional<std::string> output;
    std::optional<std::vector<int>> input_size;
    ImageFit fit = ImageFit::kLetterbox;
    int padding = 114;
    Channels channels = Channels::kRgb;
    double scale = 1.0 / 255;
    std::vector<double> mean = {0, 0, 0};
    std::vector<double> deviation = {1, 1, 1};
    std::optional<int> person_class;
    int copies = 0;
  };
  static Declaration<Options> declare();
  OnnxDetector(const Options& options, const BuildContext& context);

  /// People's boxes in one image (8-bit BGR, of any size), in its pixels, before anything is
  /// suppressed; in the order of the network's output.
  std::vector<ImageDetection> detect_boxes(const cv::Mat& image) const;

 private:
  /// The model, read and understood.
  struct Loaded {
    std::unique_ptr<Network> network;
    cv::Size input;
    std::string output;
    Head head = Head::kAuto;
    int person_class = 0;
  };

  Diagnostics do_check() const override;
  Observations do_detect(const NodeIo& io) const override;

  /// Read by the first who asks; throws UserError as long as it can't be.
  const Loaded& loaded() const;
  Loaded load() const;
  cv::Size input_size(const std::string& bytes) const;
  void choose_output(Loaded& loaded) const;
  int person_class(Head head) const;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  BoxGround ground_;
  PixelValues values_;
  mutable std::mutex mutex_;
  mutable std::optional<Loaded> loaded_;
};

}  // namespace plaza
