#include "plugins/sinks/overlay-video/video_file.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "plaza/core/error.h"
#include "plugins/sinks/drawing/picture_file.h"

namespace plaza::overlay {
namespace fs = std::filesystem;
namespace {

struct Encoding {
  Codec codec;
  const char* name;
  std::array<char, 4> tag;
};
constexpr std::array<Encoding, 3> kEncodings = {{
    {Codec::kH264, "H.264", {'a', 'v', 'c', '1'}},
    {Codec::kMpeg4, "MPEG-4", {'m', 'p', '4', 'v'}},
    {Codec::kMjpeg, "Motion JPEG", {'M', 'J', 'P', 'G'}},
}};

bool fits(const Encoding& encoding, Codec wanted) {
  return wanted == Codec::kAuto || wanted == encoding.codec;
}

bool open_writer(cv::VideoWriter& writer, const fs::path& file, const Encoding& encoding,
                 double frame_rate_hz, cv::Size size) {
  const auto& t = encoding.tag;
  const int tag = cv::VideoWriter::fourcc(t[0], t[1], t[2], t[3]);
  if (writer.open(file.string(), cv::CAP_FFMPEG, tag, frame_rate_hz, size)) return true;
  // OpenCV has its own Motion JPEG for builds without ffmpeg
  return encoding.codec == Codec::kMjpeg && file.extension() == ".avi" &&
         writer.open(file.string(), cv::CAP_OPENCV_MJPEG, tag, frame_rate_hz, size);
}

/// Frames that can be read back from the file's index.
std::int64_t frames_in(const fs::path& file) {
  // of the two that can have written it: trying every backend there is costs time, and some leak
  cv::VideoCapture capture(file.string(), cv::CAP_FFMPEG);
  if (!capture.isOpened()) capture.open(file.string(), cv::CAP_OPENCV_MJPEG);
  cv::Mat first;
  if (!capture.isOpened() || !capture.read(first)) return 0;
  return static_cast<std::int64_t>(capture.get(cv::CAP_PROP_FRAME_COUNT) + 0.5);
}

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& extension) {
    static int count = 0;
    path_ = fs::temp_directory_path() / ("plaza-codec-" + std::to_string(::getpid()) + "-" +
                                         std::to_string(count++) + extension);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

std::vector<std::string> codec_names() { return {"auto", "h264", "mpeg4", "mjpeg"}; }

const std::vector<std::string>& video_extensions() {
  static const std::vector<std::string> extensions = {".mp4", ".mkv", ".mov", ".avi"};
  return extensions;
}

bool can_write(const std::string& extension, Codec codec) {
  const TemporaryFile file(extension);
  const cv::Mat image(64, 64, CV_8UC3, cv::Scalar(40, 80, 120));
  for (const Encoding& encoding : kEncodings) {
    if (!fits(encoding, codec)) continue;
    cv::VideoWriter writer;
    if (!open_writer(writer, file.path(), encoding, 10, image.size())) continue;
    writer.write(image);
    writer.release();
    if (frames_in(file.path()) == 1) return true;
  }
  return false;
}

VideoFile::VideoFile(fs::path file, Codec codec, double frame_rate_hz, cv::Size size)
    : file_(std::move(file)), size_(size) {
  unfinished_ =
      file_.parent_path() / (file_.stem().string() + ".part" + file_.extension().string());
  if (!std::ofstream(unfinished_, std::ios::binary)) fail("cannot be created");
  for (const Encoding& encoding : kEncodings) {
    if (!fits(encoding, codec)) continue;
    if (open_writer(writer_, unfinished_, encoding, frame_rate_hz, size)) {
      encoding_ = encoding.name;
      if (codec == Codec::kAuto && encoding.codec != Codec::kH264) {
        encoding_ += ", since this OpenCV cannot write H.264 into " + file_.extension().string();
      }
      open_ = true;
      return;
    }
  }
  std::error_code ignored;
  fs::remove(unfinished_, ignored);
  throw UserError("cannot encode '" + file_.string() + "' as " +
                  codec_names().at(static_cast<std::size_t>(codec)) +
                  ": this OpenCV has no writer for it; choose another \"codec\" or a \"file\" that "
                  "ends in .avi");
}

VideoFile::~VideoFile() {
  if (!open_) return;
  writer_.release();
  std::error_code ignored;  // nobody closed it: an exception is on its way and tells what happened
  fs::remove(unfinished_, ignored);
}

void VideoFile::fail(const std::string& why) const {
  throw UserError("video '" + file_.string() + "' " + why + ": " +
                  drawing::free_space_text(file_.parent_path()) +
                  "; check that the folder exists, may be written to and has room (--out)");
}

void VideoFile::check_space() const {
  std::error_code error;
  const fs::space_info space = fs::space(file_.parent_path(), error);
  // one picture without compression: what the encoder may want to write next
  const auto picture = static_cast<std::uintmax_t>(size_.area()) * 3;
  if (!error && space.available < picture)
    fail("has no room to grow after frame " + std::to_string(frames_));
}

void VideoFile::write(const cv::Mat& image) {
  if (image.size() != size_ || image.type() != CV_8UC3) {
    throw std::invalid_argument("a video's frames all have the size it was opened with");
  }
  constexpr std::int64_t kBetweenChecks = 64;
  if (frames_ % kBetweenChecks == 0) check_space();
  writer_.write(image);
  ++frames_;
}

void VideoFile::close() {
  if (!open_) return;
  writer_.release();
  open_ = false;
  std::error_code error;
  if (frames_ == 0) {
    fs::remove(unfinished_, error);
    return;
  }
  const std::int64_t found = frames_in(unfinished_);
  if (found != frames_) {
    fs::remove(unfinished_, error);
    fail("holds " + std::to_string(found) + " of " + std::to_string(frames_) +
         " frames after writing; the disk may have been full");
  }
  fs::rename(unfinished_, file_, error);
  if (error)
    fail("cannot be renamed from '" + unfinished_.string() + "' (" + error.message() + ")");
}

}  // namespace plaza::overlay
