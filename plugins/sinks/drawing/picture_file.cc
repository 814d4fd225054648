#include "plugins/sinks/drawing/picture_file.h"

#include <fstream>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <system_error>
#include <vector>

#include "plaza/core/error.h"

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

void write_file(const fs::path& file, const std::string& content) {
  fs::path unfinished = file;
  unfinished += ".part";
  std::ofstream out(unfinished, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  std::error_code error;
  if (out) fs::rename(unfinished, file, error);
  if (!out || error) {
    std::error_code ignored;  // a half-written neighbour that cannot be removed either is harmless
    fs::remove(unfinished, ignored);
    throw UserError("cannot write '" + file.string() + "': " + free_space_text(file.parent_path()) +
                    "; check that the folder exists and may be written to (--out)");
  }
}

void write_png(const fs::path& file, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", image, bytes)) {
    throw InternalError("OpenCV could not encode the picture '" + file.string() + "'");
  }
  write_file(file, std::string(bytes.begin(), bytes.end()));
}

std::string fault_of_file_name(const std::string& name) {
  if (name.empty()) return "the name of the file is empty";
  if (name == "." || name == ".." || name.find('/') != std::string::npos) {
    return "'" + name + "' must be a plain file name; the run's output folder is set with --out";
  }
  return {};
}

}  // namespace plaza::drawing
