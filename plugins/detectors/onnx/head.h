#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace plaza {

/// What a detection network's output means.
enum class Head {
  kAuto,    ///< to be told from the output's shape
  kYolov8,  ///< 1 x (4 + classes) x boxes: cx, cy, width, height, then a score per class
  kYolov5,  ///< 1 x boxes x (5 + classes): cx, cy, width, height, objectness, a score per class
  kSsd,  ///< 1 x 1 x boxes x 7: image, class, score, left, top, right, bottom, shares of the input
};

/// A tensor's sizes, outermost first.
using TensorShape = std::vector<int>;

/// "[1, 84, 8400]"; "?" for sizes below 0.
std::string to_string(const TensorShape& shape);

TensorShape shape_of(const cv::Mat& tensor);

/// The head that an output of this shape must be of; nothing when it fits none, or could be of
/// several. Networks have more boxes than values per box, which tells the two YOLO heads apart;
/// six values per box are one class of YOLOv5, or the corners, score and class of a network with
/// its own suppression, so they are told by nobody but the user.
std::optional<Head> head_of(const TensorShape& shape);

/// What the shape of this head's output should have been, as a text: "[1, 4 + classes, boxes]".
std::string expected_shape(Head head);

/// Why an output of this shape is none of this head's (not kAuto), or has no class
/// `person_class`; empty: it is.
std::string shape_fault(Head head, const TensorShape& shape, int person_class);

/// A box by its corners, in pixels of the network's input, counted from its corner.
struct NetworkBox {
  double left = 0, top = 0, right = 0, bottom = 0;
  double score = 0;
};

/// The boxes in an output that are people with a score of at least `min_score`, in the output's
/// order. A box with scores for several classes is a person's when no other class has a higher
/// one. YOLOv5's score is objectness times that of the class.
///
/// Throws UserError for values that are not finite and for scores outside [0, 1].
std::vector<NetworkBox> people_in(Head head, const cv::Mat& output, cv::Size input,
                                  int person_class, double min_score);

}  // namespace plaza
