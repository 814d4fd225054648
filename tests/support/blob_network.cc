#include "tests/support/blob_network.h"

#include "tests/support/onnx_writer.h"

namespace plaza::test {
namespace {

using Boxes = std::vector<std::array<double, 4>>;

/// Boxes of all cells: left, top, right, bottom.
Boxes boxes_of(const BlobNetwork& network) {
  Boxes boxes;
  const double size = network.cell;
  for (int y = 0; y < network.height; y += network.cell) {
    for (int x = 0; x < network.width; x += network.cell) {
      const auto own = network.boxes.find(static_cast<int>(boxes.size()));
      boxes.push_back(own == network.boxes.end()
                          ? std::array<double, 4>{1.0 * x, 1.0 * y, x + size, y + size}
                          : own->second);
    }
  }
  return boxes;
}

/// Centre, width and height; `by_box`: box after box, or value after value.
std::vector<float> centred(const Boxes& boxes, bool by_box) {
  std::vector<float> out(4 * boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto& [left, top, right, bottom] = boxes[i];
    const std::array<double, 4> values = {(left + right) / 2, (top + bottom) / 2, right - left,
                                          bottom - top};
    for (std::size_t v = 0; v < 4; ++v) {
      out[by_box ? 4 * i + v : v * boxes.size() + i] = static_cast<float>(values[v]);
    }
  }
  return out;
}

}  // namespace

int BlobNetwork::cell_at(double x, double y) const {
  return static_cast<int>(y / cell) * (width / cell) + static_cast<int>(x / cell);
}

std::string BlobNetwork::bytes() const {
  const Boxes all = boxes_of(*this);
  const auto cells = static_cast<std::int64_t>(all.size());
  std::vector<std::array<float, 3>> channels = classes;
  if (head == Head::kYolov5) channels.insert(channels.begin(), {1, -2, 1});
  const auto count = static_cast<std::int64_t>(channels.size());

  const auto pixels = static_cast<std::size_t>(cell * cell);
  std::vector<float> weights;
  for (const auto& channel : channels) {
    for (const float weight : channel) {
      weights.insert(weights.end(), pixels, gain * weight / static_cast<float>(pixels));
    }
  }
  OnnxWriter model({1, 3, open_size ? -1 : height, open_size ? -1 : width});
  model.real("weights", {count, 3, cell, cell}, weights);
  model.real("bias", {count}, std::vector<float>(channels.size(), bias));
  model.node("Conv", {"images", "weights", "bias"}, "raw",
             {{"kernel_shape", {cell, cell}}, {"strides", {cell, cell}}});
  if (sigmoid) model.node("Sigmoid", {"raw"}, "scores");
  const std::string scores = sigmoid ? "scores" : "raw";

  if (head == Head::kSsd) {
    std::vector<float> classes_of, corners;
    for (std::int64_t c = 0; c < count; ++c) {
      for (const auto& [left, top, right, bottom] : all) {
        classes_of.insert(classes_of.end(), {0, static_cast<float>(c + 1)});
        for (const double share : {left / width, top / height, right / width, bottom / height}) {
          corners.push_back(static_cast<float>(share));
        }
      }
    }
    const std::int64_t rows = count * cells;
    model.whole("shape", {1, 1, rows, 1});
    model.node("Reshape", {scores, "shape"}, "column");
    model.real("classes", {1, 1, rows, 2}, classes_of);
    model.real("boxes", {1, 1, rows, 4}, corners);
    model.node("Concat", {"classes", "column", "boxes"}, "detections", {{"axis", {3}, true}});
    model.output("detections", {1, 1, rows, 7});
    return model.bytes();
  }
  model.whole("shape", {1, count, cells});
  model.node("Reshape", {scores, "shape"}, "rows");
  if (head == Head::kYolov8) {
    model.real("boxes", {1, 4, cells}, centred(all, false));
    model.node("Concat", {"boxes", "rows"}, "detections", {{"axis", {1}, true}});
    model.output("detections", {1, 4 + count, cells});
  } else {
    model.node("Transpose", {"rows"}, "columns", {{"perm", {0, 2, 1}}});
    model.real("boxes", {1, cells, 4}, centred(all, true));
    model.node("Concat", {"boxes", "columns"}, "detections", {{"axis", {2}, true}});
    model.output("detections", {1, cells, 4 + count});
  }
  return model.bytes();
}

}  // namespace plaza::test
