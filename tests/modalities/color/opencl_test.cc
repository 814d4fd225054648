// The OpenCL path against the CPU's, on whatever device OpenCV finds. On Debian, pocl-opencl-icd
// makes one of the processor.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "modalities/color/opencl_segmenter.h"
#include "plaza/core/error.h"
#include "tests/modalities/color/pictures.h"

namespace plaza::color {
namespace {

using test::background_of;
using test::equal;
using test::random_image;
using test::seen;

class OpenclTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ::setenv("OPENCV_OPENCL_DEVICE", ":CPU:", 0);  // what the user has chosen stays
    if (opencl_device().empty()) {
      GTEST_SKIP() << "no OpenCL device: apt-get install pocl-opencl-icd";
    }
  }
};

TEST_F(OpenclTest, GivesTheCpusStrengthsAndMasks) {
  for (const cv::Size size :
       {cv::Size(320, 200), cv::Size(37, 23), cv::Size(3, 5), cv::Size(1, 1)}) {
    const Background background = background_of(random_image(size.width, size.height, 1), 2);
    const Criterion criterion(background, {100, 2});
    const LabelFieldOptions field{
        .threshold = 8, .neighbourhood = 0.5, .previous = 0.25, .iterations = 4};
    const auto cpu = make_cpu_segmenter(criterion, field);
    const auto opencl = make_opencl_segmenter(background, criterion, field);
    cv::Mat previous;
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
      const cv::Mat image = seen(background.image, 0.95 - 0.1 * frame, 4, frame);
      const Segmentation a = cpu->segment(image, previous);
      const Segmentation b = opencl->segment(image, previous);
      int farthest = 0, different = 0, exact = 0;
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          const int d =
              std::abs(a.strength.at<std::uint16_t>(y, x) - b.strength.at<std::uint16_t>(y, x));
          farthest = std::max(farthest, d);
          exact += d == 0 ? 1 : 0;
          different += a.mask.at<uchar>(y, x) != b.mask.at<uchar>(y, x) ? 1 : 0;
        }
      }
      EXPECT_LE(farthest, kOpenclTolerance) << size;
      EXPECT_GE(exact, 0.99 * static_cast<double>(size.area())) << size;
      EXPECT_LE(different, 0.001 * static_cast<double>(size.area())) << size;
      // where strengths agree, all the rest is integers and must agree
      if (farthest == 0) {
        EXPECT_TRUE(equal(a.mask, b.mask)) << size;
      }
      previous = a.mask;
    }
  }
}

/// 0: refused as it should be. Ends the process, since OpenCV chooses its device once.
[[noreturn]] void ask_without_device() {
  ::setenv("OPENCV_OPENCL_DEVICE", "disabled", 1);
  const Background background = background_of(random_image(4, 4, 1), 2);
  try {
    make_opencl_segmenter(background, Criterion(background, {}), {});
  } catch (const UserError& error) {
    const bool helpful = std::string(error.what()).find("pocl-opencl-icd") != std::string::npos;
    std::exit(opencl_device().empty() && helpful ? 0 : 1);
  }
  std::exit(2);
}

TEST(OpenclWithoutDeviceDeathTest, IsTheUsersErrorWithARemedy) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(ask_without_device(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace plaza::color
