#pragma once

#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <opencv2/dnn.hpp>
#include <optional>
#include <string>
#include <vector>

#include "plugins/detectors/onnx/head.h"

namespace plaza {

/// A network in OpenCV, for any number of threads.
///
/// A cv::dnn::Net computes one image at a time. So there are as many of them, each with weights and
/// buffers of its own, as images are worked on at once; which of them computes an image makes no
/// difference.
class Network {
 public:
  /// Reads a model that will see inputs of this shape. `most_copies` nets at once, 0: no limit;
  /// threads beyond it wait. Throws UserError at "/model" when OpenCV can't read it, with OpenCV's
  /// own words.
  Network(std::filesystem::path file, std::string bytes, TensorShape input, int most_copies);
  ~Network();

  struct Output {
    std::string name;
    TensorShape shape;
  };
  /// All outputs: the network is run once. Throws UserError at "/input_size" when it can't be run
  /// on such an input, with OpenCV's own words.
  std::vector<Output> outputs() const;

  /// One output for an input of floats, as floats. The output's memory is its own.
  cv::Mat run(const cv::Mat& input, const std::string& output) const;

 private:
  class Borrowed;
  cv::dnn::Net read() const;

  std::filesystem::path file_;
  std::string bytes_;
  TensorShape input_;
  int most_copies_;
  mutable std::mutex mutex_;
  mutable std::condition_variable given_back_;
  mutable std::vector<cv::dnn::Net> free_;
  mutable int copies_ = 0;
};

}  // namespace plaza
