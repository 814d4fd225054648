// The OpenCL path against the CPU's, on whatever device OpenCV finds. On Debian, pocl-opencl-icd
// makes one of the processor.
#include "modalities/common/opencl.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "modalities/color/color_evidence.h"
#include "modalities/color/opencl_counter.h"
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
    if (opencl::device_name().empty()) {
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

/// Upright bodies all over an image, many cut by its border.
void add_bodies(SpanTemplates& templates) {
  const cv::Size image = templates.image();
  for (int i = 0; i < 150; ++i) {
    const int width = 4 + i % 9, height = 12 + i % 17;
    const int left = (i * 29) % (image.width + 10) - 5, top = (i * 13) % image.height - 6;
    Silhouette s;
    for (int row = std::max(top, 0); row < std::min(top + height, image.height); ++row) {
      const int slant = (row - top) / 5;
      const int begin = std::clamp(left + slant, 0, image.width);
      const int end = std::clamp(left + slant + width, 0, image.width);
      if (begin < end) s.spans.push_back({row, begin, end});
    }
    s.box = {static_cast<double>(left), static_cast<double>(top), static_cast<double>(width),
             static_cast<double>(height)};
    double area = 0;
    for (const RowSpan& span : s.spans) area += span.end - span.begin;
    s.inside_share = area / (width * height);
    templates.add(s, {.gap = 0.06, .width = 0.1});
  }
}

TEST_F(OpenclTest, CountsAreThoseOfTheCpu) {
  const cv::Size size(90, 70);
  SpanTemplates templates(size);
  add_bodies(templates);
  std::vector<std::uint32_t> which;
  for (std::uint32_t i = 0; i < 160; ++i) which.push_back((i * 37) % 150);  // some twice
  const OpenclCounter device;
  for (const bool occluded : {false, true}) {
    const auto blind = std::make_shared<ColorEvidence::Blind>();
    if (occluded) {
      blind->mask = cv::Mat(size, CV_8UC1, cv::Scalar(0));
      blind->mask(cv::Rect(20, 10, 30, 40)).setTo(255);
      blind->counts = AreaCounts(blind->mask);
    }
    cv::Mat mask(size, CV_8UC1);
    cv::randu(mask, 0, 2);
    mask *= 255;
    cv::Mat seen = mask.clone();
    if (occluded) seen.setTo(0, blind->mask);
    const AreaCounts foreground(seen);
    const ColorEvidence evidence(ColorEvidence::State::kUsable, cv::Mat(size, CV_8UC3),
                                 {.strength = {}, .mask = mask}, nullptr, blind);
    for (int turn = 0; turn < 2; ++turn) {  // uploaded once, asked twice
      const std::vector<TemplateCounts> counts = evidence.count(device, templates, which);
      ASSERT_EQ(counts.size(), which.size());
      std::uint32_t set = 0, hidden = 0;
      for (std::size_t i = 0; i < which.size(); ++i) {
        const TemplateCounts expected = count(templates, which[i], foreground, blind->counts);
        for (const auto region :
             {&TemplateCounts::inner, &TemplateCounts::near, &TemplateCounts::outer}) {
          EXPECT_EQ((counts[i].*region).set, (expected.*region).set) << i;
          EXPECT_EQ((counts[i].*region).hidden, (expected.*region).hidden) << i;
        }
        set += expected.outer.set;
        hidden += expected.outer.hidden;
      }
      EXPECT_GT(set, 0U);
      EXPECT_EQ(hidden > 0, occluded);
    }
    const auto rest = evidence.without(templates, std::span(which).first(1));
    EXPECT_TRUE(evidence.countable_on_device());
    EXPECT_FALSE(rest->countable_on_device());
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
    std::exit(opencl::device_name().empty() && helpful ? 0 : 1);
  }
  std::exit(2);
}

TEST(OpenclWithoutDeviceDeathTest, IsTheUsersErrorWithARemedy) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(ask_without_device(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace plaza::color
