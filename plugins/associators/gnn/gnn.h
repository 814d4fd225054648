#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "plaza/component/declaration.h"
#include "plugins/associators/gnn/reentry.h"
#include "plugins/associators/gnn/target.h"

namespace plaza {

/// Global nearest neighbour association (thesis 6.3, Algorithm 2): targets are predicted, joined
/// with the frame's observations by one exact assignment, and live by a counter of detections.
class Gnn final : public Associator {
 public:
  enum class Identity { kNew, kKeep };
  struct Options {
    double gate_m = 1.0;
    double gate_sigma = 0.0;
    int confirm = 3;
    int max_count = 10;
    double min_start_probability = 0.0;
    double coast_s = 0.0;
    double smoothing_s = 0.0;
    double heading_speed_mps = 0.3;
    Identity reentry = Identity::kNew;
    double reentry_s = 2.0;
    double memory_s = 60.0;
    double reentry_border_m = 1.0;
    double reentry_reach_m = 1.0;
    double reentry_speed_mps = 2.0;
    double margin_m = 0.0;
  };
  static Declaration<Options> declare();
  Gnn(const Options& options, const BuildContext& context);

 private:
  AssociatorOutput do_push(const AssociatorInput& input) override;
  AssociatorOutput do_flush_tracks() override;

  std::vector<int> assign(const std::vector<Observation>& observations) const;
  void predict(std::int64_t frame, double time_s);
  void observe(Target& target, const Observation& observation);
  void create(const Observation& observation, std::int64_t frame, double time_s);
  void confirm_targets();
  void renew_identity(Target& target);
  bool at_border(const Eigen::Vector2d& position_m) const;

  /// Makes samples [final_count, end) final and puts them out.
  void finish(Target& target, std::size_t end, AssociatorOutput& output) const;
  void finish_due(Target& target, double now_s, AssociatorOutput& output) const;
  void put_open(const Target& target, AssociatorOutput& output) const;
  void terminate(Target& target, AssociatorOutput& output);
  TrackPoint point(const Target& target, std::size_t index) const;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const MotionModel> motion_;
  Reentry reentry_;
  std::vector<Target> targets_;  ///< by creation
  TrackId next_id_ = 1;
  double last_time_s_ = 0;
};

}  // namespace plaza
