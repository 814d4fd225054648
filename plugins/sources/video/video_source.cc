#include "plugins/sources/video/video_source.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "plaza/core/parallel.h"
#include "plaza/data/frames.h"
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
  try {
    VideoFile video(file);
    if (!video.reach(0)) {
      return file.string() +
             " has no frame that can be decoded; it is damaged or its recording failed";
    }
    const VideoHeader& header = video.header();
    if (header.width != camera.width() || header.height != camera.height()) {
      return file.string() + " is " + size_text(header.width, header.height) +
             ", the calibration of camera '" + camera.name() + "' is for " +
             size_text(camera.width(), camera.height()) +
             "; give the video that was calibrated, convert it, or correct the image size in the "
             "scene";
    }
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
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
  std::vector<std::pair<const Camera*, std::filesystem::path>> files;
  for (const auto& [name, file] : options_.files) {
    if (const auto camera = scene_->camera_index(name)) {
      files.emplace_back(&scene_->cameras[*camera], file);
    }
  }
  std::vector<std::string> found(files.size());
  parallel_for(files.size(),
               [&](std::size_t i) { found[i] = video_fault(*files[i].first, files[i].second); });
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (found[i].empty()) continue;
    faults.push_back(fault_at(entry_pointer("files", files[i].first->name()),
                              "camera '" + files[i].first->name() + "': " + found[i]));
  }
  return faults;
}

SourceInfo VideoSource::do_open() {
  views_.clear();
  for (std::size_t camera = 0; camera < scene_->cameras.size(); ++camera) {
    const auto file = options_.files.find(scene_->cameras[camera].name());
    if (file == options_.files.end()) continue;
    with_camera(scene_->cameras[camera], std::nullopt, [&] {
      views_.push_back({camera, std::make_unique<VideoFile>(file->second)});
    });
  }
  if (views_.empty()) throw UserError("no camera of the scene has a video in \"files\"");
  SourceInfo info;
  for (const View& view : views_) {
    const std::int64_t count = view.video->header().frame_count;
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
  std::vector<char> reached(views_.size());
  parallel_for(views_.size(), [&](std::size_t i) {
    with_camera(scene_->cameras[views_[i].camera], frame,
                [&] { reached[i] = views_[i].video->reach(file_frame(frame)) ? 1 : 0; });
  });
  const auto over = static_cast<std::size_t>(std::ranges::count(reached, 0));
  if (!at_end(over)) return;
  const auto ended = std::ranges::find(reached, 0) - reached.begin();
  const View& view = views_[static_cast<std::size_t>(ended)];
  with_camera(scene_->cameras[view.camera], frame, [&] {
    throw UserError("frame " + std::to_string(frame + 1) +
                    " is beyond the end: " + view.video->path().string() + " gives " +
                    std::to_string(run_frames(view.video->end().value_or(0))) + " frames");
  });
}

bool VideoSource::at_end(std::size_t ended) const {
  return options_.uneven == Uneven::kShortest ? ended > 0 : ended == views_.size();
}

cv::Mat VideoSource::read_view(const View& view, std::int64_t frame, char& ended) const {
  std::optional<cv::Mat> image = view.video->read(file_frame(frame));
  if (!image) {
    check_end(*view.video);
    ended = 1;
    return {};
  }
  const Camera& camera = scene_->cameras[view.camera];
  if (!image->empty() && (image->cols != camera.width() || image->rows != camera.height())) {
    throw UserError("frame " + std::to_string(frame + 1) + " of " + view.video->path().string() +
                    " is " + size_text(image->cols, image->rows) + ", the calibration is for " +
                    size_text(camera.width(), camera.height()) +
                    "; cut the file there, or convert all of it to one size");
  }
  return std::move(*image);
}

bool VideoSource::do_read(NodeIo& io) {
  auto frames = std::make_shared<FrameSet>();
  frames->frame = io.frame();
  frames->time_ns = io.time_ns();
  frames->views.resize(scene_->cameras.size());
  std::vector<char> ended(views_.size());
  parallel_for(views_.size(), [&](std::size_t i) {
    const std::size_t camera = views_[i].camera;
    frames->views[camera] = with_camera(scene_->cameras[camera], io.frame(),
                                        [&] { return read_view(views_[i], io.frame(), ended[i]); });
  });
  if (at_end(static_cast<std::size_t>(std::ranges::count(ended, 1)))) return false;
  io.out(0, std::move(frames));
  return true;
}

std::string VideoSource::do_content_key() const {
  std::string key;
  for (const auto& [camera, file] : options_.files) key += camera + " " + file_stamp(file) + "\n";
  return key;
}

}  // namespace plaza::sources
