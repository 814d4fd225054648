#include "plugins/sources/detections/ground_truth_source.h"

#include <utility>

#include "plaza/io/mot_rows.h"
#include "plugins/sources/common/camera_files.h"
#include "plugins/sources/detections/row_file.h"

namespace plaza::sources {

Declaration<GroundTruthSource::Options> GroundTruthSource::declare() {
  Parameters<Options> p;
  p.value("files", &Options::files)
      .meaning(
          "MOTChallenge file of each annotated camera, by the camera's name in the scene: "
          "frame,id,left,top,width,height,confidence, then class,visibility or x,y,z; frames from "
          "1, pixels, metres; ids are shared by all cameras; rows with confidence 0 or another "
          "class than 1 do not count");
  p.value("ground", &Options::ground)
      .meaning(
          "file of positions and headings: frame,id,x_m,y_m[,heading_deg], frames from 1, metres, "
          "degrees; goes before positions in \"files\"");
  p.value("every", &Options::every)
      .at_least(1)
      .meaning(
          "every how many frames people were annotated, in step with the first frame that has "
          "rows")
      .source("thesis Table 3.2");
  p.value("interpolate", &Options::interpolate)
      .meaning(
          "fill in the frames between annotated ones on straight lines, for people who are in "
          "both; "
          "otherwise they count for nothing");
  p.value("frames", &Options::frames)
      .at_least(1)
      .meaning(
          "number of frames that were annotated; not set: to the last frame that has rows. Frames "
          "beyond count for nothing");
  p.value("area_only", &Options::area_only)
      .meaning(
          "leave out people who stand outside the scene's ground area in that frame; people "
          "without "
          "a position stay");
  return Declaration<Options>("ground-truth",
                              "Gives the true people, for evaluators and pictures only.")
      .output<GroundTruth>("true people of all views")
      .parameters(std::move(p));
}

GroundTruthSource::GroundTruthSource(const Options& options, const BuildContext& context)
    : options_(options),
      scene_(context.scene),
      table_(
          {.every = options.every, .interpolate = options.interpolate, .frames = options.frames}) {
  Diagnostics faults;
  if (options_.files.empty() && !options_.ground) {
    faults.push_back(
        fault_at("/files",
                 "there is nothing to read: give \"files\" with boxes per camera, \"ground\" with "
                 "positions, or both"));
  }
  if (options_.interpolate && options_.every == 1) {
    faults.push_back(
        fault_at("/interpolate",
                 "there is nothing between frames that are all annotated; set \"every\" "
                 "to their distance, or leave this out"));
  }
  if (!faults.empty()) throw UserError(faults);
}

TruthTable GroundTruthSource::load(Diagnostics& faults) const {
  TruthTable table(
      {.every = options_.every, .interpolate = options_.interpolate, .frames = options_.frames});
  for (Diagnostic& fault : check_known_cameras(*scene_, "files", options_.files)) {
    faults.push_back(std::move(fault));
  }
  RowLimits limits;
  limits.last_frame = options_.frames;
  for (std::size_t c = 0; c < scene_->cameras.size(); ++c) {
    const std::string& name = scene_->cameras[c].name();
    const auto file = options_.files.find(name);
    if (file == options_.files.end()) continue;
    const auto rows = rows_of(
        file->second, entry_pointer("files", name),
        [&](const std::filesystem::path& path) { return read_mot_rows(path, limits); }, faults);
    table.add_boxes(c, rows, file->second.string(), faults);
  }
  if (options_.ground) {
    const auto rows = rows_of(
        *options_.ground, "/ground",
        [&](const std::filesystem::path& path) { return read_ground_rows(path, limits); }, faults);
    table.add_ground(rows, options_.ground->string(), faults);
  }
  table.finish(faults);
  return table;
}

Diagnostics GroundTruthSource::do_check() const {
  Diagnostics faults;
  load(faults);
  return faults;
}

SourceInfo GroundTruthSource::do_open() {
  Diagnostics faults;
  table_ = load(faults);
  if (!faults.empty()) throw UserError(faults);
  return {.frame_count = table_.frames()};
}

void GroundTruthSource::do_seek(std::int64_t frame) {
  if (role() == SourceRole::kFollower || frame < table_.frames()) return;
  throw UserError("frame " + std::to_string(frame + 1) +
                  " is beyond the end: the ground truth has " + std::to_string(table_.frames()) +
                  " frames");
}

bool GroundTruthSource::do_read(NodeIo& io) {
  if (role() == SourceRole::kClock && io.frame() >= table_.frames()) return false;
  auto truth = std::make_shared<GroundTruth>(table_.at(io.frame()));
  if (options_.area_only) {
    std::erase_if(truth->people, [&](const TruePerson& person) {
      return person.position_m && !scene_->area.contains(*person.position_m);
    });
  }
  io.out(0, std::move(truth));
  return true;
}

std::string GroundTruthSource::do_content_key() const {
  std::string key;
  for (const auto& [camera, file] : options_.files) key += camera + " " + file_stamp(file) + "\n";
  if (options_.ground) key += file_stamp(*options_.ground) + "\n";
  return key;
}

}  // namespace plaza::sources
