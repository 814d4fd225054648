#pragma once

#include <memory>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/scoring/reliability.h"

namespace plaza::diagnosis {

/// Whether observations are as probable and as precise as they say. The diagram is a sink's.
class Reliability final : public Evaluator {
 public:
  struct Options {
    double overlap = 0.3;
    int bins = 10;
    int points = 6;
  };
  static Declaration<Options> declare();
  Reliability(const Options& options, const BuildContext& context);

 private:
  void do_observe(const NodeIo& io) override;
  Evaluation do_evaluate() override;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  Judgement judgement_;
};

}  // namespace plaza::diagnosis
