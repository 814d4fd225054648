#include "modalities/color/segmenter.h"

namespace plaza::color {
namespace {

class CpuSegmenter final : public Segmenter {
 public:
  CpuSegmenter(const Criterion& criterion, const LabelFieldOptions& options,
               const RowKernels& kernels)
      : criterion_(criterion), options_(options), kernels_(kernels) {}

  Segmentation segment(const cv::Mat& image, const cv::Mat& previous) const override {
    Segmentation result;
    result.strength = criterion_.strength(image, kernels_);
    result.mask = solve_labels(result.strength, previous, options_, kernels_);
    return result;
  }

 private:
  Criterion criterion_;
  LabelFieldOptions options_;
  const RowKernels& kernels_;
};

}  // namespace

std::unique_ptr<Segmenter> make_cpu_segmenter(const Criterion& criterion,
                                              const LabelFieldOptions& options,
                                              const RowKernels& kernels) {
  return std::make_unique<CpuSegmenter>(criterion, options, kernels);
}

}  // namespace plaza::color
