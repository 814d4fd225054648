#include "tests/bench/scaled_laboratory.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "framework/scene/scene_file.h"
#include "plaza/core/error.h"
#include "plugins/sources/synthetic/laboratory.h"

namespace plaza::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kFrames = 500;
constexpr std::int64_t kBackgrounds = 16;
constexpr const char* kPeopleFree = "people-free/";

fs::path pipelines() { return fs::path(PLAZA_SOURCE_DIR) / "pipelines"; }

void write(const fs::path& file, const Json& json) {
  std::ofstream out(file);
  out << json.dump(1);
  if (!out) throw UserError("can't write " + file.string());
}

}  // namespace

ScaledLaboratory::ScaledLaboratory() {
  std::string name = (fs::temp_directory_path() / "plaza-growth-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw UserError("can't make the folder " + name);
  folder_ = name;
  const auto scene = read_scene(pipelines() / "scenes" / "lab.json");
  synthetic::LaboratoryOptions options;
  options.duration_s = static_cast<double>(kFrames) / scene->frame_rate_hz;
  const synthetic::Laboratory laboratory(options, scene);
  for (const Camera& camera : scene->cameras) cameras_.push_back(camera.name());
  const auto keep = [&](const std::string& kind, std::int64_t number,
                        const std::vector<cv::Mat>& views) {
    for (std::size_t c = 0; c < views.size(); ++c) {
      images_.push_back({kind + cameras_[c] + "/" + std::to_string(number), views[c]});
    }
  };
  for (std::int64_t frame = 0; frame < kFrames; ++frame) {
    if (frame % kScaledFrames.every < kScaledFrames.run) keep("", frame, laboratory.images(frame));
  }
  for (std::int64_t i = 1; i <= kBackgrounds; ++i) {  // one every three seconds before the clip
    keep(kPeopleFree, i,
         laboratory.empty_images(
             -std::llround(3.0 * static_cast<double>(i) * scene->frame_rate_hz)));
  }
}

ScaledLaboratory::~ScaledLaboratory() {
  std::error_code ignored;  // what is left in a temporary folder harms nobody
  fs::remove_all(folder_, ignored);
}

fs::path ScaledLaboratory::images(int width_px) {
  fs::path out = folder_ / std::to_string(width_px);
  if (fs::exists(out)) return out;
  for (const Image& image : images_) {
    const fs::path file = out / (image.file + ".png");
    fs::create_directories(file.parent_path());
    cv::Mat pixels = image.pixels;
    if (width_px != pixels.cols) {
      const double scale = static_cast<double>(width_px) / pixels.cols;
      const cv::Size size(width_px, static_cast<int>(std::lround(scale * pixels.rows)));
      cv::resize(image.pixels, pixels, size, 0, 0, cv::INTER_AREA);
    }
    if (!cv::imwrite(file.string(), pixels, {cv::IMWRITE_PNG_COMPRESSION, 1})) {
      throw UserError("can't write " + file.string());
    }
  }
  return out;
}

fs::path ScaledLaboratory::scene(const LaboratoryPart& part) const {
  std::ifstream in(pipelines() / "scenes" / "lab.json");
  Json scene = Json::parse(in);
  scene.erase("$schema");
  Json cameras = Json::array();
  for (std::size_t i = 0; i < part.cameras; ++i) {
    Json camera = scene["cameras"].at((part.first + i) % cameras_.size());
    const double width = camera["image_size"][0], height = camera["image_size"][1];
    const double x = part.width_px / width;
    const double y = static_cast<double>(std::lround(x * height)) / height;
    camera["image_size"] = {part.width_px, std::lround(x * height)};
    Json& k = camera["calibration"];
    k["fx_px"] = x * k["fx_px"].get<double>();
    k["fy_px"] = y * k["fy_px"].get<double>();
    k["cx_px"] = x * (k["cx_px"].get<double>() + 0.5) - 0.5;  // pixel centres are at integers
    k["cy_px"] = y * (k["cy_px"].get<double>() + 0.5) - 0.5;
    cameras.push_back(std::move(camera));
  }
  scene["cameras"] = std::move(cameras);
  fs::path file = folder_ / "scene.json";
  write(file, scene);
  return file;
}

fs::path ScaledLaboratory::pipeline(const std::string& pipeline, const LaboratoryPart& part) {
  const fs::path folder = images(part.width_px);
  Json source;
  source["use"] = "images";
  source["name"] = "cameras";
  for (std::size_t i = 0; i < part.cameras; ++i) {
    const std::string& camera = cameras_[(part.first + i) % cameras_.size()];
    const std::string numbered = camera + "/{frame}.png";
    source["pattern"][camera] = (folder / numbered).string();
    source["people_free"][camera] = (folder / (kPeopleFree + numbered)).string();
  }
  Json out;
  out["plaza"] = 1;
  out["name"] = "Growth: " + pipeline;
  out["extends"] = (pipelines() / pipeline).string();
  out["scene"] = scene(part).string();
  out["nodes"].push_back(std::move(source));
  // they need a truth, which these files don't have
  for (const char* scores : {"detection-scores", "tracking-scores", "ground-scores"}) {
    Json removed;
    removed["use"] = nullptr;
    removed["name"] = scores;
    out["nodes"].push_back(std::move(removed));
  }
  fs::path file = folder_ / "pipeline.json";
  write(file, out);
  return file;
}

}  // namespace plaza::bench
