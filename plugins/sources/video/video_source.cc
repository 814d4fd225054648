#include "plugins/sources/video/video_source.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "plugins/sources/common/camera_files.h"

namespace plaza::sources {
namespace {

// A header's frame count is often wrong by a few. What is short by more than this is a damaged
// copy.
constexpr std::int64_t kMostMissingFrames = 2;
constexpr double kMostMissingShare = 0.01;

std::string number_text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

// What is wrong with a camera's file, as far as its header and first frame tell; empty: nothing.
std::string video_fault(const Camera& camera, const std::filesystem::path& file) {
  if (std::string fault = file_fault(file); !fault.empty()) return fault;
  VideoFile video(file);
  if (!video.reach(0)) {
    return file.string() +
           " has no frame that can be decoded; it is damaged or its recording failed";
  }
  const std::string fault = size_fault(camera, video.header().width, video.header().height);
  if (fault.empty()) return {};
  return file.string() + fault +
         "; give the video that was calibrated, convert it, or correct the image size in the scene";
}

}  // namespace

Declaration<VideoSource::Options> VideoSource::declare() {
  Parameters<Options> p;
  p.value("files", &Options::files)
      .required()
      .items(1)
      .meaning("video file of each camera, by the camera's name in the scene");
  p.value("missing_cameras", &Options::missing_cameras)
      .meaning("cameras of the scene that have no video; their view is empty in every frame");
  p.value("frame_rate_hz", &Options::frame_rate_hz)
      .unit("Hz")
      .above(0)
      .meaning(
          "true rate of the files where it is higher than the scene's: frames are then picked by "
          "time; "
          "not set: one video frame per frame of the scene, whatever rate the header claims");
  p.choice("uneven", &Options::uneven, {"shortest", "missing"})
      .meaning(
          "videos of different lengths: end with the shortest, or go on to the end of the longest "
          "with the "
          "others' views missing");
  p.choice("truncated", &Options::truncated, {"error", "end"})
      .meaning(
          "a video that ends well before its header's frame count (more than 2 frames and 1 %): "
          "stop with "
          "an error, or take it as its end");
  return Declaration<Options>("video", "Reads one video file per camera.")
      .output<FrameSet>("images of all cameras; a frame that cannot be decoded is a missing view")
      .parameters(std::move(p));
}

VideoSource::VideoSource(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene) {}

Diagnostics VideoSource::do_check() const {
  Diagnostics faults = check_cameras(*scene_, "files", options_.files, options_.missing_cameras);
  if (options_.frame_rate_hz && *options_.frame_rate_hz < scene_->frame_rate_hz) {
    faults.push_back(
        fault_at("/frame_rate_hz",
                 "the files' rate of " + number_text(*options_.frame_rate_hz) +
                     " Hz is below the scene's " + number_text(scene_->frame_rate_hz) +
                     " Hz, so there are no images for some frames; give the scene the rate of "
                     "its videos"));
  }
  const Diagnostics of_entries = check_entries(
      *scene_, "files", options_.files, [&](std::size_t c, const std::filesystem::path& file) {
        return video_fault(scene_->cameras[c], file);
      });
  faults.insert(faults.end(), of_entries.begin(), of_entries.end());
  return faults;
}

SourceInfo VideoSource::do_open() {
  videos_.clear();
  videos_.resize(scene_->cameras.size());
  uneven_end_.clear();
  for (std::size_t c = 0; c < videos_.size(); ++c) {
    const auto file = options_.files.find(scene_->cameras[c].name());
    if (file == options_.files.end()) continue;
    with_camera(scene_->cameras[c], std::nullopt,
                [&] { videos_[c] = std::make_unique<VideoFile>(file->second); });
  }
  if (std::ranges::all_of(videos_, [](const auto& video) { return video == nullptr; })) {
    throw UserError("no camera of the scene has a video in \"files\"");
  }
  SourceInfo info;
  for (const std::unique_ptr<VideoFile>& video : videos_) {
    if (!video) continue;
    const std::int64_t count = video->header().frame_count;
    if (count <= 0) return {};  // one that does not say makes the whole unknown
    const std::int64_t frames = run_frames(count);
    if (!info.frame_count) {
      info.frame_count = frames;
    } else if (options_.uneven == Uneven::kShortest) {
      info.frame_count = std::min(*info.frame_count, frames);
    } else {
      info.frame_count = std::max(*info.frame_count, frames);
    }
  }
  return info;
}

std::int64_t VideoSource::file_frame(std::int64_t frame) const {
  if (!options_.frame_rate_hz) return frame;
  return std::llround(static_cast<double>(frame) * *options_.frame_rate_hz / scene_->frame_rate_hz);
}

// How many frames of the run have their frame inside a file of that length.
std::int64_t VideoSource::run_frames(std::int64_t file_frames) const {
  if (!options_.frame_rate_hz) return file_frames;
  auto frames = static_cast<std::int64_t>(static_cast<double>(file_frames) * scene_->frame_rate_hz /
                                          *options_.frame_rate_hz);
  while (file_frame(frames) < file_frames) ++frames;
  while (frames > 0 && file_frame(frames - 1) >= file_frames) --frames;
  return frames;
}

void VideoSource::check_end(const VideoFile& video) const {
  if (options_.truncated == Truncated::kEnd || !video.end()) return;
  const std::int64_t promised = video.header().frame_count;
  const std::int64_t missing = promised - *video.end();
  if (missing <= kMostMissingFrames ||
      static_cast<double>(missing) <= kMostMissingShare * static_cast<double>(promised)) {
    return;
  }
  throw UserError(
      "after frame " + std::to_string(*video.end()) + " nothing more can be decoded of " +
      video.path().string() + ", its header promises " + std::to_string(promised) +
      " frames: the file is cut off or damaged; copy it again, or set \"truncated\": \"end\" to "
      "take this as its end");
}

void VideoSource::do_seek(std::int64_t frame) {
  std::vector<char> ended(videos_.size());
  parallel_for(videos_.size(), [&](std::size_t c) {
    if (!videos_[c]) return;
    with_camera(scene_->cameras[c], frame,
                [&] { ended[c] = videos_[c]->reach(file_frame(frame)) ? 0 : 1; });
  });
  if (!at_end(ended)) return;
  const auto first = static_cast<std::size_t>(std::ranges::find(ended, 1) - ended.begin());
  with_camera(scene_->cameras[first], frame, [&] {
    const VideoFile& video = *videos_[first];
    throw UserError("frame " + std::to_string(frame + 1) +
                    " is beyond the end: " + video.path().string() + " gives " +
                    std::to_string(run_frames(video.end().value_or(0))) + " frames");
  });
}

bool VideoSource::at_end(const std::vector<char>& ended) const {
  const auto over = std::ranges::count(ended, 1);
  if (options_.uneven == Uneven::kShortest) return over > 0;
  return over == std::ranges::count_if(videos_, [](const auto& video) { return video != nullptr; });
}

// Without a word a run that ends early would look whole. The headers of those that go on are not
// exact, and their ends were not reached.
void VideoSource::note_uneven_end(const std::vector<char>& ended, std::int64_t frames) {
  std::string over;
  std::string longer;
  for (std::size_t c = 0; c < videos_.size(); ++c) {
    if (!videos_[c]) continue;
    const std::string name = "'" + scene_->cameras[c].name() + "'";
    if (ended[c] == 1) {
      over += (over.empty() ? "" : ", ") + name;
      continue;
    }
    longer += (longer.empty() ? "" : ", ") + name;
    const std::int64_t promised = run_frames(videos_[c]->header().frame_count);
    if (promised > frames) longer += " (" + std::to_string(promised) + " by its header)";
  }
  if (longer.empty()) return;
  uneven_end_ = "the video of camera " + over + " ends after " + std::to_string(frames) +
                " frames, and the run with it, before " + longer +
                "; to go on without the views that have ended, set \"uneven\": \"missing\"";
}

std::vector<std::string> VideoSource::do_notes() const {
  if (uneven_end_.empty()) return {};
  return {uneven_end_};
}

cv::Mat VideoSource::read_view(std::size_t camera, std::int64_t frame, char& ended) const {
  if (!videos_[camera]) return {};
  VideoFile& video = *videos_[camera];
  std::optional<cv::Mat> image = video.read(file_frame(frame));
  if (!image) {
    check_end(video);
    ended = 1;
    return {};
  }
  const std::string fault =
      image->empty() ? "" : size_fault(scene_->cameras[camera], image->cols, image->rows);
  if (!fault.empty()) {
    throw UserError("frame " + std::to_string(frame + 1) + " of " + video.path().string() + fault +
                    "; cut the file there, or convert all of it to one size");
  }
  return std::move(*image);
}

bool VideoSource::do_read(NodeIo& io) {
  std::vector<char> ended(videos_.size());
  auto frames =
      read_views(*scene_, io, [&](std::size_t c) { return read_view(c, io.frame(), ended[c]); });
  if (at_end(ended)) {
    note_uneven_end(ended, io.frame());
    return false;
  }
  io.out(0, std::move(frames));
  return true;
}

std::string VideoSource::do_content_key() const {
  std::string key;
  for (const auto& [camera, file] : options_.files) key += camera + " " + file_stamp(file) + "\n";
  return key;
}

}  // namespace plaza::sources
