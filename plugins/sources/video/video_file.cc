#include "plugins/sources/video/video_file.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/version.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <utility>
#include <vector>

#include "plaza/core/error.h"
#include "plugins/sources/common/jpeg.h"

namespace plaza::sources {
namespace {

// A grab() at the end of the file and one of a broken packet look the same. At the end further
// attempts cost nothing, so as many are made as packets can still be there, within reason.
constexpr std::int64_t kAttemptsBeyondHeader = 16;
constexpr std::int64_t kMostAttempts = 100'000;

// Time stamps are trusted where they fall on whole frame periods of the header's rate: a container
// of constant rate. Others (variable rate) are left alone and frames count as they come.
constexpr double kPeriodTolerance = 0.1;

std::vector<int> open_parameters() {
#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7)
  // cameras are decoded side by side; one thread each conceals errors the same way on every machine
  return {cv::CAP_PROP_N_THREADS, 1};
#else
  return {};
#endif
}

bool open_capture(cv::VideoCapture& capture, const std::filesystem::path& file) {
  return capture.open(file.string(), cv::CAP_FFMPEG, open_parameters());
}

}  // namespace

// Reads the coded size of each Motion JPEG packet beside the decoder. OpenCV converts with the
// header's size whatever comes: a smaller image would leave the lower part of an older one in
// place.
class MotionJpegSizes {
 public:
  explicit MotionJpegSizes(const std::filesystem::path& file) {
    active_ = open_capture(packets_, file) && packets_.set(cv::CAP_PROP_FORMAT, -1);
  }
  JpegSize first() const { return first_.value_or(JpegSize{}); }
  /// Looks at the next packet; its size when it is another one than the first packet's.
  std::optional<JpegSize> next_change() {
    if (!active_ || !packets_.grab()) return std::nullopt;
    cv::Mat packet;
    if (!packets_.retrieve(packet) || packet.empty() || !packet.isContinuous()) return std::nullopt;
    const auto outline =
        jpeg_outline({packet.ptr<std::uint8_t>(), packet.total() * packet.elemSize()});
    if (!outline || !outline->size) return std::nullopt;
    if (!first_) first_ = outline->size;
    return *outline->size == *first_ ? std::nullopt : outline->size;
  }

 private:
  cv::VideoCapture packets_;
  bool active_ = false;
  std::optional<JpegSize> first_;
};

class VideoFile::Decoder {
 public:
  explicit Decoder(const std::filesystem::path& file) {
    if (!open_capture(capture_, file)) {
      throw UserError(
          file.string() +
          " is not a video that can be decoded here (OpenCV with FFmpeg); if a player shows "
          "it, convert it, for example to MP4 with H.264; a file cut off before its index is "
          "written cannot be read at all");
    }
    const int fourcc = static_cast<int>(capture_.get(cv::CAP_PROP_FOURCC));
    if (fourcc == cv::VideoWriter::fourcc('M', 'J', 'P', 'G')) sizes_.emplace(file);
  }

  VideoHeader header() const {
    const double rate = capture_.get(cv::CAP_PROP_FPS);
    const double count = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    return {.width = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_WIDTH)),
            .height = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_HEIGHT)),
            .frame_rate_hz = std::isfinite(rate) && rate > 0 ? rate : 0,
            .frame_count = count >= 1 && count < 1e12 ? std::llround(count) : 0};
  }

  /// Decodes the next picture; the number of frames left out before it, or nothing at the end.
  /// `position` is the number of the frame that comes next when nothing is left out.
  std::optional<std::int64_t> next(std::int64_t position, const VideoHeader& header,
                                   const std::filesystem::path& file) {
    const std::int64_t attempts =
        std::clamp<std::int64_t>(header.frame_count - position, 0, kMostAttempts) +
        kAttemptsBeyondHeader;
    for (std::int64_t failed = 0; failed < attempts; ++failed) {
      const bool grabbed = capture_.grab();
      if (sizes_) check_size(position + failed, file);
      if (grabbed) return left_out(position, failed, header);
    }
    return std::nullopt;
  }

  cv::Mat image() {
    cv::Mat image;  // a fresh one: earlier ones are shared with the pipeline
    if (!capture_.retrieve(image) || image.type() != CV_8UC3) return {};
    return image;
  }

 private:
  void check_size(std::int64_t frame, const std::filesystem::path& file) {
    const auto changed = sizes_->next_change();
    if (!changed) return;
    throw UserError("frame " + std::to_string(frame + 1) + " of " + file.string() +
                    " is coded as " + std::to_string(changed->width) + "x" +
                    std::to_string(changed->height) + ", the video began with " +
                    std::to_string(sizes_->first().width) + "x" +
                    std::to_string(sizes_->first().height) +
                    "; cut the file there, or convert all of it to one size");
  }

  std::int64_t left_out(std::int64_t position, std::int64_t failed, const VideoHeader& header) {
    const double time_ms = capture_.get(cv::CAP_PROP_POS_MSEC);
    const std::optional<double> before_ms = std::exchange(time_ms_, time_ms);
    if (!before_ms || !(time_ms > *before_ms) || header.frame_rate_hz <= 0) return failed;
    const double periods = (time_ms - *before_ms) * 1e-3 * header.frame_rate_hz;
    const double whole = std::round(periods);
    if (whole < 1 || std::abs(periods - whole) > kPeriodTolerance) return failed;
    const auto gap = static_cast<std::int64_t>(std::min(whole, 1e12)) - 1;
    // a damaged time stamp must not make up frames that the file cannot have
    return position + gap < header.frame_count ? gap : failed;
  }

  cv::VideoCapture capture_;
  std::optional<MotionJpegSizes> sizes_;
  std::optional<double> time_ms_;  // of the latest picture
};

VideoFile::VideoFile(std::filesystem::path file) : file_(std::move(file)) {
  rewind();
  header_ = decoder_->header();
}
VideoFile::~VideoFile() = default;

void VideoFile::rewind() {
  decoder_ = std::make_unique<Decoder>(file_);
  before_ = held_ = -1;
  at_end_ = false;
}

void VideoFile::advance() {
  // taken out for the time of the call: after an error it is at no known position
  std::unique_ptr<Decoder> decoder = std::move(decoder_);
  const std::int64_t position = held_ + 1;
  if (const auto left_out = decoder->next(position, header_, file_)) {
    before_ = held_;
    held_ = position + *left_out;
  } else {
    at_end_ = true;
    end_ = position;
  }
  decoder_ = std::move(decoder);
}

bool VideoFile::reach(std::int64_t frame) {
  if (end_ && frame >= *end_) return false;
  // a failed attempt to decode beyond the last picture has dropped that picture
  if (!decoder_ || frame <= before_ || (at_end_ && frame == held_)) rewind();
  while (!at_end_ && held_ < frame) advance();
  return held_ >= frame;
}

std::optional<cv::Mat> VideoFile::read(std::int64_t frame) {
  if (!reach(frame)) return std::nullopt;
  return held_ == frame ? decoder_->image() : cv::Mat();
}

}  // namespace plaza::sources
