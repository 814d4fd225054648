#include "modalities/color/opencl_segmenter.h"

#include <opencv2/core/ocl.hpp>
#include <utility>

#include "modalities/color/opencl_program.h"
#include "plaza/core/error.h"

namespace plaza::color {
namespace {

class OpenclSegmenter final : public Segmenter {
 public:
  OpenclSegmenter(const Background& background, const Criterion& criterion,
                  const LabelFieldOptions& options)
      : options_(options), steps_(options) {
    background.image.copyTo(background_);
    criterion.energy().copyTo(energy_);
    criterion.weight().copyTo(weight_);
    cv::String log;
    program_ = cv::ocl::Program(cv::ocl::ProgramSource(kOpenclProgram), "", log);
    if (program_.ptr() == nullptr) {
      throw UserError("the OpenCL device '" + opencl_device() + "' refuses the program: " + log);
    }
  }

  Segmentation segment(const cv::Mat& image, const cv::Mat& previous) const override {
    const cv::Size size = energy_.size();
    cv::UMat input;
    image.copyTo(input);
    cv::UMat strength(size, CV_16UC1);
    run("strength", size, input, background_, energy_, weight_,
        cv::ocl::KernelArg::WriteOnly(strength));
    cv::UMat threshold(size, CV_16UC1);
    if (previous.empty()) {
      threshold.setTo(cv::Scalar(steps_.start(false)));
    } else {
      cv::UMat mask;
      previous.copyTo(mask);
      run("threshold", size, mask, cv::ocl::KernelArg::WriteOnly(threshold),
          int{steps_.start(true)}, int{steps_.previous});
    }
    cv::UMat now(size, CV_8UC1);
    cv::UMat next(size, CV_8UC1, cv::Scalar(0));
    // no look at whether labels still change: to ask costs more than a round, and rounds after the
    // last change do nothing
    for (int i = 0; i <= options_.iterations; ++i) {
      run("label", size, strength, threshold, next, cv::ocl::KernelArg::WriteOnly(now),
          int{steps_.neighbourhood}, i == 0 ? 1 : 0);
      std::swap(now, next);
    }
    Segmentation result;
    strength.copyTo(result.strength);
    next.copyTo(result.mask);
    return result;
  }

 private:
  static cv::ocl::KernelArg argument(const cv::UMat& matrix) {
    return cv::ocl::KernelArg::ReadOnlyNoSize(matrix);
  }
  static cv::ocl::KernelArg argument(const cv::ocl::KernelArg& argument) { return argument; }
  static int argument(int value) { return value; }

  template <class... Args>
  void run(const char* name, cv::Size size, const Args&... args) const {
    cv::ocl::Kernel kernel(name, program_);  // holds its arguments: one per call
    kernel.args(argument(args)...);
    std::size_t global[2] = {static_cast<std::size_t>(size.width),
                             static_cast<std::size_t>(size.height)};
    if (!kernel.run(2, global, nullptr, false)) {
      throw InternalError("OpenCL kernel '" + std::string(name) + "' failed on '" +
                          opencl_device() + "'");
    }
  }

  LabelFieldOptions options_;
  LabelFieldSteps steps_;
  cv::UMat background_, energy_, weight_;
  cv::ocl::Program program_;
};

}  // namespace

std::string opencl_device() {
  if (!cv::ocl::haveOpenCL()) return {};
  const cv::ocl::Device& device = cv::ocl::Device::getDefault();
  return device.ptr() != nullptr && device.available() ? device.name() : std::string();
}

std::unique_ptr<Segmenter> make_opencl_segmenter(const Background& background,
                                                 const Criterion& criterion,
                                                 const LabelFieldOptions& options) {
  if (opencl_device().empty()) {
    throw UserError(
        "there is no OpenCL device: install a driver (on Debian pocl-opencl-icd runs on any "
        "processor, with OPENCV_OPENCL_DEVICE=:CPU:) or leave \"device\" at \"cpu\"");
  }
  return std::make_unique<OpenclSegmenter>(background, criterion, options);
}

}  // namespace plaza::color
