#include "plugins/detectors/onnx/onnx_detector.h"

#include <string_view>
#include <utility>

#include "plaza/core/error.h"
#include "plugins/detectors/common/box_views.h"
#include "plugins/detectors/onnx/model_file.h"

namespace plaza {
namespace {

/// Width and height of an input at most; more is a damaged file or a slip, and would take
/// gigabytes.
constexpr int kMostPixels = 8192;

TensorShape as_tensor_shape(const std::vector<std::int64_t>& shape) {
  TensorShape out;
  for (const std::int64_t size : shape) out.push_back(static_cast<int>(size));
  return out;
}

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// OpenCV keeps the file's name of an output, or puts a mark of its own before it.
std::string_view plain_name(std::string_view name) {
  constexpr std::string_view kMark = "onnx_node!";
  if (name.starts_with(kMark)) name.remove_prefix(kMark.size());
  return name;
}

std::string listed(const std::vector<Network::Output>& outputs) {
  std::string text;
  for (const Network::Output& output : outputs) {
    text += (text.empty() ? "\"" : ", \"") + std::string(plain_name(output.name)) + "\" " +
            to_string(output.shape);
  }
  return text;
}

}  // namespace

OnnxDetector::Options::Options() {
  min_score = 0.25;
  nms_overlap = 0.45;
}

Declaration<OnnxDetector::Options> OnnxDetector::declare() {
  Parameters<Options> p;
  p.value("model", &Options::model)
      .required()
      .meaning("the network, an ONNX file; Plaza ships none");
  p.choice("head", &Options::head, {"auto", "yolov8", "yolov5", "ssd"})
      .meaning(
          "what the output means: YOLOv8's [1, 4 + classes, boxes], YOLOv5's [1, boxes, 5 + "
          "classes], or SSD's [1, 1, boxes, 7]; auto: told from its shape")
      .source("ultralytics' YOLOv5 and YOLOv8; W. Liu et al., SSD, ECCV 2016");
  p.value("output", &Options::output)
      .meaning("name of the output to read; not set: the only one that the head fits");
  p.value("input_size", &Options::input_size)
      .unit("px")
      .items(2, 2)
      .at_least(1)
      .at_most(kMostPixels)
      .meaning("width and height of the network's input; not set: as the model declares it");
  p.choice("fit", &Options::fit, {"letterbox", "stretch"})
      .meaning("images keep their proportions, with padding around them, or fill the input");
  p.value("padding", &Options::padding)
      .at_least(0)
      .at_most(255)
      .meaning("value of the pixels around a letterboxed image");
  p.choice("channels", &Options::channels, {"rgb", "bgr"})
      .meaning("order of colours that the network was trained with");
  p.value("scale", &Options::scale)
      .above(0)
      .meaning("the network sees (value - mean) x scale / deviation of values of 0 to 255");
  p.value("mean", &Options::mean)
      .items(3, 3)
      .meaning("per channel, in the network's order, of values of 0 to 255");
  p.value("deviation", &Options::deviation)
      .items(3, 3)
      .above(0)
      .meaning("per channel, in the network's order, of scaled values");
  p.value("person_class", &Options::person_class)
      .at_least(0)
      .meaning("index of the class of people; not set: COCO's, 0 in YOLO's heads and 1 in SSD's");
  p.value("copies", &Options::copies)
      .at_least(0)
      .meaning(
          "most copies of the network in memory, each of which works on one image at a time; 0: as "
          "many as there are threads");
  add_box_ground_parameters(p);
  Declaration<Options> d("onnx",
                         "Finds people by a detection network from an ONNX file, run by OpenCV.");
  return d.source("OpenCV DNN; docs/onnx.md")
      .input<FrameSet>("images of all views")
      .output<Observations>("one observation per box, with that view's box")
      .parameters(std::move(p));
}

OnnxDetector::OnnxDetector(const Options& options, const BuildContext& context)
    : options_(options),
      scene_(context.scene),
      ground_(options, context.scene),
      values_(options.scale, options.mean, options.deviation) {}

const OnnxDetector::Loaded& OnnxDetector::loaded() const {
  const std::lock_guard lock(mutex_);
  if (!loaded_) loaded_ = load();
  return *loaded_;
}

OnnxDetector::Loaded OnnxDetector::load() const {
  std::string bytes = read_model_file(options_.model);
  Loaded loaded;
  loaded.input = input_size(bytes);
  loaded.network = std::make_unique<Network>(
      options_.model, std::move(bytes), TensorShape{1, 3, loaded.input.height, loaded.input.width},
      options_.copies);
  choose_output(loaded);
  return loaded;
}

cv::Size OnnxDetector::input_size(const std::string& bytes) const {
  const std::string model = options_.model.string();
  const auto inputs = declared_inputs(bytes);
  if (!inputs) {
    throw UserError(
        fault_at("/model", model + " is no ONNX model, or was cut off; copy or export it again"));
  }
  if (inputs->size() != 1) {
    throw UserError(fault_at(
        "/model", model + " has " + std::to_string(inputs->size()) +
                      " inputs; a detection network has one, an image [1, 3, height, width]"));
  }
  const std::vector<std::int64_t>& shape = inputs->front().shape;
  const auto fits = [&](std::size_t i, std::int64_t size) {
    return shape[i] < 0 || shape[i] == size;
  };
  if (shape.size() != 4 || !fits(0, 1) || !fits(1, 3)) {
    throw UserError(
        fault_at("/model", model + " takes " + to_string(as_tensor_shape(shape)) +
                               "; a detection network takes one image of three channels, [1, 3, "
                               "height, width]: export it for a batch of one, channels first"));
  }
  if (shape[2] > kMostPixels || shape[3] > kMostPixels) {
    throw UserError(fault_at(
        "/model", model + " takes images of " + std::to_string(shape[3]) + "x" +
                      std::to_string(shape[2]) + "; at most " + std::to_string(kMostPixels) +
                      " pixels a side are possible: it is damaged, or export a smaller one"));
  }
  const cv::Size declared(static_cast<int>(shape[3]), static_cast<int>(shape[2]));
  if (!options_.input_size) {
    if (declared.width < 0 || declared.height < 0) {
      throw UserError(fault_at(
          "/input_size", model + " leaves the size of its input open; say which, best the one that "
                                 "it was trained for, such as [640, 640]"));
    }
    return declared;
  }
  const cv::Size wanted(options_.input_size->at(0), options_.input_size->at(1));
  if (!fits(3, wanted.width) || !fits(2, wanted.height)) {
    throw UserError(fault_at("/input_size",
                             model + " takes images of " + size_text(declared) + ", not " +
                                 size_text(wanted) +
                                 "; leave \"input_size\" out, or export the model for that size"));
  }
  return wanted;
}

int OnnxDetector::person_class(Head head) const {
  return options_.person_class.value_or(head == Head::kSsd ? 1 : 0);
}

void OnnxDetector::choose_output(Loaded& loaded) const {
  const auto outputs = loaded.network->outputs();
  const std::string model = options_.model.string();
  std::vector<std::pair<const Network::Output*, Head>> fitting;
  std::string faults;
  bool named = false;
  for (const Network::Output& output : outputs) {
    if (options_.output && plain_name(output.name) != plain_name(*options_.output)) continue;
    named = true;
    const Head head =
        options_.head == Head::kAuto ? head_of(output.shape).value_or(Head::kAuto) : options_.head;
    const std::string fault =
        head == Head::kAuto
            ? to_string(output.shape) + ", which is not clearly one of " + expected_shape(head)
            : shape_fault(head, output.shape, person_class(head));
    if (fault.empty()) {
      fitting.emplace_back(&output, head);
    } else {
      faults += "; output \"" + std::string(plain_name(output.name)) + "\" is " + fault;
    }
  }
  if (!named) {
    throw UserError(fault_at("/output", model + " has no output \"" + options_.output.value_or("") +
                                            "\"; it has " + listed(outputs)));
  }
  if (fitting.empty()) {
    throw UserError(fault_at(
        "/head", model + " has no output to read" + faults +
                     "; say by \"head\" and \"person_class\" what the model gives, or export it "
                     "with one of these heads (docs/onnx.md)"));
  }
  if (fitting.size() > 1) {
    throw UserError(fault_at("/output", model + " has several outputs that fit: " +
                                            listed(outputs) + "; name one of them"));
  }
  loaded.output = fitting.front().first->name;
  loaded.head = fitting.front().second;
  loaded.person_class = person_class(loaded.head);
}

Diagnostics OnnxDetector::do_check() const {
  try {
    loaded();
  } catch (const UserError& error) {
    return error.diagnostics();
  }
  return {};
}

std::vector<ImageDetection> OnnxDetector::detect_boxes(const cv::Mat& image) const {
  const Loaded& model = loaded();
  const cv::Mat input = network_input(image, {.size = model.input,
                                              .fit = options_.fit,
                                              .rgb = options_.channels == Channels::kRgb,
                                              .padding = options_.padding,
                                              .values = values_});
  const cv::Mat output = model.network->run(input, model.output);
  const ImagePlace place(image.size(), model.input, options_.fit);
  std::vector<ImageDetection> found;
  for (const NetworkBox& box :
       people_in(model.head, output, model.input, model.person_class, options_.min_score)) {
    found.push_back(
        {.box = place.in_image(box.left, box.top, box.right, box.bottom), .score = box.score});
  }
  return found;
}

Observations OnnxDetector::do_detect(const NodeIo& io) const {
  return observe_views(io.in<FrameSet>(0), *scene_, ground_,
                       [this](std::size_t, const cv::Mat& image) { return detect_boxes(image); });
}

}  // namespace plaza
