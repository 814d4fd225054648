#include "plugins/sources/detections/detections_source.h"

#include <algorithm>
#include <utility>

#include "plaza/data/frames.h"
#include "plaza/io/mot_rows.h"
#include "plugins/sources/common/camera_files.h"
#include "plugins/sources/detections/row_file.h"

namespace plaza::sources {

Declaration<DetectionsSource::Options> DetectionsSource::declare() {
  Parameters<Options> p;
  p.value("files", &Options::files)
      .required()
      .items(1)
      .meaning(
          "MOTChallenge file of each camera, by the camera's name in the scene: "
          "frame,id,left,top,width,height,score[,...], frames from 1, pixels; ids are not read");
  p.value("missing_cameras", &Options::missing_cameras)
      .meaning("cameras of the scene that have no file, and so never a detection");
  p.value("min_score", &Options::min_score)
      .meaning("rows with a lower score are left out; not set: none are");
  p.value("frames", &Options::frames)
      .at_least(1)
      .meaning(
          "number of frames that the detector saw; not set: the highest in the files, which is "
          "less "
          "where the last frames have no detection");
  return Declaration<Options>("detections",
                              "Gives the boxes of an image detector from MOTChallenge files.")
      .output<FrameSet>("as the first source of a pipeline: frames whose views are all missing")
      .output<Detections>("boxes of all views")
      .parameters(std::move(p));
}

DetectionsSource::DetectionsSource(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene) {}

DetectionsSource::Loaded DetectionsSource::load() const {
  Loaded loaded;
  loaded.faults = check_cameras(*scene_, "files", options_.files, options_.missing_cameras);
  loaded.views.resize(scene_->cameras.size());
  RowLimits limits;
  limits.last_frame = options_.frames;
  limits.unidentified = true;
  for (std::size_t c = 0; c < scene_->cameras.size(); ++c) {
    const std::string& name = scene_->cameras[c].name();
    const auto file = options_.files.find(name);
    if (file == options_.files.end()) continue;
    const std::vector<MotRow> rows = rows_of(
        file->second, entry_pointer("files", name),
        [&](const std::filesystem::path& path) { return read_mot_rows(path, limits); },
        loaded.faults);
    for (const MotRow& row : rows) {
      loaded.frames = std::max(loaded.frames, row.frame);
      if (options_.min_score && row.confidence < *options_.min_score) continue;
      loaded.views[c][row.frame - 1].push_back({.box = row.box, .score = row.confidence});
    }
  }
  if (options_.frames) loaded.frames = *options_.frames;
  return loaded;
}

Diagnostics DetectionsSource::do_check() const { return load().faults; }

SourceInfo DetectionsSource::do_open() {
  loaded_ = load();
  if (!loaded_.faults.empty()) throw UserError(loaded_.faults);
  return {.frame_count = loaded_.frames};
}

void DetectionsSource::do_seek(std::int64_t frame) {
  if (role() == SourceRole::kFollower || frame < loaded_.frames) return;
  throw UserError("frame " + std::to_string(frame + 1) + " is beyond the end: the files give " +
                  std::to_string(loaded_.frames) +
                  " frames; where the detector saw more, say so with \"frames\"");
}

bool DetectionsSource::do_read(NodeIo& io) {
  if (role() == SourceRole::kClock) {
    if (io.frame() >= loaded_.frames) return false;
    auto frames = std::make_shared<FrameSet>();
    frames->frame = io.frame();
    frames->time_ns = io.time_ns();
    frames->views.resize(scene_->cameras.size());
    io.out(0, std::move(frames));
  }
  auto detections = std::make_shared<Detections>();
  detections->views.resize(scene_->cameras.size());
  for (std::size_t c = 0; c < loaded_.views.size(); ++c) {
    const auto found = loaded_.views[c].find(io.frame());
    if (found != loaded_.views[c].end()) detections->views[c] = found->second;
  }
  io.out(1, std::move(detections));
  return true;
}

std::string DetectionsSource::do_content_key() const {
  std::string key;
  for (const auto& [camera, file] : options_.files) key += camera + " " + file_stamp(file) + "\n";
  return key;
}

}  // namespace plaza::sources
