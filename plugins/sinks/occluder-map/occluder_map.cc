#include "plugins/sinks/occluder-map/occluder_map.h"

#include <opencv2/imgproc.hpp>

#include "plaza/data/evidence.h"
#include "plaza/data/frames.h"
#include "plaza/data/observation.h"
#include "plaza/io/output_file.h"
#include "plugins/sinks/drawing/canvas.h"
#include "plugins/sinks/drawing/picture_file.h"

namespace plaza::occluder_map {
namespace {

constexpr std::size_t kMasks = 0, kPeople = 1, kFrames = 2;
constexpr double kTintShare = 0.55;  ///< of the map over the image

const drawing::Color kSeen(80, 160, 40), kHidden(40, 40, 230), kOutline(0, 230, 255);

/// One occluder as the scene file has it.
std::string entry_of(const std::string& camera, std::size_t number, const Polygon& polygon) {
  nlohmann::ordered_json entry = {{"camera", camera},
                                  {"name", "learned " + std::to_string(number)}};
  for (const cv::Point& p : polygon) entry["polygon_px"].push_back({p.x, p.y});
  return "    " + entry.dump();
}

}  // namespace

Declaration<OccluderMap::Options> OccluderMap::declare() {
  Parameters<Options> p;
  p.part("shape", "shape", "cylinder").meaning("what people look like");
  p.value("min_probability", &Options::min_probability)
      .at_least(0)
      .at_most(1)
      .meaning("observations that are less sure are left out");
  p.value("least_covered", &Options::least_covered)
      .at_least(1)
      .meaning("so many people, counted frame by frame, must have covered a pixel");
  p.value("most_seen", &Options::most_seen)
      .at_least(0)
      .at_most(1)
      .meaning("share of them that are seen in a pixel where something hides them");
  p.value("bridge_px", &Options::bridge_px)
      .unit("px")
      .at_least(0)
      .at_most(1000)
      .meaning("gaps so wide between hidden pixels are hidden too where nobody covered them");
  p.value("least_area_px", &Options::least_area_px)
      .unit("px")
      .at_least(1)
      .meaning("smaller regions are taken for chance");
  return Declaration<Options>("occluder-map",
                              "Learns what hides people in each view: where they stand and are "
                              "never seen. Writes a scene's occluders.")
      .input<ForegroundMask>("where something was seen")
      .input<Observations>("where people stand")
      .optional_input<FrameSet>("what the map is drawn on")
      .parameters(std::move(p));
}

OccluderMap::OccluderMap(const Options& options, const BuildContext& context)
    : options_(options),
      name_(context.name),
      folder_(context.output_folder),
      scene_(context.scene),
      shape_(context.part<ShapeModel>("shape")),
      images_(context.scene->cameras.size()) {
  for (const Camera& camera : scene_->cameras) {
    counts_.emplace_back(cv::Size(camera.width(), camera.height()));
  }
}

void OccluderMap::do_write(const NodeIo& io) {
  const auto& masks = io.in<ForegroundMask>(kMasks).views;
  const auto& people = io.in<Observations>(kPeople).items;
  const auto* frames = io.find<FrameSet>(kFrames);
  for (std::size_t c = 0; c < counts_.size(); ++c) {
    if (frames != nullptr && !frames->views[c].empty()) images_[c] = frames->views[c];
    if (c >= masks.size() || masks[c].empty()) continue;
    for (const Observation& person : people) {
      if (person.probability < options_.min_probability) continue;
      counts_[c].add(shape_->silhouette({person.position_m, 0, 1}, scene_->cameras[c]), masks[c]);
    }
  }
}

cv::Mat OccluderMap::picture(std::size_t camera, const std::vector<Polygon>& occluders) const {
  const cv::Mat share = counts_[camera].share_seen(options_.least_covered);
  cv::Mat image = images_[camera].empty() ? cv::Mat(share.size(), CV_8UC3, cv::Scalar::all(60))
                                          : images_[camera].clone();
  cv::Mat layer = image.clone();
  for (int y = 0; y < share.rows; ++y) {
    for (int x = 0; x < share.cols; ++x) {
      const float s = share.at<float>(y, x);
      if (s < 0) continue;
      const drawing::Color color = drawing::mix(kSeen, kHidden, static_cast<double>(s));
      layer.at<cv::Vec3b>(y, x) = {cv::saturate_cast<uchar>(color[0]),
                                   cv::saturate_cast<uchar>(color[1]),
                                   cv::saturate_cast<uchar>(color[2])};
    }
  }
  drawing::blend(image, layer, kTintShare);
  for (const Polygon& polygon : occluders) {
    drawing::draw_seamed_path(image, drawing::Path(polygon.begin(), polygon.end()), true,
                              {kOutline, 2});
  }
  return image;
}

std::vector<Artifact> OccluderMap::do_finish(bool /*complete*/) {
  std::vector<Artifact> artifacts;
  std::string entries;
  for (std::size_t c = 0; c < counts_.size(); ++c) {
    const std::string& camera = scene_->cameras[c].name();
    const std::vector<Polygon> occluders = counts_[c].occluders(criterion());
    for (std::size_t i = 0; i < occluders.size(); ++i) {
      entries += (entries.empty() ? "" : ",\n") + entry_of(camera, i + 1, occluders[i]);
    }
    const std::filesystem::path file = folder_ / (name_ + "." + camera + ".png");
    drawing::write_png(file, picture(c, occluders));
    artifacts.push_back({file, "where people were seen (green) or only known to be (red) in " +
                                   camera + ", and what hides them (outlined)"});
  }
  OutputFile out(folder_ / (name_ + ".json"));
  out.write("{\n  \"occluders\": [\n" + entries + "\n  ]\n}\n");
  out.commit();
  artifacts.push_back({out.file(), "what hides people, for the scene's \"occluders\""});
  return artifacts;
}

}  // namespace plaza::occluder_map
