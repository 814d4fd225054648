#include "row_text.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "plaza/core/error.h"

namespace plaza::row_text {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string hexadecimal(char c) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto value = static_cast<unsigned char>(c);
  return {kDigits[value >> 4U], kDigits[value & 0xFU]};
}

/// The number's value when `text` is a decimal number, whole and with nothing after it.
template <class T>
std::errc parse(std::string_view text, T& value) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return std::errc::invalid_argument;
  }
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stop != end) return std::errc::invalid_argument;
  return error;
}

std::string named(const char* what, const Field& field) {
  return std::string(what) + " " + quoted(field.text);
}

}  // namespace

void Faults::add(int line, int column, std::string message) {
  ++count_;
  if (!full()) {
    kept_.push_back({.where = {file_, line, column}, .pointer = {}, .message = std::move(message)});
  }
}

void Faults::throw_if_any() {
  if (!any()) return;
  if (count_ > kept_.size()) {
    Diagnostic rest;
    rest.where.file = file_;
    rest.message = "and " + std::to_string(count_ - kept_.size()) + " more faults";
    kept_.push_back(std::move(rest));
  }
  throw UserError(std::move(kept_));
}

Lines::Lines(std::string_view text, Faults& faults) : rest_(text) {
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  int line = 1;
  int column = 1;
  for (const char c : rest_) {
    if (c == '\n') {
      ++line;
      column = 1;
      continue;
    }
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r') {
      faults.add(
          line, column,
          "byte 0x" + hexadecimal(c) + ": not a text file; expected rows of decimal numbers");
      rest_ = {};
      return;
    }
    ++column;
  }
}

bool Lines::next() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
    if (!commas_) commas_ = line.find(',') != std::string_view::npos;
    split(line);
    return true;
  }
  return false;
}

void Lines::split(std::string_view line) {
  fields_.clear();
  std::size_t begin = 0;
  const auto add = [&](std::size_t end) {
    std::size_t first = begin;
    std::size_t last = end;
    while (first < last && is_blank(line[first])) ++first;
    while (last > first && is_blank(line[last - 1])) --last;
    fields_.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
    begin = end + 1;
  };
  if (*commas_) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == ',') add(i);
    }
    add(line.size());
  } else {
    for (std::size_t i = 0; i < line.size();) {
      while (i < line.size() && is_blank(line[i])) ++i;
      begin = i;
      while (i < line.size() && !is_blank(line[i])) ++i;
      if (i > begin) add(i);
    }
  }
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kShown = 32;
  std::string out = "'";
  for (const char c : text.substr(0, kShown)) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code >= 0x7F) {
      out += "\\x" + hexadecimal(c);
    } else {
      out += c;
    }
  }
  if (text.size() > kShown) out += "...";
  return out + "'";
}

std::optional<double> number(const Field& field, const char* what, int line, Faults& faults) {
  double value = 0;
  const std::errc error = parse(field.text, value);
  if (error == std::errc() && std::isfinite(value)) return value;
  if (field.text.empty()) {
    faults.add(line, field.column, std::string(what) + " is empty; write a decimal number");
  } else if (error == std::errc::result_out_of_range) {
    faults.add(line, field.column, named(what, field) + " is beyond the range of double precision");
  } else if (error == std::errc()) {
    faults.add(line, field.column, named(what, field) + " is not finite; leave the row out");
  } else {
    faults.add(line, field.column, named(what, field) + " is not a decimal number");
  }
  return std::nullopt;
}

std::optional<std::int64_t> whole_number(const Field& field, const char* what, int line,
                                         Faults& faults) {
  constexpr std::int64_t kLargest = std::int64_t{1}
                                    << 53;  // up to here doubles are whole and exact
  std::int64_t whole = 0;
  if (parse(field.text, whole) == std::errc() && whole >= -kLargest && whole <= kLargest)
    return whole;
  const std::optional<double> value = number(field, what, line, faults);
  if (!value) return std::nullopt;
  if (*value != std::trunc(*value)) {
    faults.add(line, field.column, named(what, field) + " is not a whole number");
    return std::nullopt;
  }
  if (std::abs(*value) > static_cast<double>(kLargest)) {
    faults.add(line, field.column, named(what, field) + " is too large; at most 2^53");
    return std::nullopt;
  }
  return static_cast<std::int64_t>(*value);
}

std::string read_text(const std::string& file) {
  const auto fail = [&file](const std::string& message) {
    Diagnostic fault;
    fault.where.file = file;
    fault.message = message;
    throw UserError(std::move(fault));
  };
  std::error_code error;
  if (!std::filesystem::exists(file, error)) fail("no such file; check the path");
  if (std::filesystem::is_directory(file, error)) fail("is a folder; name a file in it");
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("can't be opened for reading; check its permissions");
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) fail("could not be read to its end");
  return std::move(text).str();
}

}  // namespace plaza::row_text
