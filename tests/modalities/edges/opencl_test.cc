// Matching on whatever OpenCL device OpenCV finds, against the CPU: bit by bit. On Debian,
// pocl-opencl-icd makes a device of the processor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <random>

#include "modalities/edges/edges.h"
#include "modalities/edges/opencl_matcher.h"
#include "plaza/core/error.h"
#include "tests/modalities/edges/upright_box.h"

namespace plaza::edges {
namespace {

class EdgesOpenclTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ::setenv("OPENCV_OPENCL_DEVICE", ":CPU:", 0);  // what the user has chosen stays
    if (opencl::device_name().empty()) {
      GTEST_SKIP() << "no OpenCL device: apt-get install pocl-opencl-icd";
    }
  }
};

std::vector<Pose> everywhere(int across) {
  std::vector<Pose> poses;
  for (int i = 0; i < across * across; ++i) {
    poses.push_back({{8.0 * (i % across) / across - 4, 8.0 * (i / across) / across - 4}, 0, 1});
  }
  return poses;
}

TEST_F(EdgesOpenclTest, SumsAreThoseOfTheCpu) {
  for (const double gate_px : {6.0, 200.0}) {
    const auto layout =
        std::make_shared<const PlaneLayout>(cv::Size(160, 120), make_directions(7, gate_px));
    ByteBlock planes(layout->bytes());
    std::mt19937 random(1);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      planes.data()[i] = static_cast<std::uint8_t>(random() % (static_cast<unsigned>(gate_px) + 2));
    }
    const auto scene = test::scene_of({160, 120});
    const test::UprightBox shape;
    EdgeTemplates templates(layout);
    for (const Pose& pose : everywhere(12)) {
      templates.add(shape.silhouette(pose, scene->cameras[0]), {});
    }
    std::vector<std::uint32_t> which;
    for (int i = 0; i < 200; ++i) {  // any order, some twice
      which.push_back(static_cast<std::uint32_t>(random() % templates.size()));
    }
    const OpenclMatcher device;
    const cv::UMat uploaded = OpenclMatcher::upload(planes);
    const std::vector<ContourSum> sums = device.sums(uploaded, templates, which);
    ASSERT_EQ(sums.size(), 7 * which.size());
    std::uint64_t all = 0;
    for (std::size_t i = 0; i < which.size(); ++i) {
      ContourSum expected[7];
      sum_contour_versions().front().run(planes.data(), templates.runs(which[i]), expected);
      for (std::size_t d = 0; d < 7; ++d) {
        ASSERT_EQ(sums[7 * i + d], expected[d]) << i << ", direction " << d;
        all += expected[d].squares;
      }
    }
    EXPECT_GT(all, 0U);
    const std::vector<ContourSum> again = device.sums(uploaded, templates, which);
    EXPECT_EQ(sums, again);
  }
}

/// What the modality answers for everywhere in an image of scribbles: as it is, some cells in
/// disorder, and after somebody was explained.
std::vector<std::uint64_t> answers(Device device) {
  const auto scene = test::scene_of({160, 120});
  BuildContext context;
  context.scene = scene;
  Edges::Options options;
  options.background = BackgroundMethod::kNone;
  options.device = device;
  const Edges edges(options, context);
  cv::Mat image(120, 160, CV_8UC3, cv::Scalar::all(90));
  std::mt19937 random(2);
  for (int i = 0; i < 12; ++i) {
    image(cv::Rect(static_cast<int>(random() % 130), static_cast<int>(random() % 80), 12, 35))
        .setTo(cv::Scalar::all(static_cast<double>(random() % 256)));
  }
  const EvidencePtr evidence = edges.prepare(image, 0).evidence;
  const auto templates = edges.sample(test::UprightBox(), everywhere(12), 0);
  std::vector<double> all(templates->size()), some(90), left(templates->size());
  edges.match(*evidence, *templates, all);
  std::vector<std::uint32_t> which;
  for (std::uint32_t i = 0; i < 90; ++i) which.push_back((i * 37) % 144);
  edges.match(*evidence, *templates, which, some);
  edges.match(*edges.explain(evidence, *templates, 70), *templates, left);
  EXPECT_NE(all, left);
  std::vector<std::uint64_t> bits;
  for (const auto& values : {all, some, left}) {
    for (const double v : values) bits.push_back(std::bit_cast<std::uint64_t>(v));
  }
  return bits;
}

TEST_F(EdgesOpenclTest, LikelihoodsAreTheCpusBitByBit) {
  const std::vector<std::uint64_t> cpu = answers(Device::kCpu);
  EXPECT_EQ(answers(Device::kOpencl), cpu);
  EXPECT_EQ(answers(Device::kOpencl), cpu);
}

/// 0: refused as it should be. Ends the process, since OpenCV chooses its device once.
[[noreturn]] void ask_without_device() {
  ::setenv("OPENCV_OPENCL_DEVICE", "disabled", 1);
  const Diagnostics faults = opencl::check_device();
  if (faults.size() != 1 || faults.front().pointer != "/device") std::exit(1);
  try {
    const OpenclMatcher matcher;
  } catch (const UserError& error) {
    const bool helpful = std::string(error.what()).find("pocl-opencl-icd") != std::string::npos;
    std::exit(helpful ? 0 : 2);
  }
  std::exit(3);
}

TEST(EdgesWithoutDeviceDeathTest, IsTheUsersErrorWithARemedy) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(ask_without_device(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace plaza::edges
