#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "plaza/core/diagnostic.h"

namespace plaza::overlay {

enum class Codec { kAuto, kH264, kMpeg4, kMjpeg };

/// Names in the order of Codec, as pipelines spell them.
std::vector<std::string> codec_names();

/// The extensions a video file may have, lower case, with their dots.
const std::vector<std::string>& video_extensions();

/// True when this machine's OpenCV can write files like `file` with `codec`, found out by writing a
/// tiny one into the system's folder for temporary files.
bool can_write(const std::string& extension, Codec codec);

/// A video that is either whole or not there: frames go to a neighbour ("overlay.part.mp4"), which
/// gets its name only after it has been read back. OpenCV's writer itself never says that it
/// failed.
class VideoFile {
 public:
  /// Throws UserError naming file and remedy when the folder cannot be written to, or OpenCV cannot
  /// encode. kAuto takes the first of H.264, MPEG-4 and Motion JPEG that works.
  VideoFile(std::filesystem::path file, Codec codec, double frame_rate_hz, cv::Size size);
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// `image`: BGR of the size given.
  void write(const cv::Mat& image);
  /// Throws UserError when what is on disk does not hold every frame. Without any frame, leaves no
  /// file.
  void close();

  const std::filesystem::path& file() const { return file_; }
  /// "H.264"; with a reason when it is not the first choice.
  const std::string& encoding() const { return encoding_; }
  std::int64_t frames() const { return frames_; }

 private:
  void fail(const std::string& why) const;
  void check_space() const;

  std::filesystem::path file_;
  std::filesystem::path unfinished_;
  std::string encoding_;
  cv::VideoWriter writer_;
  cv::Size size_;
  std::int64_t frames_ = 0;
  bool open_ = false;
};

}  // namespace plaza::overlay
