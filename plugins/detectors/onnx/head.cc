#include "plugins/detectors/onnx/head.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "plaza/core/error.h"

namespace plaza {
namespace {

// What a sigmoid or softmax in floats may miss its range by.
constexpr float kRounding = 1e-3F;

/// Values per box of an output in one of the YOLO heads' layouts, and how far apart they are.
struct Layout {
  const float* data = nullptr;
  int boxes = 0;
  int values = 0;
  std::ptrdiff_t box_step = 0;
  std::ptrdiff_t value_step = 0;

  float at(int box, int value) const { return data[box * box_step + value * value_step]; }
};

Layout layout_of(Head head, const cv::Mat& output) {
  Layout out;
  out.data = output.ptr<float>();
  if (head == Head::kYolov8) {
    out.values = output.size[1];
    out.boxes = output.size[2];
    out.box_step = 1;
    out.value_step = out.boxes;
  } else {
    out.boxes = output.size[head == Head::kSsd ? 2 : 1];
    out.values = output.size[head == Head::kSsd ? 3 : 2];
    out.box_step = out.values;
    out.value_step = 1;
  }
  return out;
}

float checked_score(float score, const char* what, int box) {
  if (score >= -kRounding && score <= 1 + kRounding) return score;
  std::ostringstream message;
  message << "the network gives " << what << " of " << score << " (box " << box
          << "), which is no score between 0 and 1: export it with its last sigmoid or softmax, "
             "and see whether \"head\" is the right one";
  throw UserError(message.str());
}

void require_finite(const cv::Mat& output) {
  const float* values = output.ptr<float>();
  const auto bad =
      std::find_if(values, values + output.total(), [](float v) { return !std::isfinite(v); });
  if (bad == values + output.total()) return;
  std::ostringstream message;
  message << "the network gives " << *bad << " as value " << bad - values << " of its output "
          << to_string(shape_of(output))
          << ": its weights are damaged, or \"scale\", \"mean\" and \"deviation\" are far from "
             "those it was trained with";
  throw UserError(message.str());
}

std::vector<NetworkBox> yolo_people(Head head, const Layout& layout, int person_class,
                                    double min_score) {
  const bool with_objectness = head == Head::kYolov5;
  const int first = with_objectness ? 5 : 4;
  std::vector<NetworkBox> people;
  for (int box = 0; box < layout.boxes; ++box) {
    const float own =
        checked_score(layout.at(box, first + person_class), "a score of a class", box);
    double score = own;
    if (with_objectness) score *= checked_score(layout.at(box, 4), "an objectness", box);
    if (score < min_score) continue;
    bool best = true;
    for (int value = first; value < layout.values && best; ++value) {
      best = layout.at(box, value) <= own;
    }
    if (!best) continue;
    const double x = layout.at(box, 0), y = layout.at(box, 1);
    const double half_width = 0.5 * layout.at(box, 2), half_height = 0.5 * layout.at(box, 3);
    people.push_back({.left = x - half_width,
                      .top = y - half_height,
                      .right = x + half_width,
                      .bottom = y + half_height,
                      .score = score});
  }
  return people;
}

std::vector<NetworkBox> ssd_people(const Layout& layout, cv::Size input, int person_class,
                                   double min_score) {
  std::vector<NetworkBox> people;
  for (int box = 0; box < layout.boxes; ++box) {
    // rows that only fill the tensor up have image -1
    if (layout.at(box, 0) < 0 || layout.at(box, 1) != static_cast<float>(person_class)) continue;
    const float score = checked_score(layout.at(box, 2), "a score", box);
    if (score < min_score) continue;
    people.push_back({.left = layout.at(box, 3) * static_cast<double>(input.width),
                      .top = layout.at(box, 4) * static_cast<double>(input.height),
                      .right = layout.at(box, 5) * static_cast<double>(input.width),
                      .bottom = layout.at(box, 6) * static_cast<double>(input.height),
                      .score = score});
  }
  return people;
}

const char* name_of(Head head) {
  switch (head) {
    case Head::kYolov8:
      return "yolov8";
    case Head::kYolov5:
      return "yolov5";
    case Head::kSsd:
      return "ssd";
    case Head::kAuto:
      break;
  }
  return "auto";
}

}  // namespace

std::string to_string(const TensorShape& shape) {
  std::string text = "[";
  for (const int size : shape) {
    text += (text.size() > 1 ? ", " : "") + (size < 0 ? std::string("?") : std::to_string(size));
  }
  return text + "]";
}

TensorShape shape_of(const cv::Mat& tensor) { return {tensor.size.p, tensor.size.p + tensor.dims}; }

std::optional<Head> head_of(const TensorShape& shape) {
  std::optional<Head> fitting;
  for (const Head head : {Head::kSsd, Head::kYolov8, Head::kYolov5}) {
    if (!shape_fault(head, shape, 0).empty()) continue;
    if (fitting || (head == Head::kYolov5 && shape.back() == 6)) return std::nullopt;
    fitting = head;
  }
  return fitting;
}

std::string expected_shape(Head head) {
  switch (head) {
    case Head::kYolov8:
      return "[1, 4 + classes, boxes]";
    case Head::kYolov5:
      return "[1, boxes, 5 + classes]";
    case Head::kSsd:
      return "[1, 1, boxes, 7]";
    case Head::kAuto:
      break;
  }
  return expected_shape(Head::kYolov8) + ", " + expected_shape(Head::kYolov5) + " or " +
         expected_shape(Head::kSsd);
}

std::string shape_fault(Head head, const TensorShape& shape, int person_class) {
  const std::string found =
      to_string(shape) + " where head \"" + name_of(head) + "\" has " + expected_shape(head);
  if (head == Head::kSsd) {
    const bool fits = shape.size() == 4 && shape[0] == 1 && shape[1] == 1 && shape[3] == 7;
    return fits ? std::string() : found;
  }
  if (shape.size() != 3 || shape[0] != 1) return found;
  const bool transposed = head == Head::kYolov8;
  const int values = shape[transposed ? 1 : 2];
  const int boxes = shape[transposed ? 2 : 1];
  const int classes = values - (transposed ? 4 : 5);
  if (classes < 1) return found;
  if (boxes < values) {
    return found + ": " + std::to_string(boxes) + " boxes of " + std::to_string(values) +
           " values would be fewer boxes than values, so the two are the other way round";
  }
  if (person_class >= classes) {
    return found + ": it has " + std::to_string(classes) + (classes == 1 ? " class" : " classes") +
           ", so there is no class " + std::to_string(person_class) + " (they count from 0)";
  }
  return {};
}

std::vector<NetworkBox> people_in(Head head, const cv::Mat& output, cv::Size input,
                                  int person_class, double min_score) {
  require_finite(output);
  const Layout layout = layout_of(head, output);
  if (head == Head::kSsd) return ssd_people(layout, input, person_class, min_score);
  return yolo_people(head, layout, person_class, min_score);
}

}  // namespace plaza
