#pragma once

#include <memory>
#include <vector>

#include "frame_log.h"
#include "plaza/component/declaration.h"

namespace plaza::scores {

/// CLEAR MOT, identity and HOTA of final tracks, by the boxes that they have in all views.
class TrackingScores final : public Evaluator {
 public:
  struct Options {
    double overlap = 0.3;
    std::vector<double> sweep = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  };
  static Declaration<Options> declare();
  TrackingScores(const Options& options, const BuildContext& context);

 private:
  void do_observe(const NodeIo& io) override;
  Evaluation do_evaluate() override;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  TruthLog truth_;
  TrackLog tracks_;
};

}  // namespace plaza::scores
