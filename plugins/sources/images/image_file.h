#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

namespace plaza::sources {

/// What came out of an image file: an image, or why there is none.
struct DecodedImage {
  cv::Mat image;         ///< 8-bit BGR; empty when there is a fault
  std::string fault;     ///< begins with the file's name
  bool damaged = false;  ///< cut off or not decodable, rather than of the wrong kind
};

/// Reads a colour or grey image (grey becomes BGR, transparency is dropped, EXIF orientation
/// applied).
///
/// Cut-off files are found as far as the format allows: PNG by its checksums, JPEG by its end
/// marker (its decoder fills the rest with grey and reports success). Bytes altered inside a JPEG's
/// compressed data are not found.
DecodedImage read_image(const std::filesystem::path& file);

}  // namespace plaza::sources
