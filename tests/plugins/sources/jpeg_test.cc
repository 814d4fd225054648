#include "plugins/sources/common/jpeg.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace plaza::sources {
namespace {

std::vector<std::uint8_t> coded(int width, int height, std::vector<int> parameters = {}) {
  cv::Mat image(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto v = static_cast<std::uint8_t>((x * 37 + y * 91) % 256);
      image.at<cv::Vec3b>(y, x) = {v, static_cast<std::uint8_t>(255 - v), 128};
    }
  }
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes, parameters);
  return bytes;
}

TEST(JpegOutline, ReadsSizeAndEnd) {
  const auto outline = jpeg_outline(coded(40, 30));
  ASSERT_TRUE(outline);
  EXPECT_EQ(outline->size, (JpegSize{.width = 40, .height = 30}));
  EXPECT_TRUE(outline->complete);
}

TEST(JpegOutline, KnowsProgressiveImagesAndRestartMarkers) {
  for (const int parameter : {cv::IMWRITE_JPEG_PROGRESSIVE, cv::IMWRITE_JPEG_RST_INTERVAL}) {
    const auto outline = jpeg_outline(coded(400, 300, {parameter, 1}));
    ASSERT_TRUE(outline);
    EXPECT_EQ(outline->size, (JpegSize{.width = 400, .height = 300}));
    EXPECT_TRUE(outline->complete);
  }
}

TEST(JpegOutline, EveryCutIsIncomplete) {
  const std::vector<std::uint8_t> whole = coded(40, 30);
  for (std::size_t size = 3; size < whole.size(); ++size) {
    const auto outline = jpeg_outline({whole.data(), size});
    ASSERT_TRUE(outline) << size;
    EXPECT_FALSE(outline->complete) << size;
  }
}

TEST(JpegOutline, AllowsBytesAfterTheEnd) {
  std::vector<std::uint8_t> bytes = coded(40, 30);
  bytes.insert(bytes.end(), 100, 0);
  EXPECT_TRUE(jpeg_outline(bytes)->complete);
}

TEST(JpegOutline, EndMarkerInsideASegmentIsNotTheEnd) {
  std::vector<std::uint8_t> bytes = coded(40, 30);
  // a thumbnail in an application segment has an end marker of its own
  const std::vector<std::uint8_t> segment = {0xFF, 0xE1, 0x00, 0x06, 0xFF, 0xD8, 0xFF, 0xD9};
  bytes.insert(bytes.begin() + 2, segment.begin(), segment.end());
  EXPECT_TRUE(jpeg_outline(bytes)->complete);
  bytes.resize(bytes.size() / 2);
  EXPECT_FALSE(jpeg_outline(bytes)->complete);
}

TEST(JpegOutline, OtherBytesAreNoJpeg) {
  EXPECT_FALSE(jpeg_outline({}));
  EXPECT_FALSE(jpeg_outline(std::vector<std::uint8_t>{0xFF, 0xD8}));
  EXPECT_FALSE(jpeg_outline(std::vector<std::uint8_t>(100, 0)));
  const std::vector<std::uint8_t> garbage = {0xFF, 0xD8, 0xFF, 0xE0, 0x00, 0x01, 0x00};
  ASSERT_TRUE(jpeg_outline(garbage));
  EXPECT_FALSE(jpeg_outline(garbage)->complete);
}

}  // namespace
}  // namespace plaza::sources
