#pragma once

// Lines, fields and numbers of row files, with their faults. Internal to the readers of plaza/io.

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/core/diagnostic.h"

namespace plaza::row_text {

/// A field without its surrounding blanks.
struct Field {
  std::string_view text;
  int column = 1;  ///< of its first character, from 1
};

/// Collects a file's faults, the first ones in full, the rest as a number.
class Faults {
 public:
  explicit Faults(std::string file) : file_(std::move(file)) {}

  void add(int line, int column, std::string message);
  bool any() const { return count_ > 0; }
  bool full() const { return kept_.size() >= kKept; }
  /// Throws UserError when there are any.
  void throw_if_any();

 private:
  static constexpr std::size_t kKept = 20;
  std::string file_;
  Diagnostics kept_;
  std::size_t count_ = 0;
};

/// A row file's text, line by line.
class Lines {
 public:
  /// Skips a byte order mark. `faults` learns when the text is none, and then there are no lines.
  Lines(std::string_view text, Faults& faults);

  /// Goes to the next line that is not blank; false at the end.
  bool next();
  int number() const { return number_; }
  const std::vector<Field>& fields() const { return fields_; }

 private:
  void split(std::string_view line);

  std::string_view rest_;
  int number_ = 0;
  std::optional<bool> commas_;  // how fields are separated, known from the first line
  std::vector<Field> fields_;
};

/// What to show of a field in a message: quoted, cut, without control characters.
std::string quoted(std::string_view text);

/// A finite decimal number, correctly rounded; a fault and nothing otherwise.
std::optional<double> number(const Field& field, const char* what, int line, Faults& faults);

/// A whole number, possibly spelled "12.0"; a fault and nothing otherwise.
std::optional<std::int64_t> whole_number(const Field& field, const char* what, int line,
                                         Faults& faults);

/// The whole file; throws UserError where it can't be read.
std::string read_text(const std::string& file);

}  // namespace plaza::row_text
