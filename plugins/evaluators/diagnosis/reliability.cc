#include "reliability.h"

#include <utility>

namespace plaza::diagnosis {
namespace {

constexpr std::size_t kJudged = 0, kTrueOnes = 1;
constexpr const char* kReliabilitySection = "reliability";

void put(nlohmann::json& section, const char* key, const std::optional<double>& value) {
  if (value) section[key] = *value;
}

}  // namespace

Declaration<Reliability::Options> Reliability::declare() {
  Parameters<Options> p;
  p.value("overlap", &Options::overlap)
      .above(0)
      .at_most(1)
      .meaning("least overlap of a match, the mean over the views in which the true person counts")
      .source("thesis 3.3.2");
  p.value("bins", &Options::bins)
      .at_least(1)
      .at_most(1000)
      .meaning("intervals of probability that the calibration error is taken over");
  p.value("points", &Options::points)
      .at_least(2)
      .at_most(100)
      .meaning("most points of the fitted curve, the section's \"curve\"");
  Declaration<Options> d("reliability",
                         "Tells whether observations are as probable and as precise as they say, "
                         "and fits the curve that makes them so.");
  d.source("Brier 1950; Naeini et al., AAAI 2015; Zadrozny and Elkan, KDD 2002")
      .input<Observations>(
          "what is judged; where a view has no measured box, the scene's body is drawn")
      .input<GroundTruth>("the truth")
      .parameters(std::move(p));
  const auto metric = [&d](const char* name, Better better, const char* meaning,
                           bool detail = false) {
    MetricSpec m;
    m.section = kReliabilitySection;
    m.name = name;
    m.better = better;
    m.meaning = meaning;
    m.detail = detail;
    d.metric(std::move(m));
  };
  metric("observations", Better::kNeither, "how many were judged", true);
  metric("right_share", Better::kNeither, "share of them that was somebody", true);
  metric("brier", Better::kLower, "mean squared difference of probability and truth");
  metric("log_loss", Better::kLower, "mean -log of the probability given to what was true, nats",
         true);
  metric("calibration_error", Better::kLower,
         "mean difference of a bin's probability and its share of right ones");
  metric("positions", Better::kNeither, "matched ones whose true position is known", true);
  metric("inside_50", Better::kNeither, "share of the true positions inside the 50 % ellipse");
  metric("inside_90", Better::kNeither, "share of the true positions inside the 90 % ellipse");
  metric("variance_ratio", Better::kNeither,
         "mean squared normalised error / 2: true over stated variance; 1 is consistent");
  metric("variance_ratio_median", Better::kNeither,
         "the same from the median, which outliers don't move", true);
  return d;
}

Reliability::Reliability(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene) {}

void Reliability::do_observe(const NodeIo& io) {
  if (!io.has(kJudged) || !io.has(kTrueOnes)) return;
  judgement_.add(*scene_, io.in<GroundTruth>(kTrueOnes), io.in<Observations>(kJudged),
                 options_.overlap);
}

Evaluation Reliability::do_evaluate() {
  if (judgement_.people == 0 || judgement_.observations.empty()) return {};
  const auto& judged = judgement_.observations;
  std::int64_t right = 0;
  for (const JudgedObservation& j : judged) right += j.right ? 1 : 0;
  nlohmann::json section;
  section["overlap"] = options_.overlap;
  section["observations"] = judged.size();
  section["right_share"] = static_cast<double>(right) / static_cast<double>(judged.size());
  put(section, "brier", brier_score(judged));
  put(section, "log_loss", log_loss(judged));
  put(section, "calibration_error", calibration_error(reliability_bins(judged, options_.bins)));
  section["curve"] = nlohmann::json::array();
  for (const CurvePoint& point : calibration_curve(judged, options_.points)) {
    section["curve"].push_back({point.score, point.probability});
  }
  section["positions"] = judgement_.normalised_errors.size();
  if (const auto consistency = consistency_of(judgement_.normalised_errors)) {
    section["inside_50"] = consistency->inside_50;
    section["inside_90"] = consistency->inside_90;
    section["variance_ratio"] = consistency->mean;
    section["variance_ratio_median"] = consistency->median_ratio;
  }
  return {{kReliabilitySection, std::move(section)}};
}

}  // namespace plaza::diagnosis
