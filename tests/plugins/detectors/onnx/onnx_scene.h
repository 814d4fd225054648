#pragma once

#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "plaza/data/frames.h"
#include "plugins/detectors/onnx/onnx_detector.h"
#include "tests/plugins/detectors/simulated_scene.h"
#include "tests/support/blob_network.h"
#include "tests/support/temporary_folder.h"

namespace plaza::testing {

inline const cv::Scalar kRed(0, 0, 255), kBlue(255, 0, 0), kGrey(120, 120, 120);

/// A street of one camera (640 x 480), or more.
inline std::shared_ptr<Scene> street(int cameras = 1) {
  auto scene = round_scene(cameras);
  scene->cameras[0] = looking_camera("street", {0, -11, 3.5}, {0, 0, 0.9});
  return scene;
}

/// Where images of 640 x 480 lie in the input of a network, as its boxes count: by hand, not by
/// what is under test. Letterboxed: half the size, 40 px below the top.
struct InputPlace {
  double x_scale = 0.5, y_scale = 0.5, top = 40;

  std::array<double, 4> of(const Box& box) const {
    const auto x = [&](double column) { return (column + 0.5) * x_scale; };
    const auto y = [&](double row) { return (row + 0.5) * y_scale + top; };
    return {x(box.left), y(box.top), x(box.right()), y(box.bottom())};
  }
  /// The pixels of the image under a cell of a network.
  cv::Rect image_of_cell(int index, const test::BlobNetwork& network) const {
    const int columns = network.width / network.cell;
    const double x = index % columns * network.cell, y = index / columns * network.cell - top;
    return {static_cast<int>(x / x_scale), static_cast<int>(y / y_scale),
            static_cast<int>(network.cell / x_scale), static_cast<int>(network.cell / y_scale)};
  }
};

/// Grey images in which coloured patches are people, and the network that sees them: the cell in
/// the middle of a person's box gives that box.
class Crowd {
 public:
  explicit Crowd(test::BlobNetwork::Head head = test::BlobNetwork::Head::kYolov8,
                 InputPlace place = {})
      : place_(place) {
    network.head = head;
    network.width = network.height = 320;
    network.cell = 10;
    image.create(480, 640, CV_8UC3);
    image.setTo(kGrey);
  }

  void add(const Box& box, const cv::Scalar& colour) {
    const auto at = place_.of(box);
    const int cell = network.cell_at((at[0] + at[2]) / 2, (at[1] + at[3]) / 2);
    network.boxes[cell] = at;
    image(place_.image_of_cell(cell, network)).setTo(colour);
  }

  test::BlobNetwork network;
  cv::Mat image;

 private:
  InputPlace place_;
};

inline std::shared_ptr<FrameSet> frame_of(std::vector<cv::Mat> views) {
  auto frame = std::make_shared<FrameSet>();
  frame->views = std::move(views);
  return frame;
}

}  // namespace plaza::testing
