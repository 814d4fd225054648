#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/results/track_store.h"
#include "plaza/component/sink.h"
#include "plaza/data/observation.h"
#include "plaza/geometry/scene.h"
#include "plaza/io/output_file.h"

namespace plaza {

/// The box of a tracked person in view `camera`: measured there if it was, else of the scene's body
/// standing at the point. Nothing when the box lies wholly outside the image or the body is not
/// wholly in front of the camera: such a person has no row in that view.
std::optional<Box> box_in_view(const TrackPoint& point, const Scene& scene, std::size_t camera);

/// Rows of observations.ground.csv, `frame,x_m,y_m,heading_deg,score`, in the order of the
/// observations.
class ObservationsFile {
 public:
  explicit ObservationsFile(const std::filesystem::path& folder);
  /// The observations of one frame (from 0), all or nothing.
  void add(std::int64_t frame, const Observations& observations);
  /// Makes what was added survive the end of this process.
  void flush() { file_.flush(); }
  /// Gives the file its name with what could be written, even when that is not all: throws then.
  void commit();
  const std::filesystem::path& file() const { return file_.file(); }

 private:
  OutputFile file_;
};

/// Writes tracks.ground.csv, `frame,id,x_m,y_m,heading_deg,score`, and for each camera
/// tracks.<camera>.txt, MOTChallenge rows `frame,id,left,top,width,height,score,x,y,z` with the
/// ground position in metres behind, of the frames before `end_frame`; by rising frame, then id.
/// Lists the files. A file that can't be written whole (a full disk) keeps the rows that could be,
/// the others are written all the same, and the first fault is thrown at the end.
std::vector<Artifact> write_tracks(const std::filesystem::path& folder, const TrackStore& tracks,
                                   std::int64_t end_frame, const Scene& scene);

/// Writes the same as NAME.part, each replaced in one step: what is left of a run that is killed.
void write_tracks_so_far(const std::filesystem::path& folder, const TrackStore& tracks,
                         std::int64_t end_frame, const Scene& scene);

/// Takes away the contract's files, and parts of them, that an earlier run left in `folder`, so
/// that no folder ever mixes two runs.
void remove_earlier_results(const std::filesystem::path& folder, const Scene& scene);

}  // namespace plaza
