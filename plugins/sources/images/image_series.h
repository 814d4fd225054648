#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace plaza::sources {

/// File names that count: "cam1_{frame}.png" (any number of digits) or printf's "cam1_%06d.png"
/// (that many, or more where the number needs them; "%d" without leading zeros; "%%" is a percent
/// sign).
class NumberPattern {
 public:
  /// Throws UserError, saying what is wrong and what would be right.
  explicit NumberPattern(std::string_view file_name);

  /// The number in a file name; nothing when the name is not of this pattern.
  std::optional<std::int64_t> number(std::string_view file_name) const;

 private:
  std::string before_;
  std::string after_;
  bool any_digits_ = false;
  std::size_t min_digits_ = 1;
};

/// The numbered images of one camera.
struct ImageSeries {
  std::map<std::int64_t, std::filesystem::path> files;  ///< by the number in the name
};

/// Lists the folder of `pattern` once. The number stands in the file's name, not in a folder's.
/// Throws UserError when the folder is missing or cannot be read, when two names have the same
/// number, or when no file fits (with an example of what is there).
ImageSeries list_images(const std::filesystem::path& pattern);

}  // namespace plaza::sources
