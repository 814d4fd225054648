#include "plugins/sinks/image-data-set/image_data_set.h"

#include <algorithm>
#include <cstdio>
#include <istream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <ostream>
#include <utility>
#include <variant>

#include "plaza/core/parallel.h"

namespace plaza::data_set {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kImages = "images";
constexpr const char* kPeopleFree = "people-free";

std::string text(const char* format, auto... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

Json pair(double a, double b) { return Json::array({a, b}); }

Json numbers_of(const PinholeIntrinsics& in) {
  const Distortion& d = in.distortion;
  Json out;
  out["format"] = "pinhole";
  out["fx_px"] = in.fx_px;
  out["fy_px"] = in.fy_px;
  out["cx_px"] = in.cx_px;
  out["cy_px"] = in.cy_px;
  if (in.skew_px != 0) out["skew_px"] = in.skew_px;
  out["distortion"] = {d.k1, d.k2, d.p1, d.p2, d.k3};
  return out;
}

Json numbers_of(const TsaiIntrinsics& in) {
  Json out;
  out["format"] = "tsai";
  out["focal_mm"] = in.focal_mm;
  out["kappa1_per_mm2"] = in.kappa1_per_mm2;
  out["dpx_mm"] = in.dpx_mm;
  out["dpy_mm"] = in.dpy_mm;
  out["sx"] = in.sx;
  out["cx_px"] = in.cx_px;
  out["cy_px"] = in.cy_px;
  return out;
}

/// Of the camera as it is: a scene that had "calibrated_size" needs none any more.
Json calibration(const Camera& camera) {
  Json out = std::visit([](const auto& in) { return numbers_of(in); }, camera.intrinsics());
  for (int row = 0; row < 3; ++row) {
    const auto r = camera.pose().rotation.row(row);
    out["rotation"].push_back({r[0], r[1], r[2]});
    out["translation_m"].push_back(camera.pose().translation[row]);
  }
  return out;
}

}  // namespace

Declaration<ImageDataSet::Options> ImageDataSet::declare() {
  Parameters<Options> p;
  p.value("folder", &Options::folder)
      .meaning("name of the data set's folder below the run's output folder");
  p.choice("format", &Options::format, {"png", "jpeg"})
      .meaning("of the images: without loss, or a tenth of the size");
  p.value("jpeg_quality", &Options::jpeg_quality)
      .at_least(1)
      .at_most(100)
      .meaning("of \"jpeg\" images");
  p.value("people_free", &Options::people_free)
      .at_least(0)
      .meaning("how many people-free images to write, as far as the source has that many");
  return Declaration<Options>("image-data-set",
                              "Writes images, truth and calibration as a data set of files.")
      .input<FrameSet>("images to write")
      .optional_input<GroundTruth>("true people to write")
      .parameters(std::move(p));
}

ImageDataSet::ImageDataSet(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene), folder_(context.output_folder / options.folder) {}

Learner* ImageDataSet::learner() { return options_.people_free > 0 ? this : nullptr; }

std::optional<LearningPlan> ImageDataSet::do_plan() const {
  return LearningPlan{.people_free_only = true, .first = {}, .every = 1};
}

std::string ImageDataSet::encoded(const cv::Mat& image) const {
  if (image.empty()) return {};
  std::vector<unsigned char> bytes;
  const bool png = options_.format == Format::kPng;
  const std::vector<int> how = {png ? cv::IMWRITE_PNG_COMPRESSION : cv::IMWRITE_JPEG_QUALITY,
                                png ? 1 : options_.jpeg_quality};
  if (!cv::imencode(extension(), image, bytes, how)) {
    throw InternalError("an image could not be compressed");
  }
  return {bytes.begin(), bytes.end()};
}

void ImageDataSet::do_learn(const FrameSet& frames) {
  if (std::ssize(people_free_) >= options_.people_free) return;
  std::vector<std::string> views(frames.views.size());
  parallel_for(views.size(), [&](std::size_t c) { views[c] = encoded(frames.views[c]); });
  people_free_.push_back(std::move(views));
}

void ImageDataSet::do_finish(std::int64_t /*seen*/) {}  // a source may well have none

void ImageDataSet::do_save(std::ostream& out) const {
  out << people_free_.size() << '\n';
  for (const auto& views : people_free_) {
    for (const std::string& bytes : views) {
      out << bytes.size() << '\n';
      out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
  }
}

void ImageDataSet::do_load(std::istream& in) {
  const auto number = [&](std::size_t most) {
    std::size_t value = 0;
    if (!(in >> value) || in.get() != '\n' || value > most) {
      throw UserError("the stored people-free images are damaged");
    }
    return value;
  };
  people_free_.assign(number(static_cast<std::size_t>(options_.people_free)),
                      std::vector<std::string>(scene_->cameras.size()));
  for (auto& views : people_free_) {
    for (std::string& bytes : views) {
      bytes.resize(number(std::size_t{1} << 28));
      if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
        throw UserError("the stored people-free images are cut off");
      }
    }
  }
}

std::filesystem::path ImageDataSet::image_file(const char* kind, std::size_t camera,
                                               std::int64_t number) const {
  return folder_ / kind / scene_->cameras[camera].name() /
         (text("%06lld", static_cast<long long>(number)) + extension());
}

void ImageDataSet::begin() {
  begun_ = true;
  has_images_.assign(scene_->cameras.size(), 0);
  for (std::size_t c = 0; c < scene_->cameras.size(); ++c) {
    std::filesystem::create_directories(image_file(kImages, c, 1).parent_path());
    for (std::size_t i = 0; i < people_free_.size(); ++i) {
      if (people_free_[i][c].empty()) continue;
      const auto file = image_file(kPeopleFree, c, static_cast<std::int64_t>(i) + 1);
      std::filesystem::create_directories(file.parent_path());
      write_file(file, people_free_[i][c]);
    }
  }
}

void ImageDataSet::do_write(const NodeIo& io) {
  if (!begun_) begin();
  const auto& frames = io.in<FrameSet>(0);
  parallel_for(frames.views.size(), [&](std::size_t c) {
    if (frames.views[c].empty()) return;
    has_images_[c] = 1;
    write_file(image_file(kImages, c, io.frame() + 1), encoded(frames.views[c]));
  });
  if (const auto* truth = io.find<GroundTruth>(1); truth != nullptr && truth->annotated) {
    write_truth(*truth, io.frame() + 1);
  }
  frames_ = io.frame() + 1;
}

void ImageDataSet::do_write_rest(const NodeIo& /*io*/) {}

void ImageDataSet::write_truth(const GroundTruth& truth, std::int64_t frame) {
  if (!ground_) {
    ground_ = std::make_unique<OutputFile>(folder_ / "ground.csv");
    ground_->write("frame,id,x_m,y_m,heading_deg\n");
    for (const Camera& camera : scene_->cameras) {
      rows_.emplace_back(folder_ / ("gt." + camera.name() + ".txt"));
    }
  }
  const auto number = static_cast<long long>(frame);
  for (const TruePerson& person : truth.people) {
    const auto id = static_cast<long long>(person.id);
    for (const TrueView& view : person.views) {
      const Box& b = view.box;
      rows_.at(view.camera)
          .write(text("%lld,%lld,%.3f,%.3f,%.3f,%.3f,1,1,%.4f\n", number, id, b.left, b.top,
                      b.width, b.height, view.visibility));
    }
    if (!person.position_m) continue;
    std::string row =
        text("%lld,%lld,%.5f,%.5f", number, id, person.position_m->x(), person.position_m->y());
    row += person.heading_rad ? text(",%.4f", *person.heading_rad * 180 / std::numbers::pi) : ",";
    ground_->write(row + "\n");
  }
}

void ImageDataSet::write_scene() const {
  Json scene;
  scene["plaza_scene"] = 1;
  scene["name"] = scene_->name;
  scene["frame_rate_hz"] = scene_->frame_rate_hz;
  const GroundArea& area = scene_->area;
  scene["area"]["x_m"] = pair(area.min_m.x(), area.max_m.x());
  scene["area"]["y_m"] = pair(area.min_m.y(), area.max_m.y());
  scene["body"]["height_m"] = scene_->body.height_m;
  scene["body"]["radius_m"] = scene_->body.radius_m;
  for (const Camera& camera : scene_->cameras) {
    Json entry;
    entry["name"] = camera.name();
    entry["image_size"] = {camera.width(), camera.height()};
    entry["calibration"] = calibration(camera);
    scene["cameras"].push_back(std::move(entry));
  }
  for (const StaticOccluder& occluder : scene_->occluders) {
    Json entry;
    entry["camera"] = occluder.camera;
    entry["name"] = occluder.name;
    for (const Eigen::Vector2d& p : occluder.polygon_px) {
      entry["polygon_px"].push_back(pair(p.x(), p.y()));
    }
    scene["occluders"].push_back(std::move(entry));
  }
  write_file(folder_ / "scene.json", scene.dump(2) + "\n");
}

void ImageDataSet::write_pipeline() const {
  Json images, truth, pipeline;
  images["use"] = "images";
  images["name"] = "cameras";
  truth["use"] = "ground-truth";
  truth["name"] = "truth";
  for (std::size_t c = 0; c < scene_->cameras.size(); ++c) {
    const Camera& camera = scene_->cameras[c];
    const std::string numbered = camera.name() + "/{frame}" + extension();
    if (has_images_[c] != 0) {
      images["pattern"][camera.name()] = std::string(kImages) + "/" + numbered;
    } else {
      images["missing_cameras"].push_back(camera.name());
    }
    const auto of_camera = [c](const auto& views) { return !views[c].empty(); };
    if (std::ranges::any_of(people_free_, of_camera)) {
      images["people_free"][camera.name()] = std::string(kPeopleFree) + "/" + numbered;
    }
    truth["files"][camera.name()] = "gt." + camera.name() + ".txt";
  }
  truth["ground"] = "ground.csv";
  truth["frames"] = frames_;
  pipeline["plaza"] = 1;
  pipeline["name"] = "Data set: " + scene_->name;
  pipeline["scene"] = "scene.json";
  pipeline["nodes"].push_back(std::move(images));
  if (ground_) pipeline["nodes"].push_back(std::move(truth));
  write_file(folder_ / "data-set.json", pipeline.dump(2) + "\n");
}

std::vector<Artifact> ImageDataSet::do_finish(bool /*complete*/) {
  if (!begun_) return {};
  for (OutputFile& rows : rows_) rows.commit();
  if (ground_) ground_->commit();
  write_scene();
  write_pipeline();
  return {{folder_ / "data-set.json", "pipeline that reads the data set beside it"}};
}

}  // namespace plaza::data_set
