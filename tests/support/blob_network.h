#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace plaza::test {

/// A detection network so small that one can say beforehand what it finds: it divides its input
/// into square cells, and what has a class's colour is an object of that class, one box per cell.
/// With m the mean over a cell of a class's weights times red, green, blue in [0, 1], the score is
/// sigmoid(gain x m + bias).
struct BlobNetwork {
  enum class Head { kYolov8, kYolov5, kSsd };

  Head head = Head::kYolov8;
  int width = 64, height = 64;  ///< of the input, px; multiples of `cell`
  int cell = 8;                 ///< px
  /// Weights of red, green and blue, by class. By default: red things, and blue things.
  std::vector<std::array<float, 3>> classes = {{1, 0, -1}, {-1, 0, 1}};
  float gain = 12;
  float bias = -6;
  /// Left, top, right, bottom in pixels of the input, by the cell's index (row by row); cells that
  /// are not named have boxes as large as themselves.
  std::map<int, std::array<double, 4>> boxes;
  bool open_size = false;  ///< the model does not say how large its input is
  bool sigmoid = true;     ///< or raw values in place of scores

  /// The index of the cell with this point of the input.
  int cell_at(double x, double y) const;
  /// The model's file. Classes count from 0, SSD's from 1, whose 0 is the background. YOLOv5's
  /// objectness is sigmoid(gain x (red - 2 green + blue) + bias).
  std::string bytes() const;
};

}  // namespace plaza::test
