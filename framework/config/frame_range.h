#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace plaza {

/// Frames [first, end), counted from 0.
struct FrameRange {
  std::int64_t first = 0;
  std::optional<std::int64_t> end;  ///< nothing: to the end of the source

  bool operator==(const FrameRange&) const = default;
};

/// "A:B"; either side may be empty: from the first frame, to the last. Nothing when it is not that
/// or holds no frame.
std::optional<FrameRange> parse_frame_range(const std::string& text);

/// "A:B", B empty where the range has no end.
std::string to_string(const FrameRange& range);

}  // namespace plaza
