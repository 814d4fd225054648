#include "plugins/sources/images/images_source.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "plugins/sources/common/camera_files.h"
#include "plugins/sources/images/image_file.h"

namespace plaza::sources {
namespace {

// Numbers that are mostly gaps (time stamps, every tenth frame) would make a run of empty frames.
constexpr std::int64_t kMostFramesPerImage = 100;

}  // namespace

Declaration<ImagesSource::Options> ImagesSource::declare() {
  Parameters<Options> p;
  p.value("pattern", &Options::pattern)
      .required()
      .items(1)
      .meaning(
          "image files of each camera, by the camera's name in the scene, with {frame} (or "
          "printf's %06d) in place of the number: \"view1/{frame}.png\"");
  p.value("people_free", &Options::people_free)
      .meaning(
          "image files of the place without people, likewise, for those who learn from "
          "people-free frames; cameras may be left out; all numbers that there are count, whatever "
          "\"first\" and \"step\"");
  p.value("missing_cameras", &Options::missing_cameras)
      .meaning("cameras of the scene that have no images; their view is empty in every frame");
  p.value("first", &Options::first)
      .at_least(0)
      .meaning(
          "number of the first frame's files, lower ones are left out; not set: the lowest number "
          "of any camera");
  p.value("step", &Options::step)
      .at_least(1)
      .meaning(
          "difference between the numbers of successive frames; files in between are left out");
  p.choice("damaged", &Options::damaged, {"error", "missing"})
      .meaning(
          "a file that is cut off or cannot be decoded: stop with an error, or a missing view");
  return Declaration<Options>("images", "Reads numbered image files, one series per camera.")
      .output<FrameSet>("images of all cameras; a number without a file is a missing view")
      .parameters(std::move(p));
}

ImagesSource::ImagesSource(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene) {}

ImagesSource::Numbering ImagesSource::number_frames(const std::vector<ImageSeries>& series) const {
  std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
  std::int64_t highest = -1;
  std::int64_t images = 0;
  for (const ImageSeries& s : series) {
    if (s.files.empty()) continue;
    lowest = std::min(lowest, s.files.begin()->first);
    highest = std::max(highest, s.files.rbegin()->first);
    images += std::ssize(s.files);
  }
  if (images == 0) throw UserError("no camera of the scene has images");
  const std::int64_t first = options_.first.value_or(lowest);
  if (highest < first) {
    throw UserError("\"first\" is " + std::to_string(first) +
                    ", beyond the highest number of any image, " + std::to_string(highest));
  }
  const std::int64_t frames = (highest - first) / options_.step + 1;
  if (frames / kMostFramesPerImage > images) {
    throw UserError("the numbers run from " + std::to_string(first) + " to " +
                    std::to_string(highest) + ", which makes " + std::to_string(frames) +
                    " frames of " + std::to_string(images) +
                    " images; set \"step\" to the difference between two frames, or rename the "
                    "files");
  }
  return {.first = first, .frames = frames};
}

std::string ImagesSource::first_image_fault(const Camera& camera, const ImageSeries& series,
                                            std::int64_t from) const {
  const auto first = series.files.lower_bound(from);
  if (first == series.files.end()) {
    return "no image has the number " + std::to_string(from) + " (\"first\") or a higher one";
  }
  const DecodedImage decoded = read_image(first->second);
  if (decoded.image.empty()) {
    const bool accepted = decoded.damaged && options_.damaged == Damaged::kMissing;
    return accepted ? std::string() : decoded.fault;
  }
  const std::string fault = size_fault(camera, decoded.image.cols, decoded.image.rows);
  if (fault.empty()) return {};
  return first->second.string() + fault +
         "; give the images that were calibrated, convert them, or correct the image size in the "
         "scene";
}

Diagnostics ImagesSource::do_check() const {
  Diagnostics faults =
      check_cameras(*scene_, "pattern", options_.pattern, options_.missing_cameras);
  std::vector<ImageSeries> series(scene_->cameras.size());
  const Diagnostics of_entries = check_entries(
      *scene_, "pattern", options_.pattern,
      [&](std::size_t c, const std::filesystem::path& pattern) {
        series[c] = list_images(pattern);
        return first_image_fault(scene_->cameras[c], series[c], options_.first.value_or(0));
      });
  faults.insert(faults.end(), of_entries.begin(), of_entries.end());
  const Diagnostics unknown = check_known_cameras(*scene_, "people_free", options_.people_free);
  faults.insert(faults.end(), unknown.begin(), unknown.end());
  const Diagnostics of_people_free =
      check_entries(*scene_, "people_free", options_.people_free,
                    [&](std::size_t c, const std::filesystem::path& pattern) {
                      return first_image_fault(scene_->cameras[c], list_images(pattern), 0);
                    });
  faults.insert(faults.end(), of_people_free.begin(), of_people_free.end());
  if (!faults.empty()) return faults;
  try {
    number_frames(series);
  } catch (const UserError& error) {
    faults.push_back(fault_at("/pattern", error.what()));
  }
  return faults;
}

SourceInfo ImagesSource::do_open() {
  series_.assign(scene_->cameras.size(), {});
  for (std::size_t c = 0; c < scene_->cameras.size(); ++c) {
    const auto pattern = options_.pattern.find(scene_->cameras[c].name());
    if (pattern == options_.pattern.end()) continue;
    series_[c] =
        with_camera(scene_->cameras[c], std::nullopt, [&] { return list_images(pattern->second); });
  }
  numbering_ = number_frames(series_);
  people_free_.assign(scene_->cameras.size(), {});
  std::set<std::int64_t> numbers;
  for (std::size_t c = 0; c < scene_->cameras.size(); ++c) {
    const auto pattern = options_.people_free.find(scene_->cameras[c].name());
    if (pattern == options_.people_free.end()) continue;
    people_free_[c] =
        with_camera(scene_->cameras[c], std::nullopt, [&] { return list_images(pattern->second); });
    for (const auto& [number, file] : people_free_[c].files) numbers.insert(number);
  }
  people_free_numbers_.assign(numbers.begin(), numbers.end());
  return {.frame_count = numbering_.frames,
          .rereadable = true,
          .background_count = std::ssize(people_free_numbers_)};
}

void ImagesSource::do_seek(std::int64_t frame) {
  if (frame < numbering_.frames) return;
  throw UserError("frame " + std::to_string(frame + 1) + " is beyond the end: the images give " +
                  std::to_string(numbering_.frames) + " frames");
}

cv::Mat ImagesSource::read_file(std::size_t camera, const std::filesystem::path& file,
                                const std::string& what) const {
  DecodedImage decoded = read_image(file);
  if (decoded.image.empty()) {
    if (!decoded.damaged) throw UserError(what + decoded.fault);
    if (options_.damaged == Damaged::kMissing) return {};
    throw UserError(what + decoded.fault +
                    "; copy it again, delete it to run without this view in this frame, or set "
                    "\"damaged\": \"missing\" to do so with all damaged files");
  }
  if (const std::string fault =
          size_fault(scene_->cameras[camera], decoded.image.cols, decoded.image.rows);
      !fault.empty()) {
    throw UserError(what + file.string() + fault +
                    "; replace it, or delete it to run without this view in this frame");
  }
  return decoded.image;
}

cv::Mat ImagesSource::read_view(std::size_t camera, std::int64_t frame) const {
  const auto file = series_[camera].files.find(numbering_.first + frame * options_.step);
  if (file == series_[camera].files.end()) return {};
  return read_file(camera, file->second, "frame " + std::to_string(frame + 1) + ": ");
}

std::shared_ptr<const FrameSet> ImagesSource::do_background(std::int64_t index) {
  const std::int64_t number = people_free_numbers_.at(static_cast<std::size_t>(index));
  auto frames = std::make_shared<FrameSet>();
  frames->frame = index;
  frames->time_ns = scene_->time_of_frame(index);
  frames->views.resize(scene_->cameras.size());
  for (std::size_t c = 0; c < frames->views.size(); ++c) {
    const auto file = people_free_[c].files.find(number);
    if (file == people_free_[c].files.end()) continue;
    frames->views[c] = with_camera(scene_->cameras[c], std::nullopt, [&] {
      return read_file(c, file->second, "people-free image: ");
    });
  }
  return frames;
}

bool ImagesSource::do_read(NodeIo& io) {
  if (io.frame() >= numbering_.frames) return false;
  io.out(0, read_views(*scene_, io, [&](std::size_t c) { return read_view(c, io.frame()); }));
  return true;
}

std::string ImagesSource::do_content_key() const {
  std::string key;
  for (const auto* patterns : {&options_.pattern, &options_.people_free}) {
    for (const auto& [camera, pattern] : *patterns) {
      try {
        for (const auto& [number, file] : list_images(pattern).files) {
          key += camera + " " + file_stamp(file) + "\n";
        }
      } catch (const UserError& error) {
        key += camera + " " + error.what() + "\n";  // check() and open() report it
      }
    }
    key += "\n";
  }
  return key;
}

}  // namespace plaza::sources
