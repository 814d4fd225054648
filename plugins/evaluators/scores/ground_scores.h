#pragma once

#include <map>
#include <memory>
#include <vector>

#include "frame_log.h"
#include "plaza/component/declaration.h"
#include "plaza/scoring/paired_sequence.h"

namespace plaza::scores {

/// Scores on the ground plane: observations before tracking, and final tracks.
class GroundScores final : public Evaluator {
 public:
  struct Options {
    double distance_m = 0.5;
    std::vector<double> sweep = {0.25, 0.5, 0.75, 1.0};
    double from_s = 0;
  };
  static Declaration<Options> declare();
  GroundScores(const Options& options, const BuildContext& context);

 private:
  void do_observe(const NodeIo& io) override;
  Evaluation do_evaluate() override;
  nlohmann::json figures(double distance_m) const;
  PairedSequence pair_observations() const;
  PairedSequence pair_tracks(double reach_m) const;

  Options options_;
  TruthLog truth_;
  TrackLog tracks_;
  std::map<std::int64_t, std::vector<Eigen::Vector2d>> observations_;
  bool has_tracks_ = false;
  bool has_observations_ = false;
};

}  // namespace plaza::scores
