#include "detection_scores.h"

#include <utility>

#include "plaza/scoring/sections.h"

namespace plaza::scores {

Declaration<DetectionScores::Options> DetectionScores::declare() {
  Declaration<Options> d(
      "detection-scores",
      "Scores what was detected in each frame, before tracking, by its boxes in all views");
  d.source("thesis (3.1)-(3.5)")
      .input<Observations>(
          "what is scored; where a view has no measured box, the scene's body is drawn")
      .input<GroundTruth>("the truth")
      .parameters(parameters("everything is", "thesis Fig. 4.17"));
  for (MetricSpec& metric : image_detection_metrics()) d.metric(std::move(metric));
  for (MetricSpec& metric : thesis_detection_metrics()) d.metric(std::move(metric));
  return d;
}

DetectionScores::DetectionScores(const Options& options, const BuildContext& context)
    : ImageScores(options, context) {}

void DetectionScores::keep_results(const NodeIo& io) {
  observations_[io.frame()] = io.share<Observations>(kResults);
}

std::vector<ResultPerson> DetectionScores::results_in(std::int64_t frame) const {
  std::vector<ResultPerson> results;
  const auto found = observations_.find(frame);
  if (found == observations_.end()) return results;
  for (const Observation& o : found->second->items) {
    results.push_back({.id = static_cast<std::int64_t>(results.size()),
                       .boxes = boxes_in_views(scene(), o.position_m, o.boxes)});
  }
  return results;
}

Evaluation DetectionScores::figures(const PairedSequence& similarity) const {
  return {{"detection", image_detection_section(similarity, options().overlap, options().sweep)},
          {"thesis", thesis_section(&similarity, nullptr, options().overlap)}};
}

}  // namespace plaza::scores
