#include "framework/config/frame_range.h"

#include <charconv>
#include <string_view>

namespace plaza {
namespace {

std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

}  // namespace

std::optional<FrameRange> parse_frame_range(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return std::nullopt;
  const std::string_view first = std::string_view(text).substr(0, colon);
  const std::string_view end = std::string_view(text).substr(colon + 1);
  FrameRange range;
  if (!first.empty()) {
    const auto value = whole_number(first);
    if (!value) return std::nullopt;
    range.first = *value;
  }
  if (!end.empty()) {
    range.end = whole_number(end);
    if (!range.end || *range.end <= range.first) return std::nullopt;
  }
  return range;
}

std::string to_string(const FrameRange& range) {
  return std::to_string(range.first) + ":" + (range.end ? std::to_string(*range.end) : "");
}

}  // namespace plaza
