#pragma once

#include <memory>
#include <vector>

#include "frame_log.h"
#include "plaza/component/declaration.h"

namespace plaza::scores {

/// MODA, MODP, precision and recall of observations, by the boxes that they have in all views.
class DetectionScores final : public Evaluator {
 public:
  struct Options {
    double overlap = 0.3;
    std::vector<double> sweep = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  };
  static Declaration<Options> declare();
  DetectionScores(const Options& options, const BuildContext& context);

 private:
  void do_observe(const NodeIo& io) override;
  Evaluation do_evaluate() override;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  TruthLog truth_;
  std::map<std::int64_t, std::shared_ptr<const Observations>> observations_;
};

}  // namespace plaza::scores
