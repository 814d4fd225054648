#include "plugins/associators/gnn/reentry.h"

#include <limits>

#include "plaza/math/assignment.h"

namespace plaza {

std::vector<TrackId> Reentry::recognise(std::span<const Arrival> arrivals) {
  std::vector<TrackId> ids(arrivals.size(), 0);
  if (arrivals.empty() || departed_.empty()) return ids;
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(arrivals.size()),
                                                   static_cast<Eigen::Index>(departed_.size()),
                                                   std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    for (std::size_t k = 0; k < departed_.size(); ++k) {
      const Departure& d = departed_[k];
      const double gap_s = arrivals[i].time_s - d.time_s;
      if (gap_s > memory_s_ || arrivals[i].first_frame <= d.last_frame) continue;
      const double distance_m = (arrivals[i].position_m - d.position_m).norm();
      if (distance_m > reach_m_ + speed_mps_ * gap_s) continue;
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = distance_m;
    }
  }
  const std::vector<int> columns = assign_minimum_cost(cost);
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    if (columns[i] >= 0) ids[i] = departed_[static_cast<std::size_t>(columns[i])].id;
  }
  for (const TrackId id : ids) {
    if (id != 0) std::erase_if(departed_, [id](const Departure& d) { return d.id == id; });
  }
  return ids;
}

void Reentry::forget(double now_s) {
  std::erase_if(departed_, [&](const Departure& d) { return now_s - d.time_s > memory_s_; });
}

}  // namespace plaza
