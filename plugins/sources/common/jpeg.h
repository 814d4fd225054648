#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace plaza::sources {

/// Width and height that a JPEG stream codes.
struct JpegSize {
  int width = 0;
  int height = 0;
  bool operator==(const JpegSize&) const = default;
};

/// What the markers of a JPEG stream say (ITU-T T.81, Annex B). Decoders fill the rest of a cut-off
/// image with grey and call it a success; the markers tell.
struct JpegOutline {
  std::optional<JpegSize> size;  ///< of the first frame header; nothing: there is none
  bool complete = false;         ///< the end-of-image marker is where it belongs
};

/// Nothing when the bytes do not start as a JPEG stream does.
std::optional<JpegOutline> jpeg_outline(std::span<const std::uint8_t> bytes);

}  // namespace plaza::sources
