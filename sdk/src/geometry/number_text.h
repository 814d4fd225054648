#pragma once

#include <charconv>
#include <initializer_list>
#include <string>

namespace plaza {

/// Numbers separated by blanks, each the shortest text that reads back as the same number.
inline std::string number_text(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) {
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, number);
    (void)error;  // 32 characters hold every double
    if (!text.empty()) text += ' ';
    text.append(buffer, end);
  }
  return text;
}

}  // namespace plaza
