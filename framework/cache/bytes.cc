#include "framework/cache/bytes.h"

#include <bit>

namespace plaza {
namespace {

constexpr std::size_t kWordBytes = 8;

}  // namespace

void ByteWriter::word(std::uint64_t value) {
  for (std::size_t i = 0; i < kWordBytes; ++i)
    bytes_ += static_cast<char>((value >> (8 * i)) & 0xffU);
}

void ByteWriter::real(double value) { word(std::bit_cast<std::uint64_t>(value)); }

void ByteWriter::text(std::string_view value) {
  word(value.size());
  bytes_ += value;
}

void ByteWriter::optional(const std::optional<double>& value) {
  flag(value.has_value());
  if (value) real(*value);
}

std::string_view ByteReader::bytes(std::uint64_t count) {
  if (count > rest_.size()) fail("is too short");
  const std::string_view piece = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return piece;
}

std::uint64_t ByteReader::word() {
  const std::string_view piece = bytes(kWordBytes);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < kWordBytes; ++i) {
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(piece[i])) << (8 * i);
  }
  return value;
}

double ByteReader::real() { return std::bit_cast<double>(word()); }

bool ByteReader::flag() {
  const char value = bytes(1).front();
  if (value != 0 && value != 1) fail("has a truth value that is none");
  return value == 1;
}

std::string_view ByteReader::text() { return bytes(word()); }

std::optional<double> ByteReader::optional() {
  return flag() ? std::optional<double>(real()) : std::nullopt;
}

std::size_t ByteReader::count(std::size_t least) {
  const std::uint64_t count = word();
  if (count > rest_.size() / least) fail("promises more items than it has");
  return static_cast<std::size_t>(count);
}

void ByteReader::expect_end() {
  if (!rest_.empty()) fail("is too long");
}

void ByteReader::fail(const std::string& what) const {
  throw DamagedEntry(file_, "the entry " + what);
}

}  // namespace plaza
