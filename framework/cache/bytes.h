#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "plaza/core/error.h"

namespace plaza {

/// What stands in a cache is not what was written there.
class DamagedEntry final : public InternalError {
 public:
  DamagedEntry(std::string file, const std::string& what)
      : InternalError(file + ": " + what), file_(std::move(file)) {}
  const std::string& file() const { return file_; }

 private:
  std::string file_;
};

/// Puts numbers and texts into bytes; integers are little-endian, reals keep all their bits.
class ByteWriter {
 public:
  void word(std::uint64_t value);
  void integer(std::int64_t value) { word(static_cast<std::uint64_t>(value)); }
  void real(double value);
  void flag(bool value) { bytes_ += static_cast<char>(value ? 1 : 0); }
  void text(std::string_view value);
  void optional(const std::optional<double>& value);

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Takes them out again. What is too short throws DamagedEntry naming `file`: every length is
/// checked against what is there.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::string file) : rest_(bytes), file_(std::move(file)) {}
  std::uint64_t word();
  std::int64_t integer() { return static_cast<std::int64_t>(word()); }
  double real();
  bool flag();
  std::string_view text();
  std::string_view bytes(std::uint64_t count);
  std::optional<double> optional();
  /// A number of items, each of at least `least` bytes.
  std::size_t count(std::size_t least);
  void expect_end();
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string_view rest_;
  std::string file_;
};

}  // namespace plaza
