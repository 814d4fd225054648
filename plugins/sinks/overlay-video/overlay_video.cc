#include "plugins/sinks/overlay-video/overlay_video.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plaza/core/parallel.h"
#include "plugins/sinks/drawing/picture_file.h"

namespace plaza::overlay {
namespace fs = std::filesystem;
namespace {

constexpr double kLongestTrailGap_s = 1;

std::string text_of_time(std::int64_t time_ns) {
  const std::int64_t tenths = time_ns / 100'000'000;
  char text[48];
  std::snprintf(text, sizeof text, "%lld:%02lld.%lld", static_cast<long long>(tenths / 600),
                static_cast<long long>(tenths / 10 % 60), static_cast<long long>(tenths % 10));
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

std::set<std::int64_t> spread_frames(std::int64_t begin, std::int64_t end, std::int64_t count) {
  std::set<std::int64_t> frames;
  const std::int64_t length = end - begin;
  for (std::int64_t i = 0; i < std::min(count, length); ++i) {
    const std::int64_t parts = std::min(count, length);
    frames.insert(begin + (2 * i + 1) * length / (2 * parts));
  }
  return frames;
}

Declaration<OverlayVideo::Options> OverlayVideo::declare() {
  Parameters<Options> p;
  p.value("file", &Options::file)
      .meaning("name of the video in the output folder; .mp4, .mkv, .mov or .avi");
  p.choice("codec", &Options::codec, codec_names())
      .meaning(
          "how the video is encoded; auto takes the first of H.264, MPEG-4 and Motion JPEG that "
          "this machine's OpenCV can write");
  p.value("width_px", &Options::width_px)
      .unit("px")
      .at_least(320)
      .at_most(7680)
      .meaning("width of the whole picture, views and plan; an odd number is lowered by one");
  p.choice("draw", &Options::draw, {"boxes", "cylinders", "both"})
      .meaning(
          "what marks a person in the views: measured boxes (where there are none, the box of the "
          "scene's body), the scene's body as an upright cylinder, or both");
  p.value("trail_s", &Options::trail_s)
      .unit("s")
      .at_least(0)
      .at_most(3600)
      .meaning("how far back the trails on the ground reach; 0: no trails");
  p.value("truth", &Options::truth)
      .meaning("draw the ground truth's boxes and positions in thin white dashes");
  p.value("area", &Options::area).meaning("draw the border of the tracking area into the images");
  p.value("stills", &Options::stills)
      .at_least(0)
      .at_most(1000)
      .meaning("number of still pictures, spread evenly over the run");
  p.value("still_frames", &Options::still_frames)
      .at_least(1)
      .meaning(
          "further still pictures, by frame from 1 as in the files of results; frames outside "
          "of the run are left out");
  return Declaration<Options>(
             "overlay-video",
             "Video and still pictures of every view with people, their trails and "
             "a plan from above.")
      .input<FrameSet>("images, re-read after the stream")
      .input<Tracks>("who is where; only final rows are drawn")
      .optional_input<GroundTruth>("for \"truth\"")
      .parameters(std::move(p));
}

OverlayVideo::OverlayVideo(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene), folder_(context.output_folder) {}

Diagnostics OverlayVideo::do_check() const {
  Diagnostic fault;
  fault.pointer = "/file";
  fault.message = drawing::fault_of_file_name(options_.file);
  const std::string extension = fs::path(options_.file).extension().string();
  const auto& known = video_extensions();
  if (fault.message.empty() && std::find(known.begin(), known.end(), extension) == known.end()) {
    fault.message = "'" + options_.file + "' must end in one of " + joined(known);
  }
  if (fault.message.empty() && !can_write(extension, options_.codec)) {
    fault.pointer = "/codec";
    fault.message = "this machine's OpenCV cannot write " + extension + " files with codec \"" +
                    codec_names().at(static_cast<std::size_t>(options_.codec)) +
                    "\"; use \"auto\" or another extension in \"file\"";
  }
  if (fault.message.empty()) return {};
  return {fault};
}

void OverlayVideo::do_begin(std::int64_t begin_frame, std::int64_t end_frame) {
  begin_frame_ = begin_frame;
  end_frame_ = end_frame;
  std::vector<cv::Size> sizes;
  for (const Camera& camera : scene_->cameras) sizes.emplace_back(camera.width(), camera.height());
  const GroundArea extent = drawing::plan_extent(*scene_);
  const Eigen::Vector2d extent_m = extent.max_m - extent.min_m;
  layout_ = make_layout(sizes, extent_m.x() / extent_m.y(), options_.width_px);
  canvas_ = cv::Mat(layout_.canvas, CV_8UC3, drawing::dark_theme().paper);
  const double text_px = std::clamp(std::round(layout_.plan.width / 60.0), 7.0, 12.0);
  plan_ = drawing::draw_plan(*scene_, layout_.plan.size(), drawing::dark_theme(), {text_px, true});

  const double rate_hz = scene_->frame_rate_hz;
  trails_.emplace(std::llround(options_.trail_s * rate_hz));
  trail_gap_frames_ = std::max<std::int64_t>(1, std::llround(kLongestTrailGap_s * rate_hz));
  painters_.clear();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    painters_.emplace_back(*scene_, i, layout_.views[i].size(),
                           ViewStyle{options_.draw, options_.area, trail_gap_frames_});
  }

  stills_ = spread_frames(begin_frame, end_frame, options_.stills);
  for (const std::int64_t from_one : options_.still_frames) stills_.insert(from_one - 1);
  written_stills_.clear();
  video_ =
      std::make_unique<VideoFile>(folder_ / options_.file, options_.codec, rate_hz, layout_.canvas);
}

void OverlayVideo::do_render(const RenderFrame& frame) {
  if (options_.trail_s > 0) trails_->add(frame.frame, frame.tracks);
  const GroundTruth* truth = options_.truth ? frame.ground_truth : nullptr;
  const std::vector<cv::Mat>& images = frame.frames->views;
  // every body draws into a rectangle of its own
  parallel_for(painters_.size() + 1, [&](std::size_t i) {
    if (i == painters_.size()) {
      paint_plan(frame);
      return;
    }
    const ViewContent content{i < images.size() ? images[i] : cv::Mat(), frame.tracks, &*trails_,
                              truth};
    painters_[i].paint(canvas_(layout_.views[i]), content);
  });
  paint_header(frame);
  video_->write(canvas_);
  if (stills_.contains(frame.frame)) write_still(frame.frame);
}

void OverlayVideo::paint_header(const RenderFrame& frame) {
  const drawing::Theme& theme = drawing::dark_theme();
  cv::Mat header = canvas_(layout_.header);
  header.setTo(theme.paper);
  const double text_px = std::round(0.42 * header.rows);
  const double top = 0.5 * (header.rows - text_px);
  const double gap = layout_.views.front().x;
  const std::string people =
      std::to_string(frame.tracks.size()) + (frame.tracks.size() == 1 ? " person" : " people");
  const std::string right = people + "   " + text_of_time(frame.time_ns) + "   frame " +
                            std::to_string(frame.frame + 1) + " of " + std::to_string(end_frame_);
  drawing::draw_text(header, right, {header.cols - gap, top},
                     {text_px, theme.quiet_text, drawing::Anchor::kTopRight});
  const double room = header.cols - 4 * gap - drawing::text_size(right, text_px).width;
  if (drawing::text_size(scene_->name, text_px).width <= room) {
    drawing::draw_text(header, scene_->name, {gap, top}, {text_px, theme.text});
  }
}

void OverlayVideo::paint_plan(const RenderFrame& frame) {
  const drawing::Theme& theme = drawing::dark_theme();
  cv::Mat picture = canvas_(layout_.plan);
  plan_->picture.copyTo(picture);
  const drawing::PlanMap& map = plan_->map;
  const double text_px = std::clamp(std::round(layout_.plan.width / 50.0), 7.0, 14.0);
  if (options_.truth && frame.ground_truth) {
    for (const TruePerson& person : frame.ground_truth->people) {
      if (!person.position_m) continue;
      drawing::draw_ring(picture, map.pixel(*person.position_m), text_px, {theme.text, 1});
    }
  }
  for (const auto& [id, trail] : trails_->trails()) {
    for (const auto piece : drawing::unbroken_pieces(trail, trail_gap_frames_)) {
      drawing::Path path;
      for (const drawing::TrailPoint& p : piece) path.push_back(map.pixel(p.position_m));
      drawing::draw_path(picture, path, false, {drawing::color_of(id), 2});
    }
  }
  std::vector<drawing::PlanPerson> people;
  for (const TrackPoint& t : frame.tracks) {
    people.push_back({t.id, t.position_m, t.heading_rad, t.observed});
  }
  drawing::draw_people(picture, map, people, text_px, theme);
}

void OverlayVideo::write_still(std::int64_t frame) {
  char number[24];
  std::snprintf(number, sizeof number, "%06lld", static_cast<long long>(frame + 1));
  const fs::path file = folder_ / (fs::path(options_.file).stem().string() + "-" + number + ".png");
  drawing::write_png(file, canvas_);
  written_stills_.push_back(
      {file, "picture of all views and the plan, frame " + std::to_string(frame + 1)});
}

std::vector<Artifact> OverlayVideo::do_end(bool complete) {
  std::vector<Artifact> artifacts;
  if (video_) {
    video_->close();
    if (video_->frames() > 0) {
      std::string what = "video of all views and the plan (" + video_->encoding() + ")";
      if (!complete) {
        what += ", partial: the first " + std::to_string(video_->frames()) + " of " +
                std::to_string(end_frame_ - begin_frame_) + " frames";
      }
      artifacts.push_back({video_->file(), what});
    }
    video_.reset();
  }
  artifacts.insert(artifacts.end(), written_stills_.begin(), written_stills_.end());
  return artifacts;
}

}  // namespace plaza::overlay
