#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/core/diagnostic.h"

namespace plaza {

/// A value of an OpenCV storage: a number, a list of numbers or a matrix, by rows.
struct StorageValue {
  std::string name;
  FilePosition where;
  std::vector<double> numbers;
  bool numeric = true;  ///< false: text, or a structure with other content
};

using Storage = std::map<std::string, StorageValue>;

/// Top-level values of a file that cv::FileStorage writes, in YAML, XML or JSON; the format is told
/// by the first character. Not read by cv::FileStorage itself, which keeps no positions and ends
/// the process on some damaged files (std::terminate inside OpenCV 4.6). Throws UserError.
Storage parse_opencv_storage(std::string_view text, const std::string& file);

}  // namespace plaza
