#include "plugins/detectors/onnx/network.h"

#include <algorithm>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/core/version.hpp>
#include <utility>

#include "plaza/core/error.h"

namespace plaza {
namespace {

/// While it lives OpenCV writes nothing to the terminal: what it would say arrives as an exception,
/// too, and is reported at its place.
class QuietOpenCv {
 public:
  QuietOpenCv() : before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietOpenCv() { cv::utils::logging::setLogLevel(before_); }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  static std::mutex& turn() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_{turn()};  // the level is the whole process's
  cv::utils::logging::LogLevel before_;
};

/// OpenCV's message in one line.
std::string words_of(const cv::Exception& error) {
  std::string words;
  for (const char c : error.err.empty() ? std::string(error.what()) : error.err) {
    if (c != '\n') {
      words += c;
    } else if (!words.empty() && words.back() != ' ') {
      words += ' ';
    }
  }
  const auto first = words.find_first_not_of("> ");
  const auto last = words.find_last_not_of("> ");
  if (first == std::string::npos) return "nothing";
  return "\"" + words.substr(first, last - first + 1) + "\"";
}

/// Whether a layer of OpenCV's that multiplies by constants does so with this many: one for each
/// index of some dimensions that follow each other, the first of which is dimension 1.
bool covers_leading_dimensions(const TensorShape& shape, std::size_t factors) {
  std::size_t product = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) {
    product *= static_cast<std::size_t>(shape[i]);
    if (product == factors) return true;
  }
  return false;
}

/// Repeats factors that belong to the last of three dimensions, for each index of the one before.
/// ONNX does so by itself, OpenCV 4.6 can't, and the last step of YOLOv8's head, [1, 4, boxes]
/// times [1, boxes], needs it. What OpenCV can do is left alone; and a constant that has as many
/// elements as the last of three dimensions, but not as the one before, belongs to the last.
void spread_factors(cv::dnn::Net& net, const TensorShape& input) {
  std::vector<int> layers;
  std::vector<std::vector<TensorShape>> inputs, outputs;
  try {
    net.getLayersShapes(input, layers, inputs, outputs);
  } catch (const cv::Exception&) {
    return;  // it can't be run on such an input, either, and outputs() says why
  }
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const cv::Ptr<cv::dnn::Layer> layer = net.getLayer(layers[i]);
    if (layer->type != "Scale" || layer->blobs.empty() || inputs[i].size() != 1) continue;
    const TensorShape& shape = inputs[i][0];
    if (shape.size() != 3) continue;
    for (std::size_t b = 0; b < layer->blobs.size(); ++b) {
      const std::size_t factors = layer->blobs[b].total();
      if (covers_leading_dimensions(shape, factors)) continue;
      if (factors != static_cast<std::size_t>(shape[2])) continue;
      net.setParam(layers[i], static_cast<int>(b),
                   cv::repeat(layer->blobs[b].reshape(1, 1), 1, shape[1]));
    }
  }
}

}  // namespace

/// A net of the pool, for as long as it is needed; one more is made where all are in use.
class Network::Borrowed {
 public:
  explicit Borrowed(const Network& network) : network_(network) {
    std::unique_lock lock(network_.mutex_);
    network_.given_back_.wait(lock, [&] {
      return !network_.free_.empty() || network_.most_copies_ == 0 ||
             network_.copies_ < network_.most_copies_;
    });
    if (!network_.free_.empty()) {
      net_ = network_.free_.back();  // a handle
      network_.free_.pop_back();
      return;
    }
    ++network_.copies_;
    lock.unlock();
    try {
      net_ = network_.read();
    } catch (...) {
      lock.lock();
      --network_.copies_;
      network_.given_back_.notify_one();
      throw;
    }
  }
  ~Borrowed() {
    const std::lock_guard lock(network_.mutex_);
    network_.free_.push_back(net_);
    network_.given_back_.notify_one();
  }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;

  cv::dnn::Net& net() { return net_; }

 private:
  const Network& network_;
  cv::dnn::Net net_;
};

Network::Network(std::filesystem::path file, std::string bytes, TensorShape input, int most_copies)
    : file_(std::move(file)),
      bytes_(std::move(bytes)),
      input_(std::move(input)),
      most_copies_(most_copies) {
  const QuietOpenCv quiet;
  const Borrowed first(*this);
}

Network::~Network() = default;

cv::dnn::Net Network::read() const {
  try {
    cv::dnn::Net net = cv::dnn::readNetFromONNX(bytes_.data(), bytes_.size());
    // whatever the environment prefers: the same bytes everywhere, and no device that comes and
    // goes
    net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    spread_factors(net, input_);
    return net;
  } catch (const cv::Exception& error) {
    throw UserError(fault_at(
        "/model", "OpenCV " CV_VERSION " can't use " + file_.string() + ", it says " +
                      words_of(error) +
                      "; export the model again, simplified and with operator set 12, and without "
                      "suppression or other steps behind the network (docs/onnx.md)"));
  }
}

std::vector<Network::Output> Network::outputs() const {
  const QuietOpenCv quiet;
  Borrowed borrowed(*this);
  const std::vector<cv::String> names = borrowed.net().getUnconnectedOutLayersNames();
  std::vector<cv::Mat> tensors;
  try {
    borrowed.net().setInput(cv::Mat(input_, CV_32F, cv::Scalar(0)));
    borrowed.net().forward(tensors, names);
  } catch (const cv::Exception& error) {
    throw UserError(fault_at(
        "/input_size", "OpenCV " CV_VERSION " can't run " + file_.string() + " on an input of " +
                           to_string(input_) + ", it says " + words_of(error) +
                           "; give the size that the model was exported for, or export it again, "
                           "simplified and with operator set 12 (docs/onnx.md)"));
  }
  std::vector<Output> outputs;
  for (std::size_t i = 0; i < tensors.size(); ++i) {
    Output& output = outputs.emplace_back();
    output.name = names[i];
    output.shape = shape_of(tensors[i]);
  }
  return outputs;
}

cv::Mat Network::run(const cv::Mat& input, const std::string& output) const {
  Borrowed borrowed(*this);
  cv::Mat tensor;
  try {
    borrowed.net().setInput(input);
    tensor = borrowed.net().forward(output);
  } catch (const cv::Exception& error) {
    throw UserError("OpenCV " CV_VERSION " can't run " + file_.string() + ", it says " +
                    words_of(error));
  }
  cv::Mat own;
  tensor.convertTo(own, CV_32F);
  return own;
}

}  // namespace plaza
