#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frame_log.h"
#include "plaza/component/declaration.h"
#include "plaza/scoring/paired_sequence.h"
#include "plaza/scoring/people.h"

namespace plaza::scores {

/// What evaluators by boxes in all views share: the truth, the parameters and the comparison frame
/// by frame. They differ in who the result is and in the figures.
class ImageScores : public Evaluator {
 public:
  struct Options {
    double overlap = 0.3;
    std::vector<double> sweep = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
    double from_s = 0;
  };

 protected:
  /// Inputs as declare() gives them: the result first, then the truth.
  static constexpr std::size_t kResults = 0;
  static constexpr std::size_t kTruth = 1;

  /// All parameters; `scored` is what is scored at the sweep's overlaps, `source` who swept.
  static Parameters<Options> parameters(const std::string& scored, const std::string& source);

  ImageScores(const Options& options, const BuildContext& context);

  const Options& options() const { return options_; }
  const Scene& scene() const { return *scene_; }

 private:
  /// Keeps what input kResults, which is there, holds.
  virtual void keep_results(const NodeIo& io) = 0;
  /// Who was in a frame, according to what was kept; boxes by view.
  virtual std::vector<ResultPerson> results_in(std::int64_t frame) const = 0;
  /// Of a sequence with at least one true person.
  virtual Evaluation figures(const PairedSequence& similarity) const = 0;

  void do_observe(const NodeIo& io) final;
  Evaluation do_evaluate() final;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  TruthLog truth_;
};

}  // namespace plaza::scores
