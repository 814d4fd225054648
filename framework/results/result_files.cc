#include "framework/results/result_files.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

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
constexpr const char* kPart = ".part";

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

std::string view_row(const TrackPoint& point, const Box& box) {
  std::string row = key_fields(point);
  for (const double value : {box.left, box.top, box.width, box.height}) {
    row += fixed_text(value, kPixelDecimals) + ",";
  }
  return row + fixed_text(point.score, kScoreDecimals) + "," +
         fixed_text(point.position_m.x(), kMetreDecimals) + "," +
         fixed_text(point.position_m.y(), kMetreDecimals) + "," + fixed_text(0, kMetreDecimals) +
         "\n";
}

/// A file that can't be written whole gets its name with the rows that could be.
void commit_what_fits(OutputFile& file) {
  try {
    file.commit();
  } catch (const UserError&) {
    file.drop_unwritten();
    file.commit();
    throw;
  }
}

/// A file among several: its fault must not keep the others from being written.
class RowFile {
 public:
  RowFile(const std::filesystem::path& file, std::string what)
      : file_(file), what_(std::move(what)) {}

  void write(const std::string& row) {
    if (!fault_) attempt([&] { file_.write(row); });
  }
  Artifact commit() {
    attempt([&] { commit_what_fits(file_); });
    return {file_.file(), what_};
  }
  const std::exception_ptr& fault() const { return fault_; }

 private:
  template <class Step>
  void attempt(const Step& step) {
    try {
      step();
    } catch (const UserError&) {
      if (!fault_) fault_ = std::current_exception();
    }
  }

  OutputFile file_;
  std::string what_;
  std::exception_ptr fault_;
};

std::vector<Artifact> write_rows(const std::filesystem::path& folder, const std::string& suffix,
                                 const TrackStore& tracks, std::int64_t end_frame,
                                 const Scene& scene) {
  std::vector<RowFile> files;  // the ground's, then one per view
  files.emplace_back(folder / (kGroundTracks + suffix), "tracks on the ground");
  files.front().write("frame,id,x_m,y_m,heading_deg,score\n");
  for (const Camera& camera : scene.cameras) {
    files.emplace_back(folder / (view_file(camera) + suffix), "tracks in view " + camera.name());
  }

  for (std::int64_t frame = tracks.first_frame(); frame < end_frame; ++frame) {
    for (const TrackPoint& point : tracks.at(frame)) {
      files.front().write(key_fields(point) +
                          ground_fields(point.position_m, point.heading_rad, point.score));
      for (std::size_t camera = 0; camera < scene.cameras.size(); ++camera) {
        if (const std::optional<Box> box = box_in_view(point, scene, camera)) {
          files[camera + 1].write(view_row(point, *box));
        }
      }
    }
  }

  std::vector<Artifact> artifacts;
  std::exception_ptr first_fault;
  for (RowFile& file : files) {
    artifacts.push_back(file.commit());
    if (!first_fault) first_fault = file.fault();
  }
  if (first_fault) std::rethrow_exception(first_fault);
  return artifacts;
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

void ObservationsFile::commit() { commit_what_fits(file_); }

std::vector<Artifact> write_tracks(const std::filesystem::path& folder, const TrackStore& tracks,
                                   std::int64_t end_frame, const Scene& scene) {
  return write_rows(folder, "", tracks, end_frame, scene);
}

void write_tracks_so_far(const std::filesystem::path& folder, const TrackStore& tracks,
                         std::int64_t end_frame, const Scene& scene) {
  write_rows(folder, kPart, tracks, end_frame, scene);
}

void remove_earlier_results(const std::filesystem::path& folder, const Scene& scene) {
  std::vector<std::string> names = {kObservations, kGroundTracks};
  for (const Camera& camera : scene.cameras) names.push_back(view_file(camera));
  for (const std::string& name : names) {
    for (const std::string suffix : {"", kPart, ".part.part"}) {
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
