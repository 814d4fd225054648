#include "framework/scene/scene_file.h"

#include <algorithm>
#include <set>

#include "framework/config/text.h"
#include "framework/scene/calibration_check.h"
#include "framework/scene/camera_reader.h"
#include "framework/scene/fields.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

std::optional<GroundArea> read_area(Fields& scene) {
  Fields fields = scene.object("area");
  if (!fields.is_object()) return std::nullopt;
  const auto x = fields.pair("x_m"), y = fields.pair("y_m");
  fields.refuse_unknown();
  if (!x || !y) return std::nullopt;
  bool fine = true;
  for (const auto& [key, range] : {std::pair("x_m", *x), std::pair("y_m", *y)}) {
    if (range[0] < range[1]) continue;
    fields.fault(key, "is empty: the first number must be the smaller one, in metres");
    fine = false;
  }
  if (fine && (x->cwiseAbs().maxCoeff() > 1e5 || y->cwiseAbs().maxCoeff() > 1e5)) {
    fields.fault("reaches beyond 100 km; give it in metres");
    fine = false;
  }
  if (!fine) return std::nullopt;
  return GroundArea{{x->x(), y->x()}, {x->y(), y->y()}};
}

Body read_body(Fields& scene) {
  Body body;
  if (scene.find("body") == nullptr) return body;
  Fields fields = scene.object("body");
  if (!fields.is_object()) return body;
  const auto height = fields.number("height_m", body.height_m);
  const auto radius = fields.number("radius_m", body.radius_m);
  if (height && !(*height >= 0.5 && *height <= 2.5)) {
    fields.fault("height_m",
                 "must be a person's height, from 0.5 to 2.5 m, not " + short_number(*height));
  }
  if (radius && !(*radius >= 0.05 && *radius <= 1)) {
    fields.fault("radius_m",
                 "must be a person's radius, from 0.05 to 1 m, not " + short_number(*radius));
  }
  fields.refuse_unknown();
  return {height.value_or(body.height_m), radius.value_or(body.radius_m)};
}

double polygon_area(const std::vector<Eigen::Vector2d>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2;
}

/// Calls `read(fields)` for every entry of the array `key`.
template <class Read>
void for_each_entry(Fields& scene, const JsonDocument& document, std::string_view key,
                    Diagnostics& faults, const Read& read) {
  const nlohmann::json& array = document.root.at(std::string(key));
  for (std::size_t i = 0; i < array.size(); ++i) {
    Fields fields(document, scene.pointer_of(key) + "/" + std::to_string(i), faults);
    if (fields.is_object()) read(fields);
  }
}

class SceneReader {
 public:
  explicit SceneReader(const JsonDocument& document) : document_(document) {}

  std::shared_ptr<const Scene> read() {
    Fields scene(document_, "", faults_);
    if (scene.is_object()) read_all(scene);
    if (!faults_.empty()) throw UserError(std::move(faults_));
    return std::make_shared<const Scene>(std::move(scene_));
  }

 private:
  void read_all(Fields& scene) {
    const nlohmann::json* version = scene.need("plaza_scene");
    if (version != nullptr && *version != 1) {
      scene.fault("plaza_scene", "must be 1, the version of the format that this program reads");
    }
    scene.find("$schema");
    scene_.name = scene.text("name").value_or("");
    scene_.frame_rate_hz = scene.positive("frame_rate_hz").value_or(1);
    if (scene_.frame_rate_hz > 10'000) {
      scene.fault("frame_rate_hz", "must be at most 10000 frames per second, not " +
                                       short_number(scene_.frame_rate_hz));
    }
    const auto area = read_area(scene);
    if (area) scene_.area = *area;
    scene_.body = read_body(scene);
    const nlohmann::json* cameras = scene.need("cameras");
    if (cameras != nullptr && (!cameras->is_array() || cameras->empty())) {
      scene.fault("cameras", "must be an array of at least one camera");
    } else if (cameras != nullptr) {
      for_each_entry(scene, document_, "cameras", faults_, [&](Fields& f) { add_camera(f, area); });
    }
    const nlohmann::json* occluders = scene.find("occluders");
    if (occluders != nullptr && !occluders->is_array()) {
      scene.fault("occluders", "must be an array");
    } else if (occluders != nullptr) {
      for_each_entry(scene, document_, "occluders", faults_, [&](Fields& f) { add_occluder(f); });
    }
    scene.refuse_unknown();
  }

  void add_camera(Fields& fields, const std::optional<GroundArea>& area) {
    if (fields.has("name")) {
      const nlohmann::json& name =
          document_.root.at(nlohmann::json::json_pointer(fields.pointer_of("name")));
      if (name.is_string()) {
        const std::string text = name.get<std::string>();
        if (std::find(names_.begin(), names_.end(), text) != names_.end()) {
          fields.fault("name", "there are two cameras \"" + text + "\"; names must differ");
        }
        names_.push_back(text);
        // the name becomes part of the names of result files
        if (text.find_first_of("/\\") != std::string::npos || text.starts_with(".")) {
          fields.fault("name",
                       "must not contain a slash or begin with a dot: files are named by it");
        }
      }
    }
    auto entry = read_camera(fields, faults_);
    if (!entry) return;
    if (area) {
      for (std::string& fault : placement_faults(entry->camera, *area, scene_.body, entry->unit)) {
        faults_.push_back({document_.position(entry->pointer), entry->pointer, std::move(fault)});
      }
    }
    scene_.cameras.push_back(std::move(entry->camera));
  }

  void add_occluder(Fields& fields) {
    StaticOccluder occluder;
    occluder.name = fields.text("name").value_or("");
    const auto camera = fields.text("camera");
    if (camera && std::find(names_.begin(), names_.end(), *camera) == names_.end()) {
      fields.fault("camera",
                   "there is no camera \"" + *camera + "\"" + did_you_mean(*camera, names_));
    }
    const nlohmann::json* polygon = fields.need("polygon_px");
    const auto flat =
        polygon != nullptr && polygon->is_array() ? flat_numbers(*polygon) : std::nullopt;
    const bool pairs =
        flat && std::all_of(polygon->begin(), polygon->end(), [](const auto& corner) {
          return corner.is_array() && corner.size() == 2;
        });
    if (polygon != nullptr && (!pairs || polygon->size() < 3)) {
      fields.fault("polygon_px", "must be an array of at least three corners [x, y], in pixels");
    } else if (polygon != nullptr) {
      for (std::size_t i = 0; i < flat->size(); i += 2) {
        occluder.polygon_px.emplace_back((*flat)[i], (*flat)[i + 1]);
      }
      if (!(polygon_area(occluder.polygon_px) > 0)) {
        fields.fault("polygon_px", "has no area: its corners lie on one line");
      }
      check_in_image(fields, camera.value_or(""), occluder.polygon_px);
    }
    fields.refuse_unknown();
    occluder.camera = camera.value_or("");
    scene_.occluders.push_back(std::move(occluder));
  }

  void check_in_image(Fields& fields, const std::string& camera,
                      const std::vector<Eigen::Vector2d>& polygon) {
    const auto index = scene_.camera_index(camera);
    if (!index) return;
    const Camera& view = scene_.cameras[*index];
    Eigen::Vector2d low = polygon.front(), high = polygon.front();
    for (const Eigen::Vector2d& corner : polygon) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    if (high.x() >= 0 && high.y() >= 0 && low.x() < view.width() && low.y() < view.height()) return;
    fields.fault("polygon_px", "lies outside the image of \"" + camera + "\", which has " +
                                   std::to_string(view.width()) + "x" +
                                   std::to_string(view.height()) + " pixels");
  }

  const JsonDocument& document_;
  Diagnostics faults_;
  Scene scene_;
  std::vector<std::string> names_;
};

}  // namespace

std::shared_ptr<const Scene> read_scene(const std::filesystem::path& file) {
  return parse_scene(read_json(file));
}

std::shared_ptr<const Scene> parse_scene(const JsonDocument& document) {
  return SceneReader(document).read();
}

}  // namespace plaza
