#include "framework/results/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "plaza/core/error.h"

namespace plaza {

std::string fixed_text(double value, int decimals) {
  if (!std::isfinite(value)) throw InternalError("a number to be written is not finite");
  std::array<char, 400> buffer{};  // the largest double has 309 digits before the point
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals)
                       .ptr;
  std::string text(buffer.data(), end);
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

}  // namespace plaza
