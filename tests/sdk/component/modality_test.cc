// What the base class of modalities promises: which past reaches prepare(), and when.
#include "plaza/component/modality.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace plaza {
namespace {

const cv::Size kSize(8, 6);

struct Count final : Modality::Memory {
  explicit Count(int n) : calls(n) {}
  int calls;
};

/// Gives masks whose first pixel is the number of the call, and hands on how many images it has
/// seen; notes what it was given.
class Recorder final : public Modality {
 public:
  explicit Recorder(const BuildContext& context) : Modality(context) {}
  mutable std::vector<int> previous;    ///< first pixel of each call's previous mask, -1: none
  mutable std::vector<int> remembered;  ///< what each call was handed on, -1: nothing

 private:
  struct Nothing : Evidence {};
  Prepared do_prepare(const cv::Mat& image, std::size_t, const Past& past) const override {
    const cv::Mat& mask = past.foreground;
    const auto* before = dynamic_cast<const Count*>(past.memory.get());
    remembered.push_back(before != nullptr ? before->calls : -1);
    previous.push_back(mask.empty() ? -1 : mask.at<uchar>(0, 0));
    cv::Mat next(image.size(), CV_8UC1, cv::Scalar(0));
    next.at<uchar>(0, 0) = static_cast<uchar>(previous.size());
    return {std::make_shared<Nothing>(), next,
            std::make_shared<Count>(before != nullptr ? before->calls + 1 : 1)};
  }
  std::unique_ptr<TemplateBatch> do_sample(const ShapeModel&, std::span<const Pose>,
                                           std::size_t) const override {
    return nullptr;
  }
  void do_match(const Evidence&, const TemplateBatch&, std::span<const std::uint32_t>,
                std::span<double>) const override {}
  EvidencePtr do_explain(const EvidencePtr& evidence, const TemplateBatch&,
                         std::span<const std::uint32_t>) const override {
    return evidence;
  }
};

class ModalityTest : public ::testing::Test {
 protected:
  static BuildContext context(bool in_order) {
    auto scene = std::make_shared<Scene>();
    const PinholeIntrinsics lens = {
        .fx_px = 9, .fy_px = 9, .cx_px = 4, .cy_px = 3, .distortion = {}};
    scene->cameras.push_back(Camera::pinhole("one", {kSize.width, kSize.height}, lens, {}));
    BuildContext context;
    context.scene = std::move(scene);
    context.in_order = in_order;
    return context;
  }
  static void process(Modality& modality, std::int64_t frame, bool image = true) {
    auto frames = std::make_shared<FrameSet>();
    frames->views.push_back(image ? cv::Mat(kSize, CV_8UC3, cv::Scalar::all(9)) : cv::Mat());
    std::vector<PayloadPtr> slots = {frames, nullptr, nullptr};
    const std::vector<int> inputs = {0};
    const std::vector<int> outputs = {1, 2};
    NodeIo io(frame, 0, slots.data(), inputs, outputs);
    modality.process(io);
  }
};

TEST_F(ModalityTest, PassesTheMaskOfTheFrameBefore) {
  Recorder modality(context(true));
  for (std::int64_t frame = 10; frame < 13; ++frame) process(modality, frame);
  EXPECT_EQ(modality.previous, (std::vector<int>{-1, 1, 2}));
  EXPECT_EQ(modality.remembered, (std::vector<int>{-1, 1, 2}));
}

TEST_F(ModalityTest, ForgetsAfterAJumpInTimeAndAfterAMissingImage) {
  Recorder modality(context(true));
  process(modality, 0);
  process(modality, 2);
  process(modality, 3, false);
  process(modality, 4);
  EXPECT_EQ(modality.previous, (std::vector<int>{-1, -1, -1}));
  EXPECT_EQ(modality.remembered, (std::vector<int>{-1, -1, 1}))
      << "an image that is missing ends the mask, but not what else is known";
}

TEST_F(ModalityTest, KeepsNothingWhenFramesMayComeInAnyOrder) {
  Recorder modality(context(false));
  for (std::int64_t frame = 0; frame < 3; ++frame) process(modality, frame);
  EXPECT_EQ(modality.previous, (std::vector<int>{-1, -1, -1}));
  EXPECT_EQ(modality.remembered, (std::vector<int>{-1, -1, -1}));
}

TEST_F(ModalityTest, RefusesAPreviousMaskOfAnotherForm) {
  const Recorder modality(context(true));
  const cv::Mat image(kSize, CV_8UC3, cv::Scalar::all(9));
  EXPECT_THROW(modality.prepare(image, 0, cv::Mat(3, 3, CV_8UC1)), std::invalid_argument);
  EXPECT_THROW(modality.prepare(image, 0, cv::Mat(kSize, CV_32FC1)), std::invalid_argument);
  EXPECT_NO_THROW(modality.prepare(image, 0, cv::Mat(kSize, CV_8UC1, cv::Scalar(0))));
}

}  // namespace
}  // namespace plaza
