#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

namespace plaza::drawing {

/// Whole or not there. Throws UserError naming file, cause and remedy (see OutputFile).
void write_png(const std::filesystem::path& file, const cv::Mat& image);

/// "12.3 MB are free in '/data/out'", for messages about files that could not be written.
std::string free_space_text(const std::filesystem::path& folder);

/// Empty when `name` can be the name of a file in the output folder; else what is wrong with it.
std::string fault_of_file_name(const std::string& name);

}  // namespace plaza::drawing
