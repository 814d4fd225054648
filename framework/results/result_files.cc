#include "framework/results/result_files.h"

#include <algorithm>
#include <system_error>

#include "framework/results/number_text.h"
#include "plaza/core/error.h"
#include "plaza/geometry/angle.h"

namespace plaza {
namespace {

// A tenth of a millimetre, a thousandth of a pixel: far below what any calibration gives, so that
// evaluating the files gives what evaluating the run gave.
constexpr int kMetreDecimals = 4;
constexpr int kPixelDecimals = 3;
constexpr int kDegreeDecimals = 3;
constexpr int kScoreDecimals = 6;

constexpr const char* kObservations = "observations.ground.csv";
constexpr const char* kGroundTracks = "tracks.ground.csv";

std::string view_file(const Camera& camera) { return "tracks." + camera.name() + ".txt"; }

std::string heading_field(const std::optional<double>& heading_rad) {
  return heading_rad ? fixed_text(degrees_from_radians(wrap_angle(*heading_rad)), kDegreeDecimals)
                     : "";
}

std::string ground_fields(const Eigen::Vector2d& position_m,
                          const std::optional<double>& heading_rad, double score) {
  return fixed_text(position_m.x(), kMetreDecimals) + "," +
         fixed_text(position_m.y(), kMetreDecimals) + "," + heading_field(heading_rad) + "," +
         fixed_text(score, kScoreDecimals) + "\n";
}

std::string key_fields(const TrackPoint& point) {
  return std::to_string(point.frame + 1) + "," + std::to_string(point.id) + ",";
}

}  // namespace

std::optional<Box> box_in_view(const TrackPoint& point, const Scene& scene, std::size_t camera) {
  const auto measured =
      std::find_if(point.boxes.begin(), point.boxes.end(),
                   [camera](const ViewBox& view) { return view.camera == camera; });
  const Camera& view = scene.cameras[camera];
  const std::optional<Box> box = measured != point.boxes.end()
                                     ? std::optional(measured->box)
                                     : body_box(view, point.position_m, scene.body);
  if (!box) return std::nullopt;
  // pixel centres are at integers: the image covers half a pixel beyond the outermost ones
  const bool outside = box->right() <= -0.5 || box->bottom() <= -0.5 ||
                       box->left >= view.width() - 0.5 || box->top >= view.height() - 0.5;
  return outside ? std::nullopt : box;
}

ObservationsFile::ObservationsFile(const std::filesystem::path& folder)
    : file_(folder / kObservations) {
  file_.write("frame,x_m,y_m,heading_deg,score\n");
}

void ObservationsFile::add(std::int64_t frame, const Observations& observations) {
  std::string rows;
  for (const Observation& o : observations.items) {
    rows +=
        std::to_string(frame + 1) + "," + ground_fields(o.position_m, o.heading_rad, o.probability);
  }
  file_.write(rows);
}

std::vector<Artifact> write_tracks(const std::filesystem::path& folder, const TrackStore& tracks,
                                   std::int64_t end_frame, const Scene& scene) {
  OutputFile ground(folder / kGroundTracks);
  ground.write("frame,id,x_m,y_m,heading_deg,score\n");
  std::vector<OutputFile> views;
  for (const Camera& camera : scene.cameras) views.emplace_back(folder / view_file(camera));

  for (std::int64_t frame = tracks.first_frame(); frame < end_frame; ++frame) {
    for (const TrackPoint& point : tracks.at(frame)) {
      ground.write(key_fields(point) +
                   ground_fields(point.position_m, point.heading_rad, point.score));
      for (std::size_t camera = 0; camera < views.size(); ++camera) {
        const std::optional<Box> box = box_in_view(point, scene, camera);
        if (!box) continue;
        std::string row = key_fields(point);
        for (const double value : {box->left, box->top, box->width, box->height}) {
          row += fixed_text(value, kPixelDecimals) + ",";
        }
        row += fixed_text(point.score, kScoreDecimals) + "," +
               fixed_text(point.position_m.x(), kMetreDecimals) + "," +
               fixed_text(point.position_m.y(), kMetreDecimals) + "," +
               fixed_text(0, kMetreDecimals) + "\n";
        views[camera].write(row);
      }
    }
  }

  ground.commit();
  std::vector<Artifact> artifacts = {{ground.file(), "tracks on the ground"}};
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    views[camera].commit();
    artifacts.push_back({views[camera].file(), "tracks in view " + scene.cameras[camera].name()});
  }
  return artifacts;
}

void remove_earlier_results(const std::filesystem::path& folder, const Scene& scene) {
  std::vector<std::string> names = {kObservations, kGroundTracks};
  for (const Camera& camera : scene.cameras) names.push_back(view_file(camera));
  for (const std::string& name : names) {
    for (const char* suffix : {"", ".part"}) {
      std::error_code error;
      std::filesystem::remove(folder / (name + suffix), error);
      if (error) {
        throw UserError("cannot replace " + (folder / name).string() + ": " + error.message() +
                        "; choose another folder with --out");
      }
    }
  }
}

}  // namespace plaza
