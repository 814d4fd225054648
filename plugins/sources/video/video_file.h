#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace plaza::sources {

/// What a video's header says. Frame counts and rates in headers are claims, not facts.
struct VideoHeader {
  int width = 0;
  int height = 0;
  double frame_rate_hz = 0;
  std::int64_t frame_count = 0;  ///< <= 0: not said
};

/// One video file, read by exact frame number.
///
/// OpenCV's own seeking (CAP_PROP_POS_FRAMES) lands on key frames or beside them with many codecs.
/// Here a position is only ever reached by decoding up to it: going back opens the file again. So
/// frame k is the same image whether one reads up to it or jumps to it.
///
/// A frame that cannot be decoded keeps its number and has no image: OpenCV leaves it out without a
/// word, which would shift all later frames. The container's time stamps tell how many were left
/// out (whole frame periods of the header's rate); where they say nothing usable, failed decoding
/// attempts do.
class VideoFile {
 public:
  /// Throws UserError when the file is no video that can be decoded here.
  explicit VideoFile(std::filesystem::path file);
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  const std::filesystem::path& path() const { return file_; }
  const VideoHeader& header() const { return header_; }

  /// The image of a frame (from 0): 8-bit BGR; empty where the file has none for it; nothing at or
  /// beyond the end. Throws UserError when the coded picture size changes on the way (Motion JPEG;
  /// other codecs do not show it through OpenCV).
  std::optional<cv::Mat> read(std::int64_t frame);
  /// Like read() without making the image; false at or beyond the end.
  bool reach(std::int64_t frame);
  /// Number of frames, known once the end was reached.
  std::optional<std::int64_t> end() const { return end_; }

 private:
  class Decoder;
  void rewind();
  void advance();

  std::filesystem::path file_;
  VideoHeader header_;
  std::unique_ptr<Decoder> decoder_;
  std::int64_t before_ = -1;  ///< frame of the picture before the one held; between them is a gap
  std::int64_t held_ = -1;    ///< frame whose picture the decoder holds; -1: none yet
  std::optional<std::int64_t> end_;
  bool at_end_ = false;
};

}  // namespace plaza::sources
