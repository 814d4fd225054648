#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "models/motion/constant_velocity.h"
#include "plugins/associators/gnn/gnn.h"

namespace plaza::testing {

/// Plays scripted observations to a Gnn at 10 Hz in an area of 20 x 20 m about the origin, and
/// keeps its answers. Checks on the way what every associator promises.
class GnnScript {
 public:
  explicit GnnScript(const Gnn::Options& options, double acceleration_sigma = 1.0) {
    auto scene = std::make_shared<Scene>();
    scene->area = {.min_m = {-10, -10}, .max_m = {10, 10}};
    scene->frame_rate_hz = 10;
    scene_ = scene;
    BuildContext context;
    context.name = "tracks";
    context.scene = scene_;
    context.part_lists["motion"] = {
        {"motion", std::make_shared<ConstantVelocity>(
                       ConstantVelocity::Options{.acceleration_sigma = acceleration_sigma,
                                                 .initial_speed_sigma_mps = 1.0},
                       context)}};
    gnn_ = std::make_unique<Gnn>(options, context);
  }

  /// One frame with people seen at `positions`.
  AssociatorOutput see(const std::vector<Eigen::Vector2d>& positions, double probability = 0.9) {
    Observations observations;
    for (const Eigen::Vector2d& p : positions) {
      Observation o;
      o.position_m = p;
      o.covariance_m2 = 0.01 * Eigen::Matrix2d::Identity();
      o.probability = probability;
      observations.items.push_back(std::move(o));
    }
    return see(observations);
  }
  AssociatorOutput see_nobody() { return see(Observations{}); }
  AssociatorOutput see(const Observations& observations) {
    AssociatorOutput output = gnn_->push({.frame = frame_,
                                          .time_ns = scene_->time_of_frame(frame_),
                                          .observations = &observations,
                                          .tracklets = nullptr});
    ++frame_;
    keep(output);
    return output;
  }
  AssociatorOutput flush() {
    AssociatorOutput output = gnn_->flush_tracks();
    keep(output);
    return output;
  }

  std::int64_t next_frame() const { return frame_; }
  /// Final points by frame, then id.
  const std::map<std::int64_t, std::map<TrackId, TrackPoint>>& final_points() const {
    return final_;
  }
  std::set<TrackId> ids() const {
    std::set<TrackId> out;
    for (const auto& [frame, points] : final_) {
      for (const auto& [id, point] : points) out.insert(id);
    }
    return out;
  }
  /// Frames in which `id` is final.
  std::set<std::int64_t> frames_of(TrackId id) const {
    std::set<std::int64_t> out;
    for (const auto& [frame, points] : final_) {
      if (points.count(id)) out.insert(frame);
    }
    return out;
  }
  /// Id of the final point nearest to `position` in `frame`, 0 when none is within 0.5 m.
  TrackId id_at(std::int64_t frame, const Eigen::Vector2d& position) const {
    TrackId best = 0;
    double least = 0.5;
    const auto it = final_.find(frame);
    if (it == final_.end()) return 0;
    for (const auto& [id, point] : it->second) {
      const double d = (point.position_m - position).norm();
      if (d < least) {
        least = d;
        best = id;
      }
    }
    return best;
  }
  const std::vector<Tracklet>& tracklets() const { return tracklets_; }

 private:
  void keep(const AssociatorOutput& output) {
    for (const TrackPoint& p : output.points) {
      EXPECT_EQ(final_[p.frame].count(p.id), 0U) << "frame " << p.frame << " spoken of again";
      if (p.final) final_[p.frame][p.id] = p;
    }
    tracklets_.insert(tracklets_.end(), output.tracklets.begin(), output.tracklets.end());
  }

  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Gnn> gnn_;
  std::int64_t frame_ = 0;
  std::map<std::int64_t, std::map<TrackId, TrackPoint>> final_;
  std::vector<Tracklet> tracklets_;
};

}  // namespace plaza::testing
