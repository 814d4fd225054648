#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "tests/plugins/sources/source_harness.h"

namespace plaza::sources {

/// Writes a Motion JPEG video whose frame k is numbered_image(first + k).
inline void write_video(const std::filesystem::path& file, int frames, double rate_hz = 10,
                        int width = kWidth, int height = kHeight, int first = 0) {
  cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                         rate_hz, cv::Size(width, height));
  ASSERT_TRUE(writer.isOpened());
  for (int k = 0; k < frames; ++k) writer.write(numbered_image(first + k, width, height));
}

/// An AVI file taken apart: what stands before the picture chunks, and the pictures. The index is
/// left out; readers find their way without.
struct TakenApartAvi {
  std::string head;
  std::vector<std::string> pictures;

  static TakenApartAvi read(const std::filesystem::path& file) {
    const std::string bytes = read_bytes(file);
    TakenApartAvi avi;
    std::size_t at = bytes.find("movi") + 4;
    avi.head = bytes.substr(0, at);
    while (at + 8 <= bytes.size() && bytes.compare(at, 4, "00dc") == 0) {
      std::uint32_t size = 0;
      std::memcpy(&size, &bytes[at + 4], sizeof size);
      avi.pictures.push_back(bytes.substr(at + 8, size));
      at += 8 + size + (size & 1U);
    }
    return avi;
  }
  void write(const std::filesystem::path& file) const {
    std::string bytes = head;
    for (const std::string& picture : pictures) {
      const auto size = static_cast<std::uint32_t>(picture.size());
      bytes += "00dc";
      bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
      bytes += picture;
      if (size & 1U) bytes += '\0';
    }
    const auto list = static_cast<std::uint32_t>(bytes.size() - head.size() + 4);
    std::memcpy(&bytes[head.size() - 8], &list, sizeof list);
    const auto riff = static_cast<std::uint32_t>(bytes.size() - 8);
    std::memcpy(&bytes[4], &riff, sizeof riff);
    write_bytes(file, bytes);
  }
};

}  // namespace plaza::sources
