#include "image_scores.h"

namespace plaza::scores {

Parameters<ImageScores::Options> ImageScores::parameters(const std::string& scored,
                                                         const std::string& source) {
  Parameters<Options> p;
  p.value("overlap", &Options::overlap)
      .above(0)
      .at_most(1)
      .meaning("least overlap of a match, the mean over the views in which the true person counts")
      .source("thesis 3.3.2");
  p.value("sweep", &Options::sweep)
      .above(0)
      .at_most(1)
      .meaning("further overlaps at which " + scored + " scored, listed in the section's \"sweep\"")
      .source(source);
  add_from_s(p);
  return p;
}

ImageScores::ImageScores(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene), truth_(options.from_s) {}

void ImageScores::do_observe(const NodeIo& io) {
  truth_.add(io, kTruth);
  if (io.has(kResults)) keep_results(io);
}

Evaluation ImageScores::do_evaluate() {
  if (!truth_.has_boxes()) return {};
  PairedSequenceBuilder builder;
  for (const auto& [frame, truth] : truth_.frames()) {
    add_people(builder, frame, *truth, results_in(frame), options_.overlap);
  }
  const PairedSequence similarity = builder.build();
  if (similarity.truth_count == 0) return {};
  return figures(similarity);
}

}  // namespace plaza::scores
