#pragma once

#include <map>

#include "image_scores.h"

namespace plaza::scores {

/// MODA, MODP, precision and recall of observations, by the boxes that they have in all views.
class DetectionScores final : public ImageScores {
 public:
  static Declaration<Options> declare();
  DetectionScores(const Options& options, const BuildContext& context);

 private:
  void keep_results(const NodeIo& io) override;
  std::vector<ResultPerson> results_in(std::int64_t frame) const override;
  Evaluation figures(const PairedSequence& similarity) const override;

  std::map<std::int64_t, std::shared_ptr<const Observations>> observations_;
};

}  // namespace plaza::scores
