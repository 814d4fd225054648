#include "tracking_scores.h"

#include <utility>

#include "plaza/scoring/sections.h"

namespace plaza::scores {

Declaration<TrackingScores::Options> TrackingScores::declare() {
  Declaration<Options> d("tracking-scores", "Scores final tracks by their boxes in all views");
  d.source("thesis (3.6), (3.7); CLEAR MOT, identity and HOTA as TrackEval counts them")
      .input<Tracks>("what is scored; where a view has no measured box, the scene's body is drawn")
      .input<GroundTruth>("the truth")
      .parameters(parameters("CLEAR MOT and identity are", "thesis Fig. 6.10"));
  for (MetricSpec& metric : image_tracking_metrics()) d.metric(std::move(metric));
  for (MetricSpec& metric : thesis_tracking_metrics()) d.metric(std::move(metric));
  return d;
}

TrackingScores::TrackingScores(const Options& options, const BuildContext& context)
    : ImageScores(options, context) {}

void TrackingScores::keep_results(const NodeIo& io) { tracks_.add(io.in<Tracks>(kResults)); }

std::vector<ResultPerson> TrackingScores::results_in(std::int64_t frame) const {
  std::vector<ResultPerson> results;
  for (const TrackPoint* point : tracks_.at(frame)) {
    results.push_back(
        {.id = point->id, .boxes = boxes_in_views(scene(), point->position_m, point->boxes)});
  }
  return results;
}

Evaluation TrackingScores::figures(const PairedSequence& similarity) const {
  return {{"tracking", image_tracking_section(similarity, options().overlap, options().sweep)},
          {"thesis", thesis_section(nullptr, &similarity, options().overlap)}};
}

}  // namespace plaza::scores
