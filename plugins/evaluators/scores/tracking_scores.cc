#include "tracking_scores.h"

#include <utility>

#include "plaza/scoring/people.h"
#include "plaza/scoring/sections.h"

namespace plaza::scores {
namespace {

constexpr std::size_t kTracks = 0;
constexpr std::size_t kTruth = 1;

}  // namespace

Declaration<TrackingScores::Options> TrackingScores::declare() {
  Parameters<Options> p;
  p.value("overlap", &Options::overlap)
      .above(0)
      .at_most(1)
      .meaning("least overlap of a match, the mean over the views in which the true person counts")
      .source("thesis 3.3.2");
  p.value("sweep", &Options::sweep)
      .above(0)
      .at_most(1)
      .meaning(
          "further overlaps at which CLEAR MOT and identity are scored, listed in the section's "
          "\"sweep\"")
      .source("thesis Fig. 6.10");
  Declaration<Options> d("tracking-scores", "Scores final tracks by their boxes in all views");
  d.source("thesis (3.6), (3.7); CLEAR MOT, identity and HOTA as TrackEval counts them")
      .input<Tracks>("what is scored; where a view has no measured box, the scene's body is drawn")
      .input<GroundTruth>("the truth")
      .parameters(std::move(p));
  for (MetricSpec& metric : image_tracking_metrics()) d.metric(std::move(metric));
  for (MetricSpec& metric : thesis_tracking_metrics()) d.metric(std::move(metric));
  return d;
}

TrackingScores::TrackingScores(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene) {}

void TrackingScores::do_observe(const NodeIo& io) {
  truth_.add(io, kTruth);
  if (io.has(kTracks)) tracks_.add(io.in<Tracks>(kTracks));
}

Evaluation TrackingScores::do_evaluate() {
  if (!truth_.has_boxes()) return {};
  PairedSequenceBuilder builder;
  for (const auto& [frame, truth] : truth_.frames()) {
    std::vector<ResultPerson> results;
    for (const TrackPoint* point : tracks_.at(frame)) {
      results.push_back(
          {.id = point->id, .boxes = boxes_in_views(*scene_, point->position_m, point->boxes)});
    }
    add_people(builder, frame, *truth, results, options_.overlap);
  }
  const PairedSequence similarity = builder.build();
  if (similarity.truth_count == 0) return {};
  return {{"tracking", image_tracking_section(similarity, options_.overlap, options_.sweep)},
          {"thesis", thesis_section(nullptr, &similarity, options_.overlap)}};
}

}  // namespace plaza::scores
