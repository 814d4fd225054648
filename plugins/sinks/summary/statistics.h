#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "plaza/data/track.h"

namespace plaza::summary {

/// One person's final points, by rising frame.
using Trajectory = std::vector<TrackPoint>;
using Trajectories = std::map<TrackId, Trajectory>;

/// What a table says of one person.
struct PersonFigures {
  TrackId id = 0;
  std::int64_t first_frame = 0;  ///< from 0
  std::int64_t last_frame = 0;
  double seconds = 0;         ///< frames with this person over the frame rate
  double path_m = 0;          ///< see figures_of()
  double speed_m_per_s = 0;   ///< path over the time it took; 0 for a single frame
  double observed_share = 0;  ///< of the person's frames, [0, 1]
};

/// Figures of a trajectory with at least one point.
///
/// The path is measured along positions averaged over one second, since the noise of single
/// positions adds up (0.1 m of it at 25 Hz make a standing person walk 3 m/s). Absences of more
/// than a second are not walked through.
PersonFigures figures_of(const Trajectory& trajectory, double frame_rate_hz);

/// How many there were per frame, over a number of frames.
struct CountFigures {
  std::int64_t least = 0;
  double mean = 0;
  std::int64_t most = 0;
};
CountFigures figures_of_counts(const std::vector<std::int64_t>& counts);

/// People in each of the frames [begin, end).
std::vector<std::int64_t> people_per_frame(const Trajectories& people, std::int64_t begin,
                                           std::int64_t end);

}  // namespace plaza::summary
