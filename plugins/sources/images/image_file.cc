#include "plugins/sources/images/image_file.h"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "plugins/sources/common/jpeg.h"

namespace plaza::sources {
namespace {

DecodedImage no_image(const std::filesystem::path& file, const std::string& why, bool damaged) {
  return {.image = {}, .fault = file.string() + " " + why, .damaged = damaged};
}

}  // namespace

DecodedImage read_image(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return no_image(file, "cannot be opened for reading", false);
  const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(in)),
                                        std::istreambuf_iterator<char>());
  if (bytes.empty()) return no_image(file, "is empty", true);
  if (const auto outline = jpeg_outline(bytes); outline && !outline->complete) {
    return no_image(file, "is cut off: the end of its JPEG data is missing", true);
  }
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH);
  } catch (const cv::Exception&) {
    image.release();  // headers with sizes beyond OpenCV's limits
  }
  if (image.empty()) return no_image(file, "is no image that can be decoded, or is damaged", true);
  if (image.type() != CV_8UC3) {
    return no_image(file,
                    "has more than 8 bits per channel; convert the images to 8 bits, choosing the "
                    "range of brightness that shows the people",
                    false);
  }
  return {.image = image, .fault = {}, .damaged = false};
}

}  // namespace plaza::sources
