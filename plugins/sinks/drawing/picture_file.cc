#include "plugins/sinks/drawing/picture_file.h"

#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <system_error>
#include <vector>

#include "plaza/core/error.h"
#include "plaza/io/output_file.h"

namespace plaza::drawing {
namespace fs = std::filesystem;

std::string free_space_text(const fs::path& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  std::ostringstream text;
  if (error) {
    text << "the folder '" << folder.string() << "' cannot be reached: " << error.message();
  } else {
    text << std::fixed << std::setprecision(1) << static_cast<double>(space.available) / 1e6
         << " MB are free in '" << folder.string() << "'";
  }
  return text.str();
}

void write_png(const fs::path& file, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", image, bytes)) {
    throw InternalError("OpenCV could not encode the picture '" + file.string() + "'");
  }
  write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string fault_of_file_name(const std::string& name) {
  if (name.empty()) return "the name of the file is empty";
  if (name == "." || name == ".." || name.find('/') != std::string::npos) {
    return "'" + name + "' must be a plain file name; the run's output folder is set with --out";
  }
  return {};
}

}  // namespace plaza::drawing
