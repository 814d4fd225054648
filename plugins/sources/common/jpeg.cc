#include "plugins/sources/common/jpeg.h"

namespace plaza::sources {
namespace {

constexpr std::uint8_t kStartOfImage = 0xD8;
constexpr std::uint8_t kEndOfImage = 0xD9;
constexpr std::uint8_t kStartOfScan = 0xDA;

bool is_restart(std::uint8_t marker) { return marker >= 0xD0 && marker <= 0xD7; }

// Frame headers are C0..CF without the tables DHT (C4) and DAC (CC) and the reserved JPG (C8).
bool is_frame_header(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

}  // namespace

std::optional<JpegOutline> jpeg_outline(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 3 || bytes[0] != 0xFF || bytes[1] != kStartOfImage || bytes[2] != 0xFF) {
    return std::nullopt;
  }
  JpegOutline outline;
  std::size_t at = 2;
  bool in_scan = false;
  while (at + 1 < bytes.size()) {
    if (bytes[at] != 0xFF) {
      if (!in_scan) return outline;  // a marker belongs here: damaged
      ++at;
      continue;
    }
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    at += 2;
    if (marker == kEndOfImage) {
      outline.complete = true;
      return outline;
    }
    if (is_restart(marker) || marker == 0x01 || (in_scan && marker == 0x00)) continue;
    if (at + 2 > bytes.size()) return outline;
    const std::size_t length = static_cast<std::size_t>(bytes[at]) << 8 | bytes[at + 1];
    if (length < 2) return outline;
    if (is_frame_header(marker) && length >= 7 && at + 7 <= bytes.size() && !outline.size) {
      outline.size = {.width = bytes[at + 5] << 8 | bytes[at + 6],
                      .height = bytes[at + 3] << 8 | bytes[at + 4]};
    }
    in_scan = marker == kStartOfScan;
    at += length;
  }
  return outline;
}

}  // namespace plaza::sources
