#include "plugins/sources/images/image_series.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "plaza/core/error.h"

namespace plaza::sources {
namespace {

constexpr std::string_view kPlaceholder = "{frame}";
constexpr std::size_t kMostDigits = 18;  // what 64 bits surely hold

bool is_digit(char c) { return c >= '0' && c <= '9'; }

[[noreturn]] void refuse(std::string_view pattern, const std::string& why) {
  throw UserError("pattern '" + std::string(pattern) + "' " + why +
                  "; write {frame} where the number stands, or printf's %d or %06d");
}

}  // namespace

NumberPattern::NumberPattern(std::string_view file_name) {
  std::string* part = &before_;
  bool found = false;
  const auto number_here = [&](bool any_digits, std::size_t min_digits) {
    if (found) refuse(file_name, "has two places for the number");
    found = true;
    any_digits_ = any_digits;
    min_digits_ = min_digits;
    part = &after_;
  };
  for (std::size_t i = 0; i < file_name.size(); ++i) {
    if (file_name.substr(i).starts_with(kPlaceholder)) {
      number_here(true, 1);
      i += kPlaceholder.size() - 1;
    } else if (file_name[i] != '%') {
      *part += file_name[i];
    } else if (file_name.substr(i + 1).starts_with('%')) {
      *part += '%';
      ++i;
    } else {
      std::size_t end = i + 1;
      while (end < file_name.size() && is_digit(file_name[end])) ++end;
      if (end >= file_name.size() || file_name[end] != 'd') {
        refuse(file_name, "has a '%' that is no %d");
      }
      const std::string_view width = file_name.substr(i + 1, end - i - 1);
      std::size_t digits = 1;
      if (!width.empty()) {
        const auto result = std::from_chars(width.data(), width.data() + width.size(), digits);
        if (width[0] != '0' || result.ec != std::errc() || digits < 1 || digits > kMostDigits) {
          refuse(file_name, "has '%" + std::string(width) + "d', which is no zero-padded width");
        }
      }
      number_here(false, digits);
      i = end;
    }
  }
  if (!found) refuse(file_name, "has no place for the frame's number");
}

std::optional<std::int64_t> NumberPattern::number(std::string_view file_name) const {
  if (file_name.size() <= before_.size() + after_.size() || !file_name.starts_with(before_) ||
      !file_name.ends_with(after_)) {
    return std::nullopt;
  }
  const std::string_view digits =
      file_name.substr(before_.size(), file_name.size() - before_.size() - after_.size());
  if (digits.size() > kMostDigits || !std::ranges::all_of(digits, is_digit)) return std::nullopt;
  if (!any_digits_) {
    if (digits.size() < min_digits_) return std::nullopt;
    if (digits.size() > min_digits_ && digits[0] == '0') return std::nullopt;
  }
  std::int64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

ImageSeries list_images(const std::filesystem::path& pattern) {
  const std::filesystem::path folder = pattern.parent_path();
  if (folder.string().find(kPlaceholder) != std::string::npos) {
    refuse(pattern.string(), "has the number in a folder's name; only the file's name may have it");
  }
  const NumberPattern names(pattern.filename().string());
  ImageSeries series;
  std::string other;  // the first name, in order, that does not fit
  std::error_code error;
  std::filesystem::directory_iterator entries(folder.empty() ? "." : folder, error);
  for (; !error && entries != std::filesystem::directory_iterator(); entries.increment(error)) {
    const std::string name = entries->path().filename().string();
    const auto number = names.number(name);
    if (!number) {
      if (other.empty() || name < other) other = name;
      continue;
    }
    const auto [known, inserted] = series.files.emplace(*number, entries->path());
    if (!inserted) {
      const std::string known_name = known->second.filename().string();
      throw UserError("'" + std::min(known_name, name) + "' and '" + std::max(known_name, name) +
                      "' in " + folder.string() + " are both number " + std::to_string(*number) +
                      "; remove one, or write a pattern that only one fits");
    }
  }
  if (error) {
    throw UserError("the folder " + folder.string() + " cannot be listed: " + error.message() +
                    "; paths start at the pipeline's folder, $PLAZA_DATA names the data folder");
  }
  if (series.files.empty()) {
    throw UserError(
        "no file in " + folder.string() + " fits '" + pattern.filename().string() + "'; " +
        (other.empty() ? "the folder is empty" : "it has '" + other + "', for example"));
  }
  return series;
}

}  // namespace plaza::sources
