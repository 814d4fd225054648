#pragma once

#include "image_scores.h"

namespace plaza::scores {

/// CLEAR MOT, identity and HOTA of final tracks, by the boxes that they have in all views.
class TrackingScores final : public ImageScores {
 public:
  static Declaration<Options> declare();
  TrackingScores(const Options& options, const BuildContext& context);

 private:
  void keep_results(const NodeIo& io) override;
  std::vector<ResultPerson> results_in(std::int64_t frame) const override;
  Evaluation figures(const PairedSequence& similarity) const override;

  TrackLog tracks_;
};

}  // namespace plaza::scores
