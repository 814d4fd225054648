// The last layers of YOLOv8 and YOLOv5, operator by operator as their exporters write them
// (simplified, operator set 12), on random features: OpenCV has to be able to run them, and
// rightly.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plugins/detectors/onnx/head.h"
#include "plugins/detectors/onnx/network.h"
#include "tests/support/onnx_writer.h"

namespace plaza {
namespace {

constexpr int kSize = 64;  // of the input, px
constexpr int kClasses = 2;
const std::vector<int> kStrides = {8, 16, 32};

/// One scale of a network without a trunk: a convolution makes its features from the image.
struct Scale {
  int stride = 0;
  int cells = 0;  // in a row
  std::vector<float> weights, bias;
};

class ExportedHead {
 public:
  explicit ExportedHead(int features) : features_(features), model_({1, 3, kSize, kSize}) {
    std::mt19937 random(7);
    const auto uniform = [&](std::size_t count, float range) {
      std::vector<float> values(count);
      for (float& v : values) {
        v = range * (static_cast<float>(random() % 20001) / 10000.F - 1);
      }
      return values;
    };
    for (const int stride : kStrides) {
      Scale scale{.stride = stride, .cells = kSize / stride, .weights = {}, .bias = {}};
      const auto pixels = static_cast<std::size_t>(3 * stride * stride);
      scale.weights =
          uniform(static_cast<std::size_t>(features) * pixels, 0.5F / static_cast<float>(stride));
      scale.bias = uniform(static_cast<std::size_t>(features), 0.5F);
      const std::string s = std::to_string(stride);
      model_.real("w" + s, {features, 3, stride, stride}, scale.weights);
      model_.real("b" + s, {features}, scale.bias);
      model_.node("Conv", {"images", "w" + s, "b" + s}, "features" + s,
                  {{"kernel_shape", {stride, stride}}, {"strides", {stride, stride}}});
      scales_.push_back(std::move(scale));
    }
    input_.create({1, 3, kSize, kSize}, CV_32F);
    const std::vector<float> values = uniform(input_.total(), 1);
    std::copy(values.begin(), values.end(), input_.ptr<float>());
  }

  void slice(const std::string& from, const std::string& to, int begin, int end, int axis) {
    model_.whole(to + "_begin", {begin});
    model_.whole(to + "_end", {end});
    model_.whole(to + "_axis", {axis});
    model_.node("Slice", {from, to + "_begin", to + "_end", to + "_axis"}, to);
  }
  void reshape(const std::string& from, const std::string& to,
               const std::vector<std::int64_t>& shape) {
    model_.whole(to + "_shape", shape);
    model_.node("Reshape", {from, to + "_shape"}, to);
  }

  /// A feature of a cell, from the definition of a convolution.
  double feature(const Scale& scale, int index, int row, int column) const {
    double sum = scale.bias[static_cast<std::size_t>(index)];
    const int s = scale.stride;
    for (int channel = 0; channel < 3; ++channel) {
      for (int v = 0; v < s; ++v) {
        for (int u = 0; u < s; ++u) {
          const auto weight = static_cast<std::size_t>(((index * 3 + channel) * s + v) * s + u);
          sum += static_cast<double>(scale.weights[weight]) *
                 input_.ptr<float>(0, channel, row * s + v)[column * s + u];
        }
      }
    }
    return sum;
  }

  cv::Mat run(const TensorShape& expected) const {
    const Network network("head.onnx", model_.bytes(), {1, 3, kSize, kSize}, 1);
    const auto outputs = network.outputs();
    EXPECT_EQ(outputs.size(), 1U);
    EXPECT_EQ(outputs.at(0).shape, expected);
    return network.run(input_, outputs.at(0).name);
  }

  int features_;
  test::OnnxWriter model_;
  std::vector<Scale> scales_;
  cv::Mat input_;
};

double sigmoid(double x) { return 1 / (1 + std::exp(-x)); }

TEST(ExportedHeads, OfYolov8AreRunRightly) {
  constexpr int kBins = 16;
  ExportedHead head(4 * kBins + kClasses);
  test::OnnxWriter& model = head.model_;
  std::vector<std::string> parts;
  std::vector<float> x, y, strides;
  for (const Scale& scale : head.scales_) {
    const std::string s = std::to_string(scale.stride);
    head.reshape("features" + s, "row" + s, {1, 4 * kBins + kClasses, -1});
    parts.push_back("row" + s);
    for (int cell = 0; cell < scale.cells * scale.cells; ++cell) {
      x.push_back(static_cast<float>(cell % scale.cells) + 0.5F);
      y.push_back(static_cast<float>(cell / scale.cells) + 0.5F);
      strides.push_back(static_cast<float>(scale.stride));
    }
  }
  const auto count = static_cast<int>(x.size());
  model.node("Concat", parts, "rows", {{"axis", {2}, true}});
  head.slice("rows", "distances", 0, 4 * kBins, 1);
  head.slice("rows", "classes", 4 * kBins, 4 * kBins + kClasses, 1);
  // the mean of a softmax over bins, by a convolution with 0, 1, 2, ...
  head.reshape("distances", "bins", {1, 4, kBins, count});
  model.node("Transpose", {"bins"}, "bins_last", {{"perm", {0, 3, 1, 2}}});
  model.node("Softmax", {"bins_last"}, "shares_last", {{"axis", {3}, true}});
  model.node("Transpose", {"shares_last"}, "shares", {{"perm", {0, 3, 2, 1}}});
  std::vector<float> numbers(kBins);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<float>(i);
  model.real("numbers", {1, kBins, 1, 1}, numbers);
  model.node("Conv", {"shares", "numbers"}, "means", {{"kernel_shape", {1, 1}}});
  head.reshape("means", "sides", {1, 4, count});
  head.slice("sides", "left_top", 0, 2, 1);
  head.slice("sides", "right_bottom", 2, 4, 1);
  std::vector<float> anchors = x;
  anchors.insert(anchors.end(), y.begin(), y.end());
  model.real("anchors", {1, 2, count}, anchors);
  model.node("Sub", {"anchors", "left_top"}, "first");
  model.node("Add", {"anchors", "right_bottom"}, "second");
  model.node("Add", {"first", "second"}, "sum");
  model.real("two", {}, {2});
  model.node("Div", {"sum", "two"}, "centre");
  model.node("Sub", {"second", "first"}, "size");
  model.node("Concat", {"centre", "size"}, "boxes", {{"axis", {1}, true}});
  model.real("strides", {1, count}, strides);
  model.node("Mul", {"boxes", "strides"}, "boxes_px");
  model.node("Sigmoid", {"classes"}, "scores");
  model.node("Concat", {"boxes_px", "scores"}, "output0", {{"axis", {1}, true}});
  model.output("output0", {1, 4 + kClasses, count});

  const cv::Mat output = head.run({1, 4 + kClasses, count});
  EXPECT_EQ(head_of(shape_of(output)), Head::kYolov8);
  int box = 0;
  for (const Scale& scale : head.scales_) {
    for (int row = 0; row < scale.cells; ++row) {
      for (int column = 0; column < scale.cells; ++column, ++box) {
        std::array<double, 4> sides{};
        for (int side = 0; side < 4; ++side) {
          double sum = 0, weighted = 0;
          for (int bin = 0; bin < kBins; ++bin) {
            const double e = std::exp(head.feature(scale, side * kBins + bin, row, column));
            sum += e;
            weighted += bin * e;
          }
          sides[static_cast<std::size_t>(side)] = weighted / sum;
        }
        const auto value = [&](int v) { return output.ptr<float>(0, v)[box]; };
        EXPECT_NEAR(value(0), scale.stride * (column + 0.5 + (sides[2] - sides[0]) / 2), 1e-3);
        EXPECT_NEAR(value(1), scale.stride * (row + 0.5 + (sides[3] - sides[1]) / 2), 1e-3);
        EXPECT_NEAR(value(2), scale.stride * (sides[0] + sides[2]), 1e-3);
        EXPECT_NEAR(value(3), scale.stride * (sides[1] + sides[3]), 1e-3);
        for (int c = 0; c < kClasses; ++c) {
          EXPECT_NEAR(value(4 + c), sigmoid(head.feature(scale, 4 * kBins + c, row, column)), 1e-5);
        }
      }
    }
  }
  EXPECT_EQ(box, count);
}

TEST(ExportedHeads, OfYolov5AreRunRightly) {
  constexpr int kAnchors = 3, kValues = 5 + kClasses;
  const auto anchor = [](int stride, int index, bool wide) {
    return static_cast<float>(stride * (index + 1) + (wide ? 1 : 3));
  };
  ExportedHead head(kAnchors * kValues);
  test::OnnxWriter& model = head.model_;
  std::vector<std::string> parts;
  std::int64_t count = 0;
  for (const Scale& scale : head.scales_) {
    const std::string s = std::to_string(scale.stride);
    const std::int64_t cells = scale.cells;
    head.reshape("features" + s, "split" + s, {1, kAnchors, kValues, cells, cells});
    model.node("Transpose", {"split" + s}, "last" + s, {{"perm", {0, 1, 3, 4, 2}}});
    model.node("Sigmoid", {"last" + s}, "all" + s);
    head.slice("all" + s, "xy" + s, 0, 2, 4);
    head.slice("all" + s, "wh" + s, 2, 4, 4);
    head.slice("all" + s, "scores" + s, 4, kValues, 4);
    std::vector<float> grid, anchors;
    for (int a = 0; a < kAnchors; ++a) {
      for (int cell = 0; cell < cells * cells; ++cell) {
        grid.push_back(static_cast<float>(cell % scale.cells) - 0.5F);
        grid.push_back(static_cast<float>(cell / scale.cells) - 0.5F);
        anchors.push_back(anchor(scale.stride, a, true));
        anchors.push_back(anchor(scale.stride, a, false));
      }
    }
    model.real("two" + s, {}, {2});
    model.real("stride" + s, {}, {static_cast<float>(scale.stride)});
    model.real("grid" + s, {1, kAnchors, cells, cells, 2}, grid);
    model.real("anchors" + s, {1, kAnchors, cells, cells, 2}, anchors);
    model.node("Mul", {"xy" + s, "two" + s}, "xy2" + s);
    model.node("Add", {"xy2" + s, "grid" + s}, "xy3" + s);
    model.node("Mul", {"xy3" + s, "stride" + s}, "centre" + s);
    model.node("Mul", {"wh" + s, "two" + s}, "wh2" + s);
    model.node("Pow", {"wh2" + s, "two" + s}, "wh3" + s);
    model.node("Mul", {"wh3" + s, "anchors" + s}, "size" + s);
    model.node("Concat", {"centre" + s, "size" + s, "scores" + s}, "boxes" + s,
               {{"axis", {4}, true}});
    head.reshape("boxes" + s, "rows" + s, {1, kAnchors * cells * cells, kValues});
    parts.push_back("rows" + s);
    count += kAnchors * cells * cells;
  }
  model.node("Concat", parts, "output0", {{"axis", {1}, true}});
  model.output("output0", {1, count, kValues});

  const cv::Mat output = head.run({1, static_cast<int>(count), kValues});
  EXPECT_EQ(head_of(shape_of(output)), Head::kYolov5);
  int box = 0;
  for (const Scale& scale : head.scales_) {
    for (int a = 0; a < kAnchors; ++a) {
      for (int cell = 0; cell < scale.cells * scale.cells; ++cell, ++box) {
        const int row = cell / scale.cells, column = cell % scale.cells;
        const auto of = [&](int v) {
          return sigmoid(head.feature(scale, a * kValues + v, row, column));
        };
        const float* values = output.ptr<float>(0, box);
        EXPECT_NEAR(values[0], scale.stride * (2 * of(0) + column - 0.5), 1e-3);
        EXPECT_NEAR(values[1], scale.stride * (2 * of(1) + row - 0.5), 1e-3);
        EXPECT_NEAR(values[2], 4 * of(2) * of(2) * anchor(scale.stride, a, true), 1e-3);
        EXPECT_NEAR(values[3], 4 * of(3) * of(3) * anchor(scale.stride, a, false), 1e-3);
        for (int v = 4; v < kValues; ++v) EXPECT_NEAR(values[v], of(v), 1e-5);
      }
    }
  }
  EXPECT_EQ(box, count);
}

}  // namespace
}  // namespace plaza
