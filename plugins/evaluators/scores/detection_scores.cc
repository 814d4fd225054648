#include "detection_scores.h"

#include <utility>

#include "plaza/scoring/people.h"
#include "plaza/scoring/sections.h"

namespace plaza::scores {
namespace {

constexpr std::size_t kObservations = 0;
constexpr std::size_t kTruth = 1;

}  // namespace

Declaration<DetectionScores::Options> DetectionScores::declare() {
  Parameters<Options> p;
  p.value("overlap", &Options::overlap)
      .above(0)
      .at_most(1)
      .meaning("least overlap of a match, the mean over the views in which the true person counts")
      .source("thesis 3.3.2");
  p.value("sweep", &Options::sweep)
      .above(0)
      .at_most(1)
      .meaning("further overlaps at which everything is scored, listed in the section's \"sweep\"")
      .source("thesis Fig. 4.17");
  Declaration<Options> d(
      "detection-scores",
      "Scores what was detected in each frame, before tracking, by its boxes in all views");
  d.source("thesis (3.1)-(3.5)")
      .input<Observations>(
          "what is scored; where a view has no measured box, the scene's body is drawn")
      .input<GroundTruth>("the truth")
      .parameters(std::move(p));
  for (MetricSpec& metric : image_detection_metrics()) d.metric(std::move(metric));
  for (MetricSpec& metric : thesis_detection_metrics()) d.metric(std::move(metric));
  return d;
}

DetectionScores::DetectionScores(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene) {}

void DetectionScores::do_observe(const NodeIo& io) {
  truth_.add(io, kTruth);
  if (io.has(kObservations)) observations_[io.frame()] = io.share<Observations>(kObservations);
}

Evaluation DetectionScores::do_evaluate() {
  if (!truth_.has_boxes()) return {};
  PairedSequenceBuilder builder;
  for (const auto& [frame, truth] : truth_.frames()) {
    std::vector<ResultPerson> results;
    if (const auto found = observations_.find(frame); found != observations_.end()) {
      for (const Observation& o : found->second->items) {
        results.push_back({.id = static_cast<std::int64_t>(results.size()),
                           .boxes = boxes_in_views(*scene_, o.position_m, o.boxes)});
      }
    }
    add_people(builder, frame, *truth, results, options_.overlap);
  }
  const PairedSequence similarity = builder.build();
  if (similarity.truth_count == 0) return {};
  return {{"detection", image_detection_section(similarity, options_.overlap, options_.sweep)},
          {"thesis", thesis_section(&similarity, nullptr, options_.overlap)}};
}

}  // namespace plaza::scores
