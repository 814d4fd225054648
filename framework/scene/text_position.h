#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "plaza/core/diagnostic.h"

namespace plaza {

/// Line and column of a byte in a text.
FilePosition text_position(std::string_view text, std::size_t offset, const std::string& file);

/// The finite number that `text` consists of, blanks around it aside.
std::optional<double> parse_number(std::string_view text);

/// Throws a UserError with one diagnostic.
[[noreturn]] void throw_fault(FilePosition where, std::string message);

}  // namespace plaza
