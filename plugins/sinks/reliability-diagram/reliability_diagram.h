#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/scoring/reliability.h"

namespace plaza::reliability_diagram {

/// Draws whether observations are as probable and as precise as they say, and writes the curve that
/// makes a detector's probabilities right.
class ReliabilityDiagram final : public Sink {
 public:
  struct Options {
    double overlap = 0.3;
    int bins = 10;
    int points = 6;
  };
  static Declaration<Options> declare();
  ReliabilityDiagram(const Options& options, const BuildContext& context);

 private:
  void do_write(const NodeIo& io) override;
  void do_write_rest(const NodeIo&) override {}
  std::vector<Artifact> do_finish(bool complete) override;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  std::filesystem::path folder_;  ///< of its own
  Judgement judgement_;
};

}  // namespace plaza::reliability_diagram
