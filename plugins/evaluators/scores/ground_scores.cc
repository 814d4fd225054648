#include "ground_scores.h"

#include <numeric>
#include <utility>

#include "plaza/scoring/mot_challenge.h"
#include "plaza/scoring/sections.h"

namespace plaza::scores {
namespace {

constexpr std::size_t kTruth = 0;
constexpr std::size_t kObservations = 1;
constexpr std::size_t kTracks = 2;

struct Points {
  std::vector<std::int64_t> ids;
  std::vector<Eigen::Vector2d> positions_m;
};

Points true_points(const GroundTruth& truth) {
  Points points;
  for (const TruePerson& person : truth.people) {
    if (!person.position_m) continue;
    points.ids.push_back(person.id);
    points.positions_m.push_back(*person.position_m);
  }
  return points;
}

}  // namespace

Declaration<GroundScores::Options> GroundScores::declare() {
  Parameters<Options> p;
  p.value("distance_m", &Options::distance_m)
      .unit("m")
      .above(0)
      .meaning(
          "largest distance of a match (observations strictly nearer, as WILDTRACK's evaluator "
          "counts)");
  p.value("sweep", &Options::sweep)
      .unit("m")
      .above(0)
      .meaning(
          "further distances at which everything is scored, listed in the section's \"sweep\"");
  add_from_s(p);
  Declaration<Options> d(
      "ground-scores",
      "Scores positions on the ground: observations before tracking, and final tracks");
  d.source("WILDTRACK's detection rule; CLEAR MOT and identity as py-motmetrics counts them; HOTA")
      .input<GroundTruth>("the truth; people without a position take no part")
      .optional_input<Observations>(
          "MODA, MODP, precision and recall are theirs; without them the tracks'")
      .optional_input<Tracks>("MOTA, identity and everything else is theirs")
      .parameters(std::move(p));
  for (MetricSpec& metric : ground_metrics()) d.metric(std::move(metric));
  return d;
}

GroundScores::GroundScores(const Options& options, const BuildContext& /*context*/)
    : options_(options), truth_(options.from_s) {}

void GroundScores::do_observe(const NodeIo& io) {
  truth_.add(io, kTruth);
  if (io.has(kObservations)) {
    has_observations_ = true;
    for (const Observation& o : io.in<Observations>(kObservations).items) {
      observations_[io.frame()].push_back(o.position_m);
    }
  }
  if (io.has(kTracks)) {
    has_tracks_ = true;
    tracks_.add(io.in<Tracks>(kTracks));
  }
}

PairedSequence GroundScores::pair_observations() const {
  PairedSequenceBuilder builder;
  for (const auto& [frame, truth] : truth_.frames()) {
    const Points people = true_points(*truth);
    const auto found = observations_.find(frame);
    const std::vector<Eigen::Vector2d> results =
        found == observations_.end() ? std::vector<Eigen::Vector2d>() : found->second;
    std::vector<std::int64_t> numbers(results.size());
    std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
    builder.add(frame, people.ids, numbers, point_distances(people.positions_m, results));
  }
  return builder.build();
}

PairedSequence GroundScores::pair_tracks(double reach_m) const {
  PairedSequenceBuilder builder;
  for (const auto& [frame, truth] : truth_.frames()) {
    const Points people = true_points(*truth);
    Points results;
    for (const TrackPoint* point : tracks_.at(frame)) {
      results.ids.push_back(point->id);
      results.positions_m.push_back(point->position_m);
    }
    builder.add(frame, people.ids, results.ids,
                point_distances(people.positions_m, results.positions_m, reach_m));
  }
  return builder.build();
}

nlohmann::json GroundScores::figures(double distance_m) const {
  nlohmann::json out;
  if (has_tracks_) {
    out = ground_tracking_figures(pair_tracks(distance_m), distance_m);
    out["MODA_from"] = "tracks";
  }
  if (has_observations_) {
    const nlohmann::json detection = ground_detection_figures(pair_observations(), distance_m);
    if (has_tracks_) {
      for (const char* key : {"MODA", "MODP", "precision", "recall", "F1"}) {
        out.erase(key);
        if (detection.contains(key)) out[key] = detection[key];
      }
    } else {
      out = detection;
    }
    out["MODA_from"] = "observations";
  }
  return out;
}

Evaluation GroundScores::do_evaluate() {
  if (!truth_.has_positions() || (!has_tracks_ && !has_observations_)) return {};
  nlohmann::json section = figures(options_.distance_m);
  if (!options_.sweep.empty()) section["sweep"] = nlohmann::json::array();
  for (const double distance_m : options_.sweep) {
    nlohmann::json& entry = section["sweep"].emplace_back(figures(distance_m));
    for (const char* detail : {"HOTA_alpha", "trackeval_euclid"}) entry.erase(detail);
  }
  return {{"ground", std::move(section)}};
}

}  // namespace plaza::scores
