#include "modalities/color/opencl_segmenter.h"

#include <utility>

#include "modalities/color/opencl_program.h"
#include "modalities/common/opencl.h"

namespace plaza::color {
namespace {

class OpenclSegmenter final : public Segmenter {
 public:
  OpenclSegmenter(const Background& background, const Criterion& criterion,
                  const LabelFieldOptions& options)
      : options_(options), steps_(options), program_(kOpenclProgram) {
    background.image.copyTo(background_);
    criterion.energy().copyTo(energy_);
    criterion.weight().copyTo(weight_);
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
  template <class... Args>
  void run(const char* name, cv::Size size, const Args&... args) const {
    program_.run(name,
                 {static_cast<std::size_t>(size.width), static_cast<std::size_t>(size.height)},
                 args...);
  }

  LabelFieldOptions options_;
  LabelFieldSteps steps_;
  cv::UMat background_, energy_, weight_;
  opencl::Program program_;
};

}  // namespace

std::unique_ptr<Segmenter> make_opencl_segmenter(const Background& background,
                                                 const Criterion& criterion,
                                                 const LabelFieldOptions& options) {
  return std::make_unique<OpenclSegmenter>(background, criterion, options);
}

}  // namespace plaza::color
