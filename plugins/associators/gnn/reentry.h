#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "plaza/data/track.h"

namespace plaza {

/// A person whose track ended.
struct Departure {
  TrackId id = 0;
  std::int64_t last_frame = 0;  ///< the last one its track speaks of
  double time_s = 0;            ///< of the last observation
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
};

/// A new track, not yet named.
struct Arrival {
  std::int64_t first_frame = 0;
  double time_s = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
};

/// Remembers who left, and decides who came back.
class Reentry {
 public:
  /// An arrival can be a departed person when at most `memory_s` have passed and it begins within
  /// `reach_m` + `speed_mps` * (time passed) of where that person was last seen.
  Reentry(double memory_s, double reach_m, double speed_mps)
      : memory_s_(memory_s), reach_m_(reach_m), speed_mps_(speed_mps) {}

  void leave(const Departure& departure) { departed_.push_back(departure); }
  /// The identity of each arrival, 0 for a new person: as many as possible are recognised, with the
  /// smallest sum of distances. Who is recognised is no longer departed.
  std::vector<TrackId> recognise(std::span<const Arrival> arrivals);
  /// Forgets who left longer than the memory ago.
  void forget(double now_s);

 private:
  double memory_s_;
  double reach_m_;
  double speed_mps_;
  std::vector<Departure> departed_;  ///< in the order of leaving
};

}  // namespace plaza
